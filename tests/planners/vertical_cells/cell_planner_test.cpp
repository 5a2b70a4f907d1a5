// SPDX-License-Identifier: BSD-3-Clause
#include "planners/vertical_cells/cell_planner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/plane/geometry.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "tests/planners/vertical_cells/cell_plans.hpp"
#include "tests/planners/visibility/degenerate_worlds.hpp"

namespace warren {
namespace {

using test::all_searches;
using test::checked_plan;
using test::Dice;
using test::disjoint_polygons;
using test::free_points;
using test::length_of;
using test::PolygonsInCells;

TEST(CellPlanner, EverySearchAndDoorGivesVerifiedPathsOnDisjointPolygons) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed);
    const std::vector<Vec2> ends = free_points(obstacles, seed + 7, 2);
    for (const SearchKind search : all_searches) {
      for (const DoorKind doors : {DoorKind::midpoint, DoorKind::funnel}) {
        const Solution<Vec2> s = checked_plan(obstacles, ends[0], ends[1], {.doors = doors, .search = search});
        EXPECT_EQ(s.outcome, Outcome::solved);  // disjoint polygons part nothing
      }
    }
  }
}

TEST(CellPlanner, SolvesGridsExactlyWhereAFloodDoes) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const PolygonsInCells world(seed, 3 + static_cast<int>(seed % 6), seed % 2 == 0);
    const std::vector<int> regions = world.regions();
    Dice dice(seed);
    for (int trial = 0; trial < 4; ++trial) {
      const int ax = dice.roll(world.side());
      const int ay = dice.roll(world.side());
      const int bx = dice.roll(world.side());
      const int by = dice.roll(world.side());
      Outcome expected =
          regions[world.square(ax, ay)] == regions[world.square(bx, by)] ? Outcome::solved : Outcome::not_connected;
      if (world.is_full(bx, by)) expected = Outcome::goal_blocked;
      if (world.is_full(ax, ay)) expected = Outcome::start_blocked;
      const CellOptions options{.doors = trial % 2 == 0 ? DoorKind::midpoint : DoorKind::funnel,
                                .search = all_searches[static_cast<std::size_t>(dice.roll(4))]};
      const Vec2 a{ax + 0.5, ay + 0.5};
      const Vec2 b{bx + 0.5, by + 0.5};
      EXPECT_EQ(checked_plan(world.obstacles(), a, b, options).outcome, expected);
    }
  }
}

TEST(CellPlanner, ShortestThroughMiddlesIsNoLongerThanFirstFoundOrFewestCells) {
  int longer = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed);
    const std::vector<Vec2> ends = free_points(obstacles, seed, 2);
    const auto length = [&](SearchKind search) {
      return length_of(plan_through_cells(obstacles, ends[0], ends[1], {.search = search}, {}).path);
    };
    const double dijkstra = length(SearchKind::dijkstra);
    EXPECT_NEAR(length(SearchKind::astar), dijkstra, 1e-12 * dijkstra);
    EXPECT_LE(dijkstra, length(SearchKind::bfs) * (1.0 + 1e-12));
    EXPECT_LE(dijkstra, length(SearchKind::dfs) * (1.0 + 1e-12));
    longer += length(SearchKind::dfs) > 1.1 * dijkstra ? 1 : 0;
  }
  EXPECT_GT(longer, 50);
}

