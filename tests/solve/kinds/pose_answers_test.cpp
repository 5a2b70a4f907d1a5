// SPDX-License-Identifier: BSD-3-Clause
// Cars and turning bodies where nothing is in their way: the answer is as short, and turns as little, as it can.
#include <gtest/gtest.h>

#include "solve/solve.hpp"

namespace warren {
namespace {

Answer driven_in_a_yard(Vec2 corner, PlannerKind planner) {
  Scene yard;
  yard.bounds = Box{corner, corner + Vec2{29.5, 28.5}};
  yard.robot = RobotSpec{.kind = RobotKind::car, .radius = 0.3, .turning_radius = 1.5};
  SolveOptions options;
  options.planner = planner;
  const Question question{.start = {corner.x + 13.0, corner.y + 15.5, 0.3},
                          .goal = {corner.x + 16.5, corner.y + 13.0, -2.5}};
  return solve(yard, question, options);
}

TEST(Cars, DriveAsFarInAnEmptyYardInUtmMetresAsAtTheOrigin) {
  using enum PlannerKind;
  for (const PlannerKind planner : {prm, lazy_prm, rrt, rrt_connect}) {
    SCOPED_TRACE(name_of(planner));
    const Answer far = driven_in_a_yard({388083.25, 3948980.75}, planner);
    EXPECT_TRUE(far.verified);
    EXPECT_NEAR(far.length, driven_in_a_yard({}, planner).length, 1e-6);
    if (planner == prm) EXPECT_NEAR(far.length, 6.36321059, 1e-7);
  }
}

TEST(Turning, GoalsOfAnyHeadingInTheOpenTurnNothing) {
  Scene open;
  open.bounds = Box{{0, 0}, {40, 40}};
  open.robot = RobotSpec{.kind = RobotKind::polygon, .outline = {{-1, -0.5}, {1, -0.5}, {1, 0.5}, {-1, 0.5}}};
  for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::lazy_prm}) {
    SolveOptions options;
    options.planner = planner;
    const Answer answer = solve(open, {.start = {15, 20, 0}, .goal = {25, 20}}, options);
    ASSERT_TRUE(answer.verified);
    EXPECT_EQ(answer.states[answer.states.size() - 1][2], 0.0) << name_of(planner);
  }
}

}  // namespace
}  // namespace warren
