// SPDX-License-Identifier: BSD-3-Clause
// The candidate edges of a roadmap whose motions have a direction: from a state to its k nearest, or from the k nearest
// to it; nearest by the world's metric, in the edge's direction. The metric may be far above the distance of the
// embedding (a car gets sideways by a loop), so the k are chosen among the 4 k nearest of the embedding. Radius rule:
// what is within the radius by the metric.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "planners/roadmap/roadmap_growth.hpp"
#include "planners/roadmap/state_index.hpp"

namespace warren {

enum class Heading : std::uint8_t { out, in };

/// The other end of a candidate edge, and the edge's length.
struct OneWayCandidate {
  double length;
  VertexId to;
};

/// Nearest first; of two as near, the smaller vertex. `except`: the state's own vertex, or no_vertex; `near` is
/// scratch.
template <World W>
std::vector<OneWayCandidate> one_way_candidates(const W& world, std::span<const typename W::State> states,
                                                const StateIndex<W>& index, const ConnectionRule& rule,
                                                const typename W::State& state, VertexId except, Heading heading,
                                                std::vector<Neighbour>& near) {
  constexpr std::size_t wider = 4;
  const auto at = embedded(world, state);
  if (rule.neighbours > 0) {
    index.nearest(at, wider * rule.neighbours, except, near);
  } else {
    index.within(at, SearchRadius(rule.radius), except, near);
  }
  std::vector<OneWayCandidate> found;
  for (const Neighbour& n : near) {
    const double length =
        heading == Heading::in ? world.distance(states[n.id], state) : world.distance(state, states[n.id]);
    if (rule.neighbours > 0 || length <= rule.radius) found.push_back({length, n.id});
  }
  std::sort(found.begin(), found.end(), [](const OneWayCandidate& a, const OneWayCandidate& b) {
    return a.length != b.length ? a.length < b.length : a.to < b.to;
  });
  if (rule.neighbours > 0 && found.size() > rule.neighbours) found.resize(rule.neighbours);
  return found;
}

}  // namespace warren