TEST(CellPlanner, AgreesWithTheVisibilityGraphWhereObstaclesTouchInEveryWay) {
  int solved = 0;
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    DegenerateWorlds worlds(seed);
    const PlaneObstacles obstacles = worlds.make(false);
    for (int trial = 0; trial < 4; ++trial) {
      const Vec2 start = worlds.random_point();
      const Vec2 goal = worlds.random_point();
      if (!box_around(obstacles).contains(start) || !box_around(obstacles).contains(goal)) continue;
      const CellOptions options{.doors = trial % 2 == 0 ? DoorKind::funnel : DoorKind::midpoint};
      try {
        const Solution<Vec2> s = checked_plan(obstacles, start, goal, options);
        const Solution<Vec2> shortest = visibility_path(confined(obstacles), start, goal, {}, {});
        ASSERT_EQ(s.outcome, shortest.outcome);
        EXPECT_GE(length_of(s.path), length_of(shortest.path) * (1.0 - 1e-12));
        if (options.doors == DoorKind::funnel) {
          EXPECT_LE(length_of(s.path), length_of(shortest.path) * (1.0 + 1e-12)) << start.x << ' ' << start.y;
        }
        solved += s.outcome == Outcome::solved ? 1 : 0;
      } catch (const ObstacleClash&) {
        ++refused;  // some of these polygons overlap, corners on corners
      }
    }
  }
  EXPECT_GT(solved, 200);
  EXPECT_LT(refused, 600);
}

TEST(CellPlanner, PathsLeaveCornersAndSidesWhereTheyMay) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed, 3);
    if (obstacles.polygons.size() < 2) continue;
    const auto& corners = obstacles.polygons.corners;
    Dice dice(seed);
    for (int trial = 0; trial < 6; ++trial) {
      const auto any = [&] { return static_cast<std::size_t>(dice.roll(static_cast<int>(corners.size()))); };
      const Vec2 start = corners[any()];
      const Vec2 goal = corners[any()];
      const CellOptions options{.doors = trial % 2 == 0 ? DoorKind::funnel : DoorKind::midpoint};
      EXPECT_EQ(checked_plan(obstacles, start, goal, options).outcome, Outcome::solved);
    }
  }
}

TEST(CellPlanner, SidesOfAWallAreApart) {
  PlaneObstacles room;
  room.bounds = Box{{0, 0}, {4, 4}};
  room.walls = {{{2, 0}, {2, 4}}};
  EXPECT_EQ(checked_plan(room, {1, 1}, {3, 1}, {}).outcome, Outcome::not_connected);
  EXPECT_EQ(checked_plan(room, {2, 1}, {3, 1}, {}).outcome, Outcome::solved);  // on the wall: off either side
  EXPECT_EQ(checked_plan(room, {2, 1}, {1, 1}, {}).outcome, Outcome::solved);
  const Solution<Vec2> apart = plan_through_cells(room, {1, 1}, {3, 1}, {}, {});
  EXPECT_GT(apart.separation.start_size, 0U);
  EXPECT_GT(apart.separation.goal_size, 0U);
  EXPECT_EQ(apart.separation.nearest_gap, 0.0);  // doors end on either side of the wall
  room.walls = {{{2, 0}, {2, 3}}};
  const Solution<Vec2> around = checked_plan(room, {1, 1}, {3, 1}, {.doors = DoorKind::funnel});
  EXPECT_DOUBLE_EQ(length_of(around.path), 2.0 * std::sqrt(5.0));
}

TEST(CellPlanner, TouchingCornersLetNobodyThrough) {
  PlaneObstacles room;
  room.bounds = Box{{0, 0}, {4, 4}};
  room.polygons.add(std::vector<Vec2>{{0, 0}, {2, 2}, {0, 2}});
  room.polygons.add(std::vector<Vec2>{{2, 2}, {4, 2}, {4, 4}});
  EXPECT_EQ(checked_plan(room, {1, 3}, {3, 1}, {}).outcome, Outcome::not_connected);
}

