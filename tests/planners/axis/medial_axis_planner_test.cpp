// SPDX-License-Identifier: BSD-3-Clause
#include "planners/axis/medial_axis_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"

namespace warren {
namespace {

using test::Dice;
using test::disjoint_polygons;
using test::length_of;
using test::obstacles_of;
using test::PolygonsInCells;
using test::scene_around;

/// Plans and lets the path be judged: it keeps the clearance; with clearance 0 it touches nothing.
Solution<Vec2> checked_plan(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal, const MedialAxisOptions& options,
                            double* min_clearance = nullptr, MedialAxisPlan* keep = nullptr) {
  const Solution<Vec2> solution = plan_on_medial_axis(obstacles, start, goal, options, {}, keep);
  if (solution.outcome != Outcome::solved) return solution;
  EXPECT_EQ(solution.path.front(), start);
  EXPECT_EQ(solution.path.back(), goal);
  const VerifyOptions judging{.clearance = options.clearance, .contact = Contact::blocked};
  const Verification v = verify_path(scene_around(obstacles, solution.path), solution.path, judging, {});
  EXPECT_TRUE(v.verified) << v.first_violation->obstacle << " at " << v.first_violation->distance;
  if (min_clearance != nullptr) *min_clearance = v.min_clearance;
  return solution;
}

/// The statement's walls of the course sheet: every gap is 100 units wide.
PlaneObstacles course_walls() {
  PlaneObstacles obstacles;
  obstacles.bounds = Box{{0, 0}, {800, 300}};
  obstacles.walls = {{{200, 0}, {200, 200}},
                     {{100, 200}, {300, 200}},
                     {{400, 100}, {400, 300}},
                     {{600, 0}, {600, 200}},
                     {{500, 200}, {700, 200}}};
  return obstacles;
}

TEST(MedialAxisPlanner, WalksTheCoursesWallsInTheMiddleOfEveryGap) {
  for (const AxisObjective objective : {AxisObjective::length, AxisObjective::clearance}) {
    double clearance = 0.0;
    MedialAxisPlan plan;
    const Solution<Vec2> s =
        checked_plan(course_walls(), {50, 50}, {750, 50}, {.objective = objective}, &clearance, &plan);
    ASSERT_EQ(s.outcome, Outcome::solved);
    EXPECT_NEAR(length_of(s.path), 1570.7, 0.01 * 1570.7);
    EXPECT_EQ(clearance, 50.0);
    EXPECT_EQ(plan.axis_clearance, 50.0);
  }
}

TEST(MedialAxisPlanner, PassesGapsThatAreExactlyWideEnoughAndNoNarrowerOnes) {
  const auto outcome = [](double clearance) {
    return checked_plan(course_walls(), {50, 50}, {750, 50}, {.clearance = clearance}).outcome;
  };
  EXPECT_EQ(outcome(49.999), Outcome::solved);
  EXPECT_EQ(outcome(50.0), Outcome::solved);
  EXPECT_EQ(checked_plan(course_walls(), {60, 60}, {740, 60}, {.clearance = 50.001}).outcome, Outcome::not_connected);
}

TEST(MedialAxisPlanner, FindsTheWayOfTheFloodInMazes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Scene maze = maze_scene({.rows = 9, .cols = 11, .seed = seed}, seed % 2 == 0, {});
    const PlaneObstacles obstacles = obstacles_of(maze);
    for (const double clearance : {0.0, 0.1, 0.4999}) {
      double least = 0.0;
      const Solution<Vec2> s = checked_plan(obstacles, {maze.start[0], maze.start[1]}, {maze.goal[0], maze.goal[1]},
                                            {.clearance = clearance}, &least);
      EXPECT_EQ(s.outcome, Outcome::solved);
      EXPECT_NEAR(least, 0.5, 1e-8);
    }
    const Solution<Vec2> wide = checked_plan(obstacles, {1, 1}, {11, 9}, {.clearance = 0.501});
    EXPECT_NE(wide.outcome, Outcome::solved);
  }
}

TEST(MedialAxisPlanner, SolvesGridsExactlyWhereAFloodDoes) {
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const PolygonsInCells world(seed, 3 + static_cast<int>(seed % 6), seed % 2 == 0);
    const std::vector<int> regions = world.regions();
    Dice dice(seed);
    const int ax = dice.roll(world.side());
    const int ay = dice.roll(world.side());
    const int bx = dice.roll(world.side());
    const int by = dice.roll(world.side());
    Outcome expected =
        regions[world.square(ax, ay)] == regions[world.square(bx, by)] ? Outcome::solved : Outcome::not_connected;
    if (world.is_full(bx, by)) expected = Outcome::goal_blocked;
    if (world.is_full(ax, ay)) expected = Outcome::start_blocked;
    const Vec2 a{ax + 0.1 + 0.8 * dice.real(), ay + 0.1 + 0.8 * dice.real()};
    const Vec2 b{bx + 0.1 + 0.8 * dice.real(), by + 0.1 + 0.8 * dice.real()};
    EXPECT_EQ(checked_plan(world.obstacles(), a, b, {}).outcome, expected);
  }
}

