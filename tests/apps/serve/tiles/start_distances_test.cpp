// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/tiles/roadmap_layer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "tests/apps/serve/town.hpp"

namespace warren::serve {
namespace {

constexpr double not_reached = std::numeric_limits<double>::infinity();

/// Bellman and Ford's, over the roadmap's free edges, from one of its milestones.
std::vector<double> relaxed(const RoadmapParts& parts, VertexId from) {
  std::vector<double> length(parts.vertex_count(), not_reached);
  length[from] = 0.0;
  for (bool changes = true; changes;) {
    changes = false;
    for (VertexId v = 0; v < parts.vertex_count(); ++v) {
      for (std::size_t end = parts.first[v]; end < parts.first[v + 1]; ++end) {
        const VertexId w = parts.to[end];
        if (parts.state_of_end(end) != EdgeState::free) continue;
        const double through =
            length[v] + std::hypot(parts.state(v)[0] - parts.state(w)[0], parts.state(v)[1] - parts.state(w)[1]);
        changes = changes || through < length[w];
        length[w] = std::min(length[w], through);
      }
    }
  }
  return length;
}

TEST(StartDistances, LieBetweenThoseOfAMilestoneThereAndThoseOfQuestions) {
  const Roadmap roadmap = build(scene_of(town));
  const RoadmapQuery query(roadmap, Execution{});
  const RoadmapParts parts = roadmap.arrays.parts();
  constexpr VertexId there = 11;
  const std::vector<double> start(parts.state(there).begin(), parts.state(there).end());
  const StartDistances found = start_distances(query, start, {});
  const std::vector<double> most = relaxed(parts, there);
  ASSERT_EQ(found.inks.size(), parts.vertex_count());
  ASSERT_GT(found.steps.count, 3U);
  QuestionScratch scratch;
  std::vector<unsigned> seen(step_inks.size(), 0);
  for (VertexId v = 0; v < parts.vertex_count(); v += 3) {
    if (most[v] == not_reached) continue;
    const std::vector<double> goal(parts.state(v).begin(), parts.state(v).end());
    const LengthAnswer least = query.length_within(start, goal, {}, {}, scratch);
    ASSERT_EQ(least.outcome, Outcome::solved);
    ASSERT_NE(found.inks[v], unreached_ink);
    EXPECT_LE(found.steps.of(least.length * (1 - 1e-12)), found.inks[v]) << v;
    EXPECT_GE(found.steps.of(most[v] * (1 + 1e-12)), found.inks[v]) << v;
    ++seen[found.inks[v]];
  }
  EXPECT_GT(seen[0], 0U);
  EXPECT_GT(seen[found.steps.count - 1], 0U);
}

TEST(StartDistances, WhatIsBehindAWallIsNotReachedAndABlockedStartIsRefused) {
  const Roadmap roadmap = build(scene_of("bounds 0 0 100 60\nwall 50 -1 50 61\n"));
  const RoadmapQuery query(roadmap, Execution{});
  const RoadmapParts parts = roadmap.arrays.parts();
  const StartDistances found = start_distances(query, {5.0, 30.0}, {});
  std::uint64_t reached = 0;
  for (VertexId v = 0; v < parts.vertex_count(); ++v) {
    const bool is_left = parts.state(v)[0] < 50.0;
    EXPECT_EQ(found.inks[v] != unreached_ink, is_left) << v;
    reached += is_left ? 1 : 0;
  }
  EXPECT_EQ(found.reached, reached);
  EXPECT_THROW(start_distances(query, {50.0, 30.0}, {}), UsageError);
}

}  // namespace
}  // namespace warren::serve
