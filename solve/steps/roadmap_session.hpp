// SPDX-License-Identifier: BSD-3-Clause
// What stands between a kept roadmap and a kind of problem: the world in memory and the roadmap over it, ready to be
// asked, and what the judge keeps of the scene. One type a World; which, only the kind knows that made it.
#pragma once

#include <memory>
#include <optional>

#include "planners/graph/roadmap_arrays.hpp"
#include "planners/roadmap/ask_roadmap.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {

/// Any number of threads may ask, each with its scratch.
struct RoadmapSession {
  RoadmapSession() = default;
  virtual ~RoadmapSession() = default;
  RoadmapSession(const RoadmapSession&) = delete;
  RoadmapSession& operator=(const RoadmapSession&) = delete;
  /// What searches have learnt of the edges; while nobody asks.
  virtual std::span<const std::uint64_t> edge_states() const = 0;
  /// Length of the motion between two states of the roadmap.
  virtual double distance(VertexId from, VertexId to) const = 0;

  std::optional<ObstacleIndex> judged;  ///< of the scene, where the judge takes one
};

template <World W>
struct SessionIn : RoadmapSession {
  std::optional<W> world;
  std::optional<AskedRoadmap<W>> roadmap;
  std::span<const std::uint64_t> edge_states() const override { return roadmap->edge_states(); }
  double distance(VertexId from, VertexId to) const override {
    return world->distance(roadmap->states()[from], roadmap->states()[to]);
  }
};

/// A session, and the scratch of the thread that asks.
struct RoadmapAsked {
  const RoadmapSession* session = nullptr;  ///< nullptr: the roadmap is built for the question
  AskScratch* scratch = nullptr;

  const ObstacleIndex* judged() const { return session != nullptr && session->judged ? &*session->judged : nullptr; }
};

}  // namespace warren
