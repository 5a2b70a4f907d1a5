// SPDX-License-Identifier: BSD-3-Clause
// Several goals, tolerances and regions of bodies and worlds whose planners know one goal: against each goal by itself,
// and where a body's nearest place is known.
#include "solve/kinds/solve_to_goal.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/base/rng.hpp"
#include "solve/solve.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/test_scenes.hpp"

namespace warren {
namespace {

using test::scene_of;

constexpr double any_distance = std::numeric_limits<double>::infinity();

SolveOptions choosing_by(PlannerKind planner) {
  SolveOptions options;
  options.planner = planner;
  if (gets_better(planner)) options.anytime.iterations = 2;
  if (planner == PlannerKind::prm) options.roadmap.samples = 300;  // or it grows where a goal is hard to reach
  return options;
}

double cost_told(const Answer& answer) { return answer.cost.value_or(answer.length); }

/// Two rooms of 6 by 6, which a wall parts, with a door where that is said.
Scene rooms_with_wall(std::string_view robot, bool has_door) {
  std::string text = "bounds 0 0 12 6\npolygon 5.9 0 6.1 0 6.1 2.5 5.9 2.5\n";
  text += has_door ? "polygon 5.9 4.5 6.1 4.5 6.1 6 5.9 6\n" : "polygon 5.9 2.5 6.1 2.5 6.1 6 5.9 6\n";
  return scene_of(text + "robot " + std::string(robot) + "\n");
}

OccupancyMap rooms_of_cells() {
  OccupancyMap map;
  map.blocked = Bitmap(48, 24);
  map.cell = 0.25;
  for (std::uint32_t y = 0; y < 24; ++y) map.blocked.set(24, y);
  map.occupied = 24;
  map.free = map.blocked.size() - 24;
  return map;
}

constexpr std::string_view square_words = "polygon -0.3 -0.3 0.3 -0.3 0.3 0.3 -0.3 0.3";
constexpr std::string_view car_words = "car radius 0.3 turning 0.8";

TEST(SolveToGoal, OfSeveralGoalsTheCheapestIsReached) {
  for (const std::uint64_t seed : test::seeds(40, 1)) {
    for (const auto& [robot, planner] : {std::pair{std::string_view("point"), PlannerKind::visibility},
                                         {"point", PlannerKind::prm},
                                         {"point", PlannerKind::cells},
                                         {"disc 0.3", PlannerKind::voronoi},
                                         {square_words, PlannerKind::rrt_connect},
                                         {square_words, PlannerKind::grid},
                                         {square_words, PlannerKind::anytime},
                                         {car_words, PlannerKind::prm}}) {
      SCOPED_TRACE(std::string(robot) + ", " + std::string(name_of(planner)) + ", seed " + std::to_string(seed));
      const Scene scene = rooms_with_wall(robot, true);
      const bool turns = robot == square_words || robot == car_words;
      Question question;
      question.start = {1.0, 3.0};
      if (turns) question.start.push_back(0.0);
      std::vector<std::vector<double>> goals;
      for (std::uint64_t i = 0; i < 3; ++i) {
        goals.push_back({1.0 + 10.0 * uniform(seed, i, 0), 1.0 + 4.0 * uniform(seed, i, 1)});
      }
      goals.push_back({6.0, 1.0});  // in the wall
      std::optional<std::size_t> best;
      std::vector<Answer> alone;
      for (const std::vector<double>& goal : goals) {
        question.goal = goal;
        alone.push_back(solve(scene, question, choosing_by(planner)));
        const std::size_t last = alone.size() - 1;
        if (alone[last].verified && (!best || cost_told(alone[last]) < cost_told(alone[*best]))) best = last;
      }
      question.goal = goals[0];
      question.rule.others.assign(goals.begin() + 1, goals.end());
      const Answer answer = solve(scene, question, choosing_by(planner));
      ASSERT_EQ(answer.verified, best.has_value());
      if (!best) continue;
      EXPECT_EQ(answer.goal_index, *best);
      EXPECT_EQ(cost_told(answer), cost_told(alone[*best]));
      EXPECT_EQ(answer.problem.goal, goals[*best]);
      EXPECT_TRUE(verify(scene, answer).verified);
      EXPECT_EQ(answer.lower_bound.has_value(), planner != PlannerKind::grid) << "whose cost is in steps";
      if (!answer.lower_bound) continue;
      for (const Answer& one : alone) {
        if (one.verified) EXPECT_LE(*answer.lower_bound, cost_told(one) * (1.0 + 1e-9));
      }
    }
  }
}

/// A goal that is cut off does not take all the time of who gets better.
TEST(SolveToGoal, BetterWithTimeHasTimeForThePlaceNearby) {
  for (const std::string_view robot : {square_words, car_words}) {
    Scene scene = rooms_with_wall(robot, false);
    scene.grid = GridSpec{.cell = 0.2, .angles = 16};  // soon flooded, also on a machine that is slow
    Question question;
    question.start = {1.0, 3.0, 0.0};
    question.goal = {7.0, 3.0};
    question.rule.tolerance = any_distance;
    SolveOptions options;
    options.planner = PlannerKind::anytime;
    options.anytime.gap = 0.5;
    const Deadline deadline(8.0);
    const Answer answer = solve_within(scene, question, options, {.deadline = &deadline});
    ASSERT_EQ(answer.outcome, Outcome::solved) << robot;
    ASSERT_TRUE(answer.goal_reached);
    EXPECT_LT(answer.goal_reached->distance, 2.5);
    EXPECT_GT(answer.goal_reached->distance, 1.1) << "the wall is a unit away";
    EXPECT_TRUE(verify(scene, answer).verified);
  }
}

TEST(SolveToGoal, WithoutAWayWhatIsLeftOpenIsNotCalledProved) {
  const Scene scene = rooms_with_wall("point", false);
  Question question;
  question.start = {1.0, 3.0};
  question.goal = {6.0, 1.0};  // in the wall
  question.rule.others = {{6.0, 5.0}};
  EXPECT_EQ(solve(scene, question, choosing_by(PlannerKind::visibility)).outcome, Outcome::goal_blocked);
  question.rule.others = {{9.0, 5.0}};
  EXPECT_NE(solve(scene, question, choosing_by(PlannerKind::visibility)).outcome, Outcome::goal_blocked);
  question.start = {6.0, 3.0};
  EXPECT_EQ(solve(scene, question, choosing_by(PlannerKind::visibility)).outcome, Outcome::start_blocked);
}

/// The nearest place to one in the other room is by the wall.
TEST(SolveToGoal, ATolerancesNearestPlaceIsByTheWall) {
  Scene on_map;
  on_map.source = "rooms";
  on_map.map = rooms_of_cells();
  for (const std::string_view robot : {std::string_view("disc 0.3"), square_words, car_words}) {
    for (const bool is_map : {false, true}) {
      if (is_map && robot == "disc 0.3") continue;  // goals_on_map_test.cpp
      const Scene scene = is_map ? on_map : rooms_with_wall(robot, false);
      Question question;
      question.robot = robot_value("test", robot);
      question.start = {1.0, 3.0};
      if (robot != "disc 0.3") question.start.push_back(0.0);
      question.goal = {8.0, 3.0};
      question.rule.tolerance = any_distance;
      SCOPED_TRACE(std::string(robot) + (is_map ? " on a map" : ""));
      const Answer answer = solve(scene, question, choosing_by(PlannerKind::grid));
      ASSERT_TRUE(answer.verified);
      ASSERT_TRUE(answer.goal_reached);
      const double nearest = 2.0 + (is_map ? 0.0 : 0.1) + 0.3;
      EXPECT_GE(answer.goal_reached->distance, nearest);
      EXPECT_LE(answer.goal_reached->distance, nearest + 0.26);
      EXPECT_NEAR(distance(answer.path.back(), Vec2{8.0, 3.0}), answer.goal_reached->distance, 1e-9);
      EXPECT_EQ(answer.goal_reached->distance_bound.has_value(), is_map);
      EXPECT_LE(answer.goal_reached->distance_bound.value_or(0.0), answer.goal_reached->distance);
      EXPECT_TRUE(verify(scene, answer).verified);
      question.rule.tolerance = 2.2;
      const Answer too_near = solve(scene, question, choosing_by(PlannerKind::grid));
      EXPECT_FALSE(too_near.verified);
      EXPECT_NE(too_near.outcome, Outcome::goal_blocked);
    }
  }
}

TEST(SolveToGoal, AGoalThatIsReachedNeedsNoTolerance) {
  for (const PlannerKind planner : {PlannerKind::grid, PlannerKind::rrt_connect, PlannerKind::lazy_prm}) {
    SCOPED_TRACE(name_of(planner));
    const Scene scene = rooms_with_wall(square_words, true);
    Question question;
    question.start = {1.0, 3.0, 0.0};
    question.goal = {10.0, 2.0, 1.0};
    const Answer plain = solve(scene, question, choosing_by(planner));
    question.rule.tolerance = 1.0;
    const Answer answer = solve(scene, question, choosing_by(planner));
    ASSERT_TRUE(plain.verified && answer.verified);
    EXPECT_EQ(answer.length, plain.length);
    ASSERT_TRUE(answer.goal_reached);
    EXPECT_EQ(answer.goal_reached->distance, 0.0);
  }
}

TEST(SolveToGoal, ARegionsPathEndsInItWithItsHeading) {
  for (const std::string_view robot : {std::string_view("point"), square_words, car_words}) {
    for (const double off : {0.0, 0.5}) {
      SCOPED_TRACE(std::string(robot) + ", off by " + std::to_string(off));
      const Scene scene = rooms_with_wall(robot, true);
      const bool turns = robot != "point";
      Question question;
      question.start = {1.0, 3.0};
      question.goal = {10.0, 3.0};
      if (turns) question.start.push_back(0.0);
      if (turns) question.goal.push_back(0.3);
      question.rule.region = 1.0;
      if (turns) question.rule.heading_rad = off;
      const Answer answer = solve(scene, question, choosing_by(PlannerKind::grid));
      ASSERT_TRUE(answer.verified);
      EXPECT_LE(distance(answer.path.back(), Vec2{10.0, 3.0}), 1.0 + 1e-9);
      EXPECT_LT(answer.length, 9.0) << "straight on to the middle";
      if (answer.lower_bound) EXPECT_LE(*answer.lower_bound, answer.length);
      if (turns) {
        const double heading = answer.states[answer.states.size() - 1][2];
        EXPECT_LE(std::abs(turn_between(heading, 0.3)), off + 1e-6);
      }
    }
  }
}

TEST(SolveToGoal, WhoStartsInTheRegionStays) {
  const Scene scene = rooms_with_wall(square_words, true);
  Question question;
  question.start = {1.03, 3.04, 0.1};
  question.goal = {2.0, 3.0, 0.3};
  question.rule.region = 1.0;
  question.rule.heading_rad = 0.25;
  const Answer stays = solve(scene, question, choosing_by(PlannerKind::rrt_connect));
  ASSERT_TRUE(stays.verified);
  EXPECT_EQ(stays.length, 0.0);
  question.rule.heading_rad = 0.1;
  const Answer moves = solve(scene, question, choosing_by(PlannerKind::rrt_connect));
  ASSERT_TRUE(moves.verified);
  EXPECT_NE(moves.states.numbers, stays.states.numbers);
  ASSERT_TRUE(moves.lower_bound.has_value());
  EXPECT_LE(*moves.lower_bound, moves.length);
}

/// Into the other room.
Question question_across() { return {.start = {1.0, 3.0, 0.0}, .goal = {8.0, 3.0, 1.0}}; }

TEST(SolveToGoal, EqualForAnyNumberOfThreads) {
  const Scene scene = rooms_with_wall(car_words, false);
  Question question = question_across();
  question.rule.tolerance = 4.0;
  std::optional<Answer> first;
  for (const unsigned threads : {1U, 2U, 8U}) {
    SolveOptions options;
    options.trees.nodes = 300;  // the goal can't be reached
    const Answer answer = solve(scene, question, options, Limits{.threads = threads});
    ASSERT_TRUE(answer.verified);
    if (first) EXPECT_EQ(answer.states.numbers, first->states.numbers);
    if (!first) first = answer;
  }
}

TEST(SolveToGoal, WhatStopsItClaimsNothing) {
  const Scene scene = rooms_with_wall(car_words, false);
  Question question = question_across();
  question.rule.region = 3.0;
  const Answer answer = solve(scene, question, {}, Limits{.budget = std::chrono::nanoseconds(1)});
  EXPECT_EQ(answer.outcome, Outcome::stopped);
  EXPECT_FALSE(answer.verified);
  EXPECT_TRUE(answer.path.empty());
}

}  // namespace
}  // namespace warren
