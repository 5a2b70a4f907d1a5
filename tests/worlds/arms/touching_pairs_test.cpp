// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/serial_chain.hpp"

#include <gtest/gtest.h>

#include "tests/worlds/arms/random_arm.hpp"

namespace warren {
namespace {

Solid ball(double x, double radius) {
  Solid made;
  made.pose.translation().x() = x;
  made.half.x() = radius;
  return made;
}

TEST(TouchingPairs, AreLeftOutAndTold) {
  ArmModel model;
  for (int i = 0; i < 2; ++i) {
    ArmVariable variable;
    variable.low = -2.0;
    variable.high = 2.0;
    model.variables.push_back(variable);
    ArmJoint joint;
    joint.parent = i - 1;
    joint.origin.translation().x() = i;
    joint.variable = static_cast<std::size_t>(i);
    model.joints.push_back(joint);
  }
  model.links = {{"base", base_frame, {ball(0.0, 0.2)}},
                 {"hub", 0, {ball(0.1, 0.2)}},   // always in the base
                 {"arm", 0, {ball(1.0, 0.2)}},   // with the hub in one frame
                 {"hand", 1, {ball(1.0, 0.2)}},  // may touch the base, but need not
                 {"ring", 1, {ball(5.0, 0.1), ball(0.05, 0.2)}}};
  model.pairs = {{0, 1}, {0, 3}, {1, 2}, {2, 3}, {2, 4}};
  leave_out_touching(model);
  EXPECT_EQ(model.pairs, (std::vector<LinkPair>{{0, 3}, {2, 3}}));
  EXPECT_EQ(model.assumed, (std::vector<std::string>{
                               "base and hub touch in every posture that was tried: not checked against each other",
                               "arm and ring touch in every posture that was tried: not checked against each other"}));
}

}  // namespace
}  // namespace warren
