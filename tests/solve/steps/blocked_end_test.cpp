// SPDX-License-Identifier: BSD-3-Clause
#include "solve/steps/blocked_end.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "scenes/formats/read_world_io.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"

namespace warren {
namespace {

Scene world(const std::string& name) { return read_world(test::source_dir() + "/examples/worlds/" + name); }

/// What is told of a blocked end; that the place it names is free, and as far as it says, is looked at.
BlockedEnd told(const Scene& scene, Question question) {
  const Answer answer = solve(scene, question);
  const bool is_start = answer.outcome == Outcome::start_blocked;
  EXPECT_TRUE(is_start || answer.outcome == Outcome::goal_blocked);
  if (!answer.blocked) {
    ADD_FAILURE() << "nothing is told";
    return {};
  }
  const BlockedEnd blocked = *answer.blocked;
  EXPECT_EQ(blocked.is_start, is_start);
  if (blocked.free_place.empty()) return blocked;
  std::vector<double>& end = is_start ? question.start : question.goal;
  const Question all = {.start = answer.problem.start, .goal = answer.problem.goal};
  const std::vector<double>& asked = is_start ? all.start : all.goal;
  EXPECT_NEAR(blocked.distance, std::hypot(blocked.free_place[0] - asked[0], blocked.free_place[1] - asked[1]), 1e-12);
  end = blocked.free_place;
  const Answer there = solve(scene, question);
  EXPECT_NE(there.outcome, is_start ? Outcome::start_blocked : Outcome::goal_blocked);
  return blocked;
}

TEST(BlockedEnd, NamesThePolygonAndTheNearestFreePlace) {
  const BlockedEnd blocked = told(world("town.geojson"), {.start = {3, 2.5}, .goal = {9.5, 8.5}});
  EXPECT_TRUE(blocked.by.starts_with("polygon 0")) << blocked.by;
  EXPECT_NEAR(blocked.distance, 0.5, 0.02);
}

TEST(BlockedEnd, NamesTheWallThatABodyStandsIn) {
  const BlockedEnd blocked = told(world("walls.scene"), {.start = {200, 50, 0}});
  EXPECT_TRUE(blocked.by.starts_with("wall 0")) << blocked.by;
  EXPECT_NEAR(blocked.distance, 25.0, 1.5);
  EXPECT_EQ(blocked.free_place.size(), 3U);
}

TEST(BlockedEnd, SaysWhatIsOutsideAndWhereTheInsideIs) {
  const BlockedEnd blocked = told(world("walls.scene"), {.goal = {500, 5000, 0}});
  EXPECT_TRUE(blocked.by.starts_with("outside of the bounds 0 0 800 300")) << blocked.by;
  EXPECT_FALSE(blocked.is_start);
  EXPECT_NEAR(blocked.distance, 4725.0, 30.0);
}

TEST(BlockedEnd, GuessesThatRowsAndColumnsWereSwapped) {
  EXPECT_NE(told(world("walls.scene"), {.start = {50, 700, 0}}).hint.find("700,50 is free"), std::string::npos);
  EXPECT_EQ(told(world("walls.scene"), {.start = {200, 50, 0}}).hint, "");
}

TEST(BlockedEnd, NamesTheCellOfAMap) {
  const Question question{
      .robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.2}, .start = {0.05, 0.5}, .goal = {4.3, 0.5}};
  const BlockedEnd blocked = told(world("flat.yaml"), question);
  EXPECT_TRUE(blocked.by.starts_with("cell ")) << blocked.by;
  EXPECT_NEAR(blocked.distance, 0.25, 0.06);
}

TEST(BlockedEnd, NamesTheJointAndItsLimitsAndGuessesDegrees) {
  const BlockedEnd blocked = told(world("puma-seed.scene"), {.goal = {90, 0, 0, 0, 0, 0}});
  EXPECT_NE(blocked.by.find("joint 1"), std::string::npos) << blocked.by;
  EXPECT_NE(blocked.hint.find("90deg"), std::string::npos);
  EXPECT_TRUE(blocked.free_place.empty());
}

TEST(BlockedEnd, HoldsInLargeMazesAndForCars) {
  const BlockedEnd wall = told(read_world("maze:300x300"), {.start = {20, 20}, .goal = {2.5, 2.51}});
  EXPECT_TRUE(wall.by.starts_with("wall ")) << wall.by;
  EXPECT_LT(wall.distance, 0.2);
  told(world("car-20.scene"), {.goal = {8.9, 0.25, 1.57}});
}

TEST(BlockedEnd, IsNotToldOfOtherAnswers) { EXPECT_FALSE(solve(world("walls.scene")).blocked.has_value()); }

}  // namespace
}  // namespace warren
