// SPDX-License-Identifier: BSD-3-Clause
// The shortest way through a row of cells, and the shortest of all, by definition.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/plane/geometry.hpp"
#include "tests/planners/vertical_cells/cell_plans.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using test::all_searches;
using test::checked_plan;
using test::disjoint_polygons;
using test::free_points;
using test::judged;
using test::length_of;

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

/// Does the path pass the route's doors, one after the other?
bool passes_doors(const Path<Vec2>& path, const CellPlan& plan) {
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
bool is_taut(const Path<Vec2>& path, const CellPlan& plan) {
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

TEST(CellFunnel, IsTheShortestPathThroughItsCells) {
  int bends = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed);
    const std::vector<Vec2> ends = free_points(obstacles, seed + 3, 2);
    for (const SearchKind search : {SearchKind::dijkstra, SearchKind::dfs}) {
      CellPlan plan;
      const CellOptions options{.doors = DoorKind::funnel, .search = search};
      const Path<Vec2> path = checked_plan(obstacles, ends[0], ends[1], options, &plan).path;
      EXPECT_TRUE(passes_doors(path, plan));
      EXPECT_TRUE(is_taut(path, plan));
      const double shortest = shortest_through_doors(plan);
      EXPECT_NEAR(length_of(path) / shortest, 1.0, 1e-9);
      bends += static_cast<int>(path.size()) - 2;
    }
  }
  EXPECT_GT(bends, 100);
}

TEST(CellFunnel, SearchedByLengthIsTheShortestPath) {
  for (const std::uint64_t seed : test::seeds(48, 12, 0)) {
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

TEST(CellFunnel, FindsTheWayOverAnEndThatWallsShare) {
  const PlaneObstacles obstacles{{}, {{{1, 3}, {2, 5}}, {{2, 2}, {2, 5}}}, Box{{0, 0}, {8, 8}}};
  const double over_the_end = std::hypot(0.5, 0.75) + std::hypot(1.0, 2.0) + 1.0;
  for (const SearchKind search : {SearchKind::astar, SearchKind::dijkstra}) {
    const CellOptions options{.doors = DoorKind::funnel, .search = search};
    const Solution<Vec2> plan = checked_plan(obstacles, {1.5, 3.75}, {3, 5}, options);
    EXPECT_NEAR(length_of(plan.path), over_the_end, 1e-12);
  }
}

}  // namespace
}  // namespace warren