TEST(MedialAxisPlanner, PathsAmongPolygonsAreVerifiedAndWidestIsWidest) {
  int narrower = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed, 3);
    if (obstacles.polygons.empty()) continue;
    const Vec2 start{-11.5, -11.25};
    const Vec2 goal{59.0, 59.5};
    MedialAxisPlan shortest, widest;
    ASSERT_EQ(checked_plan(obstacles, start, goal, {}, nullptr, &shortest).outcome, Outcome::solved);
    ASSERT_EQ(checked_plan(obstacles, start, goal, {.objective = AxisObjective::clearance}, nullptr, &widest).outcome,
              Outcome::solved);
    EXPECT_LE(shortest.axis_length, widest.axis_length * (1.0 + 1e-12));
    EXPECT_GE(widest.axis_clearance, shortest.axis_clearance);
    narrower += shortest.axis_clearance < widest.axis_clearance ? 1 : 0;
    // A disc that is a little larger than the widest way doesn't pass; ends are near the corner, so only the axis
    // counts.
    for (const SearchKind search : {SearchKind::dijkstra, SearchKind::bfs, SearchKind::dfs}) {
      MedialAxisPlan plan;
      ASSERT_EQ(checked_plan(obstacles, start, goal, {.search = search}, nullptr, &plan).outcome, Outcome::solved);
      EXPECT_GE(plan.axis_length, shortest.axis_length * (1.0 - 1e-12));
    }
  }
  EXPECT_GT(narrower, 0);
}

TEST(MedialAxisPlanner, DiscsPassUpToTheWidestWay) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneObstacles obstacles = disjoint_polygons(seed, 2);
    if (obstacles.polygons.empty()) continue;
    MedialAxisPlan plan;
    // From the retraction of one corner to that of another: both as wide as the axis there.
    const Vec2 start{-9.0, -9.0};
    const Vec2 goal{33.0, 33.0};
    const MedialAxisOptions widest{.objective = AxisObjective::clearance};
    double least = 0.0;
    if (checked_plan(obstacles, start, goal, widest, &least, &plan).outcome != Outcome::solved) continue;
    EXPECT_EQ(checked_plan(obstacles, start, goal, {.clearance = least * 0.999}).outcome, Outcome::solved);
    EXPECT_NE(checked_plan(obstacles, start, goal, {.clearance = least * 1.001}).outcome, Outcome::solved);
  }
}

TEST(CertainClearance, IsSureOfStraightGapsAndOfNothingNarrower) {
  const std::vector<Segment> walls{{{0, 0.1}, {10, 0.1}}, {{0, 0.7}, {10, 0.7}}, {{20, 0}, {30, 7}}};
  const WallIndex index(WallSet::narrowest(walls), {});
  const double y = 0.4;
  const double below = y - 0.1;  // rounded
  const double least = std::min(below, 0.7 - y);
  EXPECT_FALSE(certainly_keeps_clearance(index, {{1, y}, {9, y}}, std::nextafter(least, 1.0)));
  EXPECT_TRUE(certainly_keeps_clearance(index, {{1, y}, {9, y}}, std::nextafter(least, 0.0)));
  EXPECT_FALSE(certainly_keeps_clearance(index, {{1, 0.2}, {9, 0.8}}, 0.0));
  EXPECT_TRUE(certainly_keeps_clearance(index, {{1, 0.2}, {9, 0.6}}, 0.0));
  const double oblique = distance(Segment{{20, 1}, {30, 8}}, walls[2]);
  EXPECT_TRUE(certainly_keeps_clearance(index, {{20, 1}, {30, 8}}, oblique * 0.999999));
  EXPECT_FALSE(certainly_keeps_clearance(index, {{20, 1}, {30, 8}}, oblique * 1.000001));
}

