// SPDX-License-Identifier: BSD-3-Clause
#include "planners/cell_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/geometry.hpp"
#include "planners/confined_obstacles.hpp"
#include "planners/visibility_path.hpp"
#include "tests/planners/degenerate_worlds.hpp"
#include "tests/planners/plane_worlds.hpp"

namespace warren {
namespace {

using testing::Dice;
using testing::disjoint_polygons;
using testing::GridWorld;
using testing::judged;
using testing::length_of;

constexpr SearchKind all_searches[] = {SearchKind::astar, SearchKind::dijkstra, SearchKind::bfs, SearchKind::dfs};

/// Plans and lets the path be judged.
Solution<Vec2> checked_plan(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal, const CellOptions& options,
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

std::vector<Vec2> free_points(const PlaneObstacles& obstacles, std::uint64_t seed, std::size_t count) {
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

/// Length of the shortest path over the corners, each leg asked of the judge: no planner's code. Infinite: none.
double shortest_length(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal) {
  std::vector<Vec2> at = obstacles.polygons.corners;
  for (const Segment& wall : obstacles.walls) at.insert(at.end(), {wall.a, wall.b});
  at.push_back(start);
  at.push_back(goal);
  const std::size_t n = at.size();
  std::vector<double> length(n, std::numeric_limits<double>::infinity());
  std::vector<char> done(n, 0);
  length[n - 2] = 0.0;
  for (;;) {
    std::size_t v = n;
    for (std::size_t i = 0; i < n; ++i) {
      if (done[i] == 0 && (v == n || length[i] < length[v])) v = i;
    }
    if (v == n || std::isinf(length[v]) || v == n - 1) return length[n - 1];
    done[v] = 1;
    for (std::size_t i = 0; i < n; ++i) {
      const double through = length[v] + distance(at[v], at[i]);
      if (done[i] == 0 && through < length[i] && judged(obstacles, {at[v], at[i]}).verified) length[i] = through;
    }
  }
}

/// What can be seen from a point through doors, all of them upright, in slopes; 1e-12 to spare.
struct Cone {
  Vec2 eye;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  int direction = 0;  // 1 to the right, -1 to the left, 0 not known yet

  bool turns_to(double x) const { return direction != 0 && (x - eye.x) * direction <= 0.0; }
  double slope_to(Vec2 p) const { return (p.y - eye.y) / std::abs(p.x - eye.x); }
  bool sees(Vec2 p) const {
    const double slope = slope_to(p);
    const double spare = 1e-12 * (1.0 + std::abs(slope));
    return low - spare <= slope && slope <= high + spare;
  }
};

/// Length of the shortest way through the doors: it bends at ends of doors alone, so it is the shortest path among
/// them, start and goal, each joined with what it sees through the doors between.
double shortest_through_doors(const CellPlan& plan) {
  const std::size_t n = plan.route.doors.size();
  std::vector<std::array<Vec2, 2>> ends;  // the start, the lower and upper end of each door, the goal
  ends.push_back({plan.route.start, plan.route.start});
  for (const auto door : plan.route.doors) {
    const Segment line = plan.cells.door_line(door);
    ends.push_back(line.a.y <= line.b.y ? std::array{line.a, line.b} : std::array{line.b, line.a});
  }
  ends.push_back({plan.route.goal, plan.route.goal});
  constexpr double far = std::numeric_limits<double>::infinity();
  std::vector<std::array<double, 2>> length(n + 2, {far, far});
  length.at(0) = {0.0, 0.0};
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      Cone cone{.eye = ends[i][end]};
      for (std::size_t j = i + 1; j <= n + 1; ++j) {
        const double x = ends[j][0].x;
        if (cone.turns_to(x)) break;
        if (x == cone.eye.x) {  // a door that the eye stands on, or the goal above or below it
          for (std::size_t k = 0; k < 2; ++k) {
            length[j][k] = std::min(length[j][k], length[i][end] + distance(cone.eye, ends[j][k]));
          }
          if (cone.eye.y < ends[j][0].y || cone.eye.y > ends[j][1].y) break;
          continue;
        }
        cone.direction = x > cone.eye.x ? 1 : -1;
        for (std::size_t k = 0; k < 2; ++k) {
          if (cone.sees(ends[j][k])) {
            length[j][k] = std::min(length[j][k], length[i][end] + distance(cone.eye, ends[j][k]));
          }
        }
        cone.low = std::max(cone.low, cone.slope_to(ends[j][0]));
        cone.high = std::min(cone.high, cone.slope_to(ends[j][1]));
      }
    }
  }
  return length.back()[0];
}

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
    const GridWorld world(seed, 3 + static_cast<int>(seed % 6), seed % 2 == 0);
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

/// Does the path pass the route's doors, one after the other?
bool passes_doors(const std::vector<Vec2>& path, const CellPlan& plan) {
  constexpr double tolerance = 1e-9;
  std::size_t leg = 1;
  double done = 0.0;  // of the leg
  const auto meets = [&](const Segment& door) {
    const Vec2 from = path[leg - 1];
    const Vec2 run = path[leg] - from;
    double t = 0.0;
    if (run.x == 0.0) {
      if (std::abs(from.x - door.a.x) > tolerance) return false;
      const double y = std::clamp(from.y + done * run.y, door.a.y, door.b.y);
      t = run.y == 0.0 ? done : (y - from.y) / run.y;
    } else {
      t = (door.a.x - from.x) / run.x;
    }
    t = std::clamp(t, done, 1.0);
    if (distance(from + t * run, door) > tolerance) return false;
    done = t;
    return true;
  };
  for (const std::uint32_t door : plan.route.doors) {
    while (leg < path.size() && !meets(plan.cells.door_line(door))) {
      ++leg;
      done = 0.0;
    }
    if (leg == path.size()) return false;
  }
  return true;
}

/// Does the path bend around corners of the route's doors only, and around each towards it? A path through the doors
/// with that property can't be shortened anywhere, and in cells without a hole that makes it the shortest one.
bool is_taut(const std::vector<Vec2>& path, const CellPlan& plan) {
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const int turn = orient2d(path[i - 1], path[i], path[i + 1]);
    bool held = false;
    for (std::size_t d = 0; d < plan.route.doors.size(); ++d) {
      const Door& door = plan.cells.doors[plan.route.doors[d]];
      const bool rightwards = door.left == plan.route.cells[d];
      const int side = rightwards == door.above ? -1 : 1;  // of the corner: right or left of the way through the door
      held = held || (plan.cells.corners[door.corner] == path[i] && (turn == side || turn == 0));
    }
    if (!held) return false;
  }
  return true;
}

TEST(CellPlanner, FunnelIsTheShortestPathThroughItsCells) {
  int bends = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed);
    const std::vector<Vec2> ends = free_points(obstacles, seed + 3, 2);
    for (const SearchKind search : {SearchKind::dijkstra, SearchKind::dfs}) {
      CellPlan plan;
      const CellOptions options{.doors = DoorKind::funnel, .search = search};
      const std::vector<Vec2> path = checked_plan(obstacles, ends[0], ends[1], options, &plan).path;
      EXPECT_TRUE(passes_doors(path, plan));
      EXPECT_TRUE(is_taut(path, plan));
      const double shortest = shortest_through_doors(plan);
      EXPECT_NEAR(length_of(path) / shortest, 1.0, 1e-9);
      bends += static_cast<int>(path.size()) - 2;
    }
  }
  EXPECT_GT(bends, 100);
}

TEST(CellPlanner, FunnelSearchedByLengthIsTheShortestPath) {
  for (std::uint64_t seed = 0; seed < 48; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed, 1 + static_cast<int>(seed % 3));
    const std::vector<Vec2> ends = free_points(obstacles, seed + 5, 2);
    const double shortest = shortest_length(obstacles, ends[0], ends[1]);
    for (const SearchKind search : all_searches) {
      const CellOptions options{.doors = DoorKind::funnel, .search = search};
      const double funnel = length_of(checked_plan(obstacles, ends[0], ends[1], options).path);
      EXPECT_GE(funnel, shortest * (1.0 - 1e-12));
      if (search == SearchKind::astar || search == SearchKind::dijkstra) {
        EXPECT_LE(funnel, shortest * (1.0 + 1e-12));
      }
    }
  }
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
