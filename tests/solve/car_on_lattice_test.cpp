// SPDX-License-Identifier: BSD-3-Clause
// Cars that planner grid solves, on maps and among walls and polygons: what it answers, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "solve/solve.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/poses/body_scenes.hpp"

namespace warren {
namespace {

RobotSpec car(SteeringKind steering) {
  return {.kind = RobotKind::car,
          .turning_radius = 0.4,
          .outline = {{-0.2, -0.15}, {0.4, -0.15}, {0.4, 0.15}, {-0.2, 0.15}},
          .steering = steering};
}

/// Two rooms of 20 x 20 cells of 0.1 m, with a door of so many cells between them.
Scene two_rooms(std::uint32_t door, Vec2 origin = {}) {
  Scene scene;
  scene.map.emplace();
  scene.map->cell = 0.1;
  scene.map->origin = origin;
  scene.map->blocked = Bitmap(41, 20);
  for (std::uint32_t y = 0; y < 20; ++y) {
    if (y < 10 || y >= 10 + door) scene.map->blocked.set(20, y);
  }
  return scene;
}

Question question(SteeringKind steering, Vec2 origin = {}) {
  return {.robot = car(steering),
          .start = {origin.x + 0.72, origin.y + 0.53, 0.2},
          .goal = {origin.x + 3.31, origin.y + 1.37, 0.9}};
}

SolveOptions options() { return {.planner = PlannerKind::grid}; }

TEST(CarOnLattice, DrivesThroughADoorThatIsWideEnoughAndIsVerified) {
  for (const SteeringKind steering : {SteeringKind::dubins, SteeringKind::reeds_shepp}) {
    for (const bool optimise : {false, true}) {
      SolveOptions asked = options();
      asked.optimise = optimise;
      const Answer answer = solve(two_rooms(6), question(steering), asked);
      ASSERT_EQ(answer.outcome, Outcome::solved);
      EXPECT_TRUE(answer.verified);
      EXPECT_EQ(answer.planner, "grid");
      EXPECT_GE(answer.length, 2.7);
      EXPECT_LE(answer.length, 4.5);
      ASSERT_TRUE(answer.lower_bound);
      EXPECT_LE(*answer.lower_bound, answer.length);
      EXPECT_FALSE(answer.price) << "nobody asked";
      EXPECT_FALSE(answer.improvements.empty());
      EXPECT_GT(answer.counters.edges_free, 0U);
      EXPECT_LT(answer.counters.edges_free, answer.counters.edges_checked) << "the door's posts are in the way of some";
    }
  }
}

TEST(CarOnLattice, IsNotConnectedWhereTheDoorIsTooNarrow) {
  const Answer answer = solve(two_rooms(2), question(SteeringKind::reeds_shepp), options());
  EXPECT_EQ(answer.outcome, Outcome::not_connected);
  EXPECT_TRUE(answer.states.empty());
}

TEST(CarOnLattice, SaysWhichEndIsBlocked) {
  Question asked = question(SteeringKind::dubins);
  asked.goal = {2.05, 0.3, 0.0};
  EXPECT_EQ(solve(two_rooms(6), asked, options()).outcome, Outcome::goal_blocked);
  asked.start = {2.05, 0.3, 0.0};
  EXPECT_EQ(solve(two_rooms(6), asked, options()).outcome, Outcome::start_blocked);
}

TEST(CarOnLattice, ShufflesOutOfABayAndIntoIt) {
  for (const bool is_out : {true, false}) {
    const Vec2 origin = is_out ? Vec2{-4e6, 3e5} : Vec2{};
    const body_scenes::ParkingBay bay = body_scenes::parking_bay(0.6, 1.0, origin);
    RobotSpec robot = car(SteeringKind::reeds_shepp);
    robot.turning_radius = 3.0;
    robot.outline = bay.car;
    const Se2& start = is_out ? bay.inside : bay.street;
    const Se2& goal = is_out ? bay.street : bay.inside;
    Question asked{.robot = robot, .start = {start.x, start.y, start.theta}, .goal = {goal.x, goal.y, goal.theta}};
    const Answer answer = solve(bay.scene, asked, options());
    ASSERT_EQ(answer.outcome, Outcome::solved);
    EXPECT_TRUE(answer.verified);
    const auto is_strokes = [](const NamedFigure& figure) { return figure.name == "strokes"; };
    EXPECT_TRUE(std::any_of(answer.figures.begin(), answer.figures.end(), is_strokes));
    asked.robot->steering = SteeringKind::dubins;
    EXPECT_EQ(solve(bay.scene, asked, options()).outcome, Outcome::not_connected) << "it can't back up";
  }
}

TEST(CarOnLattice, PricesAreWhatThePathPays) {
  SolveOptions asked = options();
  asked.car.cusp_cost = 0.7;
  asked.car.reverse_cost = 2.0;
  asked.grid.turn_cost = 0.1;
  Question behind = question(SteeringKind::reeds_shepp);
  behind.goal = {0.45, 1.37, 1.4};
  const Answer answer = solve(two_rooms(6), behind, asked);
  ASSERT_EQ(answer.outcome, Outcome::solved);
  ASSERT_TRUE(answer.price && answer.cost && answer.turn_rad);
  EXPECT_NEAR(answer.price->turning, 0.1 * *answer.turn_rad, 1e-12);
  EXPECT_NEAR(std::remainder(answer.price->cusps, 0.7), 0.0, 1e-12);
  EXPECT_EQ(*answer.cost, answer.length + answer.price->sum());
  EXPECT_LE(*answer.lower_bound, *answer.cost);
}

TEST(CarOnLattice, AGapOfZeroEndsAtTheOptimumAndRoundsAreCounted) {
  SolveOptions asked = options();
  asked.anytime.gap = 0.0;
  EXPECT_EQ(solve(two_rooms(6), question(SteeringKind::dubins), asked).ended_by, "lattice");
  asked.anytime.iterations = 1;
  const Answer one = solve(two_rooms(6), question(SteeringKind::dubins), asked);
  EXPECT_EQ(one.iterations, 1U);
  EXPECT_TRUE(one.verified);
}

TEST(CarOnLattice, DrivesFarFromTheOriginAndTurnedMapsToo) {
  for (const Vec2 origin : {Vec2{8.7e9, -3.1e9}, Vec2{-1e6, 5e5}}) {
    const Answer answer = solve(two_rooms(6, origin), question(SteeringKind::dubins, origin), options());
    ASSERT_EQ(answer.outcome, Outcome::solved);
    EXPECT_TRUE(answer.verified);
  }
  Scene turned = two_rooms(6);
  turned.map->yaw_rad = 0.7;
  Question asked = question(SteeringKind::reeds_shepp);
  for (std::vector<double>* pose : {&asked.start, &asked.goal}) {
    const double x = (*pose)[0];
    const double y = (*pose)[1];
    *pose = {std::cos(0.7) * x - std::sin(0.7) * y, std::sin(0.7) * x + std::cos(0.7) * y, (*pose)[2] + 0.7};
  }
  const Answer there = solve(turned, asked, options());
  const Answer here = solve(two_rooms(6), question(SteeringKind::reeds_shepp), options());
  ASSERT_EQ(there.outcome, Outcome::solved);
  EXPECT_NEAR(there.length, here.length, 0.05 * here.length);
}

TEST(CarOnLattice, DrivesAmongPolygonsNearAndFar) {
  for (const Vec2 origin : {Vec2{}, Vec2{8.7e9, 8.7e9}}) {
    Scene scene;
    scene.bounds = Box{origin, origin + Vec2{4.0, 2.0}};
    scene.polygons.push_back(
        {{origin + Vec2{1.9, 0.0}, origin + Vec2{2.1, 0.0}, origin + Vec2{2.1, 1.0}, origin + Vec2{1.9, 1.0}}});
    Question asked = question(SteeringKind::reeds_shepp, origin);
    asked.goal = {origin.x + 3.3, origin.y + 0.6, 0.0};
    const Answer answer = solve(scene, asked, options());
    ASSERT_EQ(answer.outcome, Outcome::solved) << origin.x;
    EXPECT_TRUE(answer.verified);
  }
}

TEST(CarOnLattice, AnyHeadingWillDoWhereTheGoalNamesNone) {
  Question asked = question(SteeringKind::dubins);
  asked.goal.pop_back();
  const Answer answer = solve(two_rooms(6), asked, options());
  ASSERT_EQ(answer.outcome, Outcome::solved);
  EXPECT_TRUE(answer.verified);
}

TEST(CarOnLattice, IsTheSameForAnyNumberOfThreads) {
  std::vector<std::vector<double>> paths;
  for (const unsigned threads : {1U, 2U, 3U}) {
    Limits limits;
    limits.threads = threads;
    SolveOptions asked = options();
    asked.optimise = true;
    paths.push_back(solve(two_rooms(6), question(SteeringKind::reeds_shepp), asked, limits).states.numbers);
  }
  EXPECT_FALSE(paths[0].empty());
  EXPECT_EQ(paths[0], paths[1]);
  EXPECT_EQ(paths[0], paths[2]);
}

TEST(CarOnLattice, RefusesWhatItHasNoUseFor) {
  SolveOptions asked = options();
  asked.grid.headings = 20;
  EXPECT_THROW(solve(two_rooms(6), question(SteeringKind::dubins), asked), UsageError);
  asked = options();
  asked.grid.cell = 0.2;
  EXPECT_THROW(solve(two_rooms(6), question(SteeringKind::dubins), asked), UsageError);
  asked = options();
  asked.car.cusp_cost = 1.0;
  EXPECT_THROW(solve(two_rooms(6), question(SteeringKind::dubins), asked), UsageError);
  asked = options();
  asked.trees.nodes = 100;
  EXPECT_THROW(solve(two_rooms(6), question(SteeringKind::dubins), asked), UsageError);
}

}  // namespace
}  // namespace warren
