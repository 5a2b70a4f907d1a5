// SPDX-License-Identifier: BSD-3-Clause
// Plans through vertical cells for tests: every path is judged.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "planners/vertical_cells/cell_planner.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"

namespace warren::test {

inline constexpr SearchKind all_searches[] = {SearchKind::astar, SearchKind::dijkstra, SearchKind::bfs,
                                              SearchKind::dfs};

/// Plans and lets the path be judged.
inline Solution<Vec2> checked_plan(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal, const CellOptions& options,
                                   CellPlan* keep = nullptr) {
  const Solution<Vec2> solution = plan_through_cells(obstacles, start, goal, options, {}, keep);
  if (solution.outcome != Outcome::solved) return solution;
  EXPECT_EQ(solution.path.front(), start);
  EXPECT_EQ(solution.path.back(), goal);
  const Verification v = judged(obstacles, solution.path);
  EXPECT_TRUE(v.verified) << v.first_violation->obstacle << " on leg " << v.first_violation->leg << " of "
                          << solution.path.size();
  return solution;
}

/// Points on the grid of halves that a path may stand on.
inline std::vector<Vec2> free_points(const PlaneObstacles& obstacles, std::uint64_t seed, std::size_t count) {
  Dice dice(seed);
  std::vector<Vec2> points;
  while (points.size() < count) {
    const Box& b = *obstacles.bounds;
    const Vec2 p{b.min.x + dice.roll(static_cast<int>(b.width() * 2.0) + 1) * 0.5,
                 b.min.y + dice.roll(static_cast<int>(b.height() * 2.0) + 1) * 0.5};
    if (judged(obstacles, {p, p}).verified) points.push_back(p);
  }
  return points;
}

}  // namespace warren::test
