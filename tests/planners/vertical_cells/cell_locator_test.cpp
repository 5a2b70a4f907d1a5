// SPDX-License-Identifier: BSD-3-Clause
#include "planners/vertical_cells/cell_decomposition.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "planners/vertical_cells/cell_planner.hpp"
#include "spatial/obstacles/polygon_index.hpp"
#include "tests/planners/visibility/degenerate_worlds.hpp"
#include "tests/refusals.hpp"

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
  return test::refusal<ObstacleClash>([&] { decompose(world, {}, {}); }).empty();
}

/// By definition: with x + 2^-20 y in place of x no two points of these worlds are above each other.
std::vector<VertexId> cells_around(const CellDecomposition& cells, const PlaneObstacles& world, Vec2 p) {
  std::vector<VertexId> found;
  if (!cells.box.contains(p)) return found;
  const auto x_of = [](Vec2 q) { return q.x + 0x1p-20 * q.y; };
  for (VertexId i = 0; i < cells.cells.size(); ++i) {
    const VerticalCell& cell = cells.cells[i];
    if (cell.left != no_number && x_of(cells.corners[cell.left]) > x_of(p)) continue;
    if (cell.right != no_number && x_of(cells.corners[cell.right]) < x_of(p)) continue;
    const bool between = cells.side(cell.lower, p) >= 0 && cells.side(cell.upper, p) <= 0;
    if (between && !is_flat(cells, world, cell)) found.push_back(i);
  }
  return found;
}

TEST(CellLocator, FindsTheCellsOfTheShearedPlane) {
  std::size_t on_borders = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    DegenerateWorlds worlds(seed);
    const PlaneObstacles world = worlds.make(false);
    if (!has_cells(world)) continue;
    const std::vector<Vec2> points = points_of(worlds, world);
    const CellDecomposition cells = decompose(world, points, {});
    const PolygonIndex polygons(world.polygons, {});
    for (std::size_t i = 0; i < points.size(); ++i) {
      const CellPlace place = locate(cells, world, points[i], {});
      const bool blocked = !cells.box.contains(points[i]) || polygons.polygon_around(points[i]);
      EXPECT_EQ(place.blocked, blocked) << points[i].x << ' ' << points[i].y;
      EXPECT_EQ(place.cells, cells_around(cells, world, points[i])) << points[i].x << ' ' << points[i].y;
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