TEST(MedialAxisPlanner, NamesBlockedEnds) {
  PlaneObstacles obstacles = course_walls();
  obstacles.polygons.add(std::vector<Vec2>{{20, 250}, {40, 250}, {30, 280}});
  const auto outcome = [&](Vec2 start, Vec2 goal, double clearance) {
    return checked_plan(obstacles, start, goal, {.clearance = clearance}).outcome;
  };
  EXPECT_EQ(outcome({30, 260}, {50, 50}, 0.0), Outcome::start_blocked);
  EXPECT_EQ(outcome({50, 50}, {30, 260}, 0.0), Outcome::goal_blocked);
  EXPECT_EQ(outcome({200, 50}, {50, 50}, 0.0), Outcome::start_blocked);  // on a wall
  EXPECT_EQ(outcome({50, 5}, {50, 50}, 6.0), Outcome::start_blocked);    // too near to the bounds
  EXPECT_EQ(outcome({-5, 5}, {50, 50}, 0.0), Outcome::start_blocked);
  EXPECT_THROW(outcome({50, 5}, {50, 50}, -1.0), InputError);
  EXPECT_EQ(checked_plan({}, {0, 0}, {1, 1}, {}).outcome, Outcome::solved);
}

TEST(MedialAxisPlanner, TellsHowFarApartTheEndsAre) {
  PlaneObstacles obstacles = course_walls();
  obstacles.walls.push_back({{400, 0}, {400, 100}});
  const Solution<Vec2> s = checked_plan(obstacles, {50, 50}, {750, 50}, {});
  EXPECT_EQ(s.outcome, Outcome::not_connected);
  EXPECT_GT(s.separation.start_size, 1U);
  EXPECT_GT(s.separation.goal_size, 1U);
  EXPECT_GT(s.separation.nearest_gap, 0.0);
}

TEST(MedialAxisPlanner, CrossingWallsAreObstaclesLikeOthers) {
  PlaneObstacles obstacles;
  obstacles.bounds = Box{{0, 0}, {10, 10}};
  obstacles.walls = {{{1, 1}, {9, 8.3}}, {{1, 8.7}, {9, 1.1}}, {{3, 3}, {3, 3}}};
  double least = 0.0;
  const Solution<Vec2> s = checked_plan(obstacles, {5, 1}, {5, 9}, {}, &least);
  EXPECT_EQ(s.outcome, Outcome::solved);
  EXPECT_GT(least, 0.4);
}

TEST(MedialAxisPlanner, AnswersAreTheSameForAnyNumberOfThreads) {
  const PlaneObstacles obstacles = disjoint_polygons(4, 20);
  const Solution<Vec2> one = plan_on_medial_axis(obstacles, {-11.5, -11.5}, {467.5, 467.5}, {}, {.threads = 1});
  ASSERT_EQ(one.outcome, Outcome::solved);
  for (const unsigned threads : {2U, 3U, 8U}) {
    EXPECT_EQ(plan_on_medial_axis(obstacles, {-11.5, -11.5}, {467.5, 467.5}, {}, {.threads = threads}).path, one.path);
  }
}

TEST(MedialAxisPlanner, StopsAtTheDeadline) {
  const Deadline over(0.0);
  const Solution<Vec2> s = plan_on_medial_axis(course_walls(), {50, 50}, {750, 50}, {}, {.deadline = &over});
  EXPECT_EQ(s.outcome, Outcome::stopped);
}

}  // namespace
}  // namespace warren
