// SPDX-License-Identifier: BSD-3-Clause
#include "planners/vertical_cells/cell_decomposition.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "planners/vertical_cells/cell_planner.hpp"
#include "tests/planners/visibility/degenerate_worlds.hpp"

namespace warren {
namespace {

/// On corners, on sides, under and above corners, on the box and outside of it.
std::vector<Vec2> points_of(DegenerateWorlds& worlds, const PlaneObstacles& world) {
  std::vector<Vec2> points = world.polygons.corners;
  for (const Segment& wall : world.walls) points.insert(points.end(), {wall.a, 0.5 * (wall.a + wall.b)});
  for (int i = 0; i < 60; ++i) {
    const Vec2 p = worlds.random_point();
    points.insert(points.end(), {p, p + Vec2{0.5, 0.0}, p + Vec2{0.0, -0.5}, p + Vec2{0.25, 0.125}});
  }
  return points;
}

bool has_cells(const PlaneObstacles& world) {
  if (world.polygons.empty() && world.walls.empty() && !world.bounds) return false;
  try {
    decompose(world, {}, {});
    return true;
  } catch (const ObstacleClash&) {
    return false;
  }
}

TEST(CellLocator, SaysWhatTheSweepSays) {
  std::size_t on_borders = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    DegenerateWorlds worlds(seed);
    const PlaneObstacles world = worlds.make(false);
    if (!has_cells(world)) continue;
    const std::vector<Vec2> points = points_of(worlds, world);
    const CellDecomposition cells = decompose(world, points, {});
    for (std::size_t i = 0; i < points.size(); ++i) {
      const CellPlace place = locate(cells, world, points[i]);
      EXPECT_EQ(place.blocked, cells.places[i].blocked) << points[i].x << ' ' << points[i].y;
      EXPECT_EQ(place.cells, cells.places[i].cells) << points[i].x << ' ' << points[i].y;
      on_borders += place.cells.size() > 1 ? 1U : 0U;
    }
  }
  EXPECT_GT(on_borders, 1000U);
}

TEST(CellLocator, APlanOnKeptCellsIsThePlan) {
  std::size_t solved = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    DegenerateWorlds worlds(seed);
    const PlaneObstacles world = worlds.make(false);
    if (!has_cells(world)) continue;
    const CellRoadmap kept(world, {});
    for (const DoorKind doors : {DoorKind::midpoint, DoorKind::funnel}) {
      for (const SearchKind search : {SearchKind::astar, SearchKind::dijkstra, SearchKind::bfs, SearchKind::dfs}) {
        const Vec2 start = worlds.random_point();
        const Vec2 goal = worlds.random_point();
        const CellOptions options{.doors = doors, .search = search};
        const Solution<Vec2> plan = plan_through_cells(world, start, goal, options, {});
        const Solution<Vec2> asked = plan_through_cells(kept, start, goal, options, {});
        EXPECT_EQ(asked.outcome, plan.outcome);
        EXPECT_EQ(asked.path, plan.path);
        EXPECT_EQ(asked.counters.expanded, plan.counters.expanded);
        EXPECT_EQ(asked.roadmap.components, plan.roadmap.components);
        solved += plan.outcome == Outcome::solved ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(solved, 100U);
}

}  // namespace
}  // namespace warren