TEST(CellPlanner, NamesBlockedEnds) {
  PlaneObstacles obstacles;
  obstacles.polygons.add(std::vector<Vec2>{{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  obstacles.walls = {{{1, 1}, {2, 2}}};
  obstacles.bounds = Box{{-2, -2}, {6, 6}};
  EXPECT_EQ(checked_plan(obstacles, {3, 1}, {-1, 0}, {}).outcome, Outcome::start_blocked);
  EXPECT_EQ(checked_plan(obstacles, {-1, 0}, {1, 1}, {}).outcome, Outcome::goal_blocked);  // a wall inside the polygon
  EXPECT_EQ(checked_plan(obstacles, {-3, 0}, {-1, 0}, {}).outcome, Outcome::start_blocked);
  EXPECT_EQ(checked_plan(obstacles, {-1, 0}, {-1, 0}, {}).outcome, Outcome::solved);
  EXPECT_EQ(checked_plan({}, {-1, 0}, {2, 0}, {}).path.size(), 2U);
}

TEST(CellPlanner, PassesDoorsOfAFewUnitsInTheLastPlace) {
  const double tiny = std::numeric_limits<double>::epsilon();
  for (int ulps = 1; ulps <= 6; ++ulps) {
    SCOPED_TRACE(ulps);
    const double slit = 1.0 + ulps * tiny;
    PlaneObstacles room;
    room.bounds = Box{{0, 0}, {3, 3}};
    room.polygons.add(std::vector<Vec2>{{1, 0}, {2, 0}, {1.5, 1}});
    room.polygons.add(std::vector<Vec2>{{1.25, slit}, {1.75, 1.0 + (7 - ulps) * tiny}, {1.7, 3}, {1.3, 3}});
    for (const SearchKind search : all_searches) {
      for (const DoorKind doors : {DoorKind::midpoint, DoorKind::funnel}) {
        EXPECT_EQ(checked_plan(room, {0.5, 0.5}, {2.5, 0.5}, {.doors = doors, .search = search}).outcome,
                  Outcome::solved);
      }
    }
  }
}

TEST(CellPlanner, SkewDoorsOfRandomCoordinatesNeverEndInsideObstacles) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    PlaneObstacles room;  // a wedge and its mirror image, nearly closed, at coordinates that are exact nowhere
    const double gap = std::pow(10.0, -1.0 - dice.roll(16));
    const double slope = 0.1 + dice.real();
    const auto below = [&](double x) { return slope * x / 3.0; };
    room.polygons.add(std::vector<Vec2>{{0.1, -2}, {1.1, -2}, {1.1, below(1.1)}, {0.7, below(0.7)}, {0.1, below(0.1)}});
    room.polygons.add(std::vector<Vec2>{
        {0.2, below(0.2) + gap}, {0.6, below(0.6) + gap}, {0.9, below(0.9) + gap}, {0.9, 3}, {0.2, 3}});
    room.bounds = Box{{-1, -2}, {2, 3}};
    try {
      for (const SearchKind search : all_searches) {
        const Outcome outcome = checked_plan(room, {-0.5, 0.1}, {1.5, 0.1}, {.search = search}).outcome;
        EXPECT_TRUE(outcome == Outcome::solved || gap < 1e-14);
      }
    } catch (const ObstacleClash&) {
      EXPECT_LT(gap, 1e-14);  // rounded into each other
    }
  }
}

TEST(CellPlanner, AnswersAreTheSameForAnyNumberOfThreads) {
  const PlaneObstacles obstacles = disjoint_polygons(4, 60);
  const CellOptions options{.doors = DoorKind::midpoint, .search = SearchKind::dijkstra};
  const Solution<Vec2> one = plan_through_cells(obstacles, {-11, -11}, {1400, 1400}, options, {.threads = 1});
  ASSERT_EQ(one.outcome, Outcome::solved);
  for (const unsigned threads : {2U, 3U, 8U}) {
    const Solution<Vec2> more = plan_through_cells(obstacles, {-11, -11}, {1400, 1400}, options, {.threads = threads});
    EXPECT_EQ(more.path, one.path);
    EXPECT_EQ(more.counters, one.counters);
  }
}

TEST(CellPlanner, StopsAtTheDeadline) {
  const Deadline over(0.0);
  const PlaneObstacles obstacles = disjoint_polygons(1);
  const Solution<Vec2> s = plan_through_cells(obstacles, {-11, -11}, {80, 80}, {}, {.deadline = &over});
  EXPECT_EQ(s.outcome, Outcome::stopped);
  EXPECT_EQ(s.stop_reason, StopReason::time);
}

}  // namespace
}  // namespace warren
