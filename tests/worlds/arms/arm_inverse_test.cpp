// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/arm_kinematics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/seeds.hpp"
#include "tests/worlds/arms/random_arm.hpp"

namespace warren {
namespace {

/// Seven joints with the offsets of a well-known arm; 8: on a column that slides.
ArmModel redundant_arm(std::size_t variables) {
  constexpr double quarter = std::numbers::pi / 2.0;
  struct Row {
    double a, d, alpha, low, high;
  };
  constexpr std::array<Row, 7> rows{{{0, 0.333, 0, -2.9, 2.9},
                                     {0, 0, -quarter, -1.76, 1.76},
                                     {0, 0.316, quarter, -2.9, 2.9},
                                     {0.0825, 0, quarter, -3.07, -0.07},
                                     {-0.0825, 0.384, -quarter, -2.9, 2.9},
                                     {0, 0, quarter, -0.02, 3.75},
                                     {0.088, 0, quarter, -2.9, 2.9}}};
  ArmModel model;
  const auto add = [&](const Eigen::Isometry3d& origin, double low, double high, bool slides) {
    const std::size_t number = model.joints.size();
    ArmJoint joint;
    joint.parent = static_cast<int>(number) - 1;
    joint.origin = origin;
    joint.slides = slides;
    joint.variable = number;
    model.joints.push_back(joint);
    ArmVariable variable;
    variable.low = low;
    variable.high = high;
    variable.slides = slides;
    model.variables.push_back(variable);
  };
  if (variables == 8) add(Eigen::Isometry3d::Identity(), 0.0, 0.4, true);
  for (const Row& row : rows) {
    Eigen::Isometry3d origin(Eigen::AngleAxisd(row.alpha, Vec3::UnitX()));
    origin.translate(Vec3(row.a, 0.0, row.d));
    add(origin, row.low, row.high, false);
  }
  model.tool_frame = static_cast<int>(model.joints.size()) - 1;
  model.tool.translation().z() = 0.21;
  return model;
}

double place_error(const ArmModel& model, const JointState& q, const Eigen::Isometry3d& goal) {
  const Eigen::Matrix4d tool = random_arm::frame(model, q, model.tool_frame) * model.tool.matrix();
  return (tool.topRightCorner<3, 1>() - goal.translation()).norm();
}

double turn_error(const ArmModel& model, const JointState& q, const Eigen::Isometry3d& goal) {
  const Eigen::Matrix4d tool = random_arm::frame(model, q, model.tool_frame) * model.tool.matrix();
  return (tool.topLeftCorner<3, 3>() - goal.linear()).norm() / std::sqrt(2.0);
}

/// Goals that the arm reaches: how many of them are found, of how many?
void expect_found(const ArmModel& model, std::uint64_t goals, bool place_only, std::uint64_t most_missed = 0) {
  const ArmKinematics arm(model);
  std::uint64_t missed = 0;
  for (std::uint64_t i = 0; i < goals; ++i) {
    SCOPED_TRACE(i);
    const Eigen::Isometry3d pose = arm.tool_pose(random_arm::state(model, 77, i));
    const JointState seed = random_arm::state(model, 78, i);
    const auto found = postures_of_tool(arm, {pose, place_only}, seed, 2);
    missed += found.empty() ? 1 : 0;
    for (const JointState& q : found) {
      EXPECT_EQ(arm.variable_outside_limits(q), most_joints);
      EXPECT_LE(place_error(model, q, pose), 1e-9);
      if (!place_only) {
        EXPECT_LE(turn_error(model, q, pose), 1.1e-9);
      }
    }
  }
  EXPECT_LE(missed, most_missed) << model.variables.size();
}

TEST(ArmInverse, FindsWhatIsReached) {
  const std::uint64_t goals = test::share(200, 10);
  for (const bool place_only : {false, true}) {
    expect_found(redundant_arm(7), goals, place_only, goals / 100);
    expect_found(redundant_arm(8), goals, place_only, goals / 100);
    expect_found(random_arm::arm(5, 6, false), goals, place_only, goals / 100);
    expect_found(random_arm::arm(6, 6, false), goals, place_only, goals / 100);
    expect_found(random_arm::arm(7, 7, false), goals, place_only, goals / 100);
    expect_found(random_arm::arm(7, 14, true), goals, true, goals / 100);
  }
}

TEST(ArmInverse, NearestToTheSeedFirstAndNoneTwice) {
  const ArmModel model = random_arm::arm(5, 6, false);
  const ArmKinematics arm(model);
  const JointState reached = random_arm::state(model, 5, 5);
  JointState seed = reached;
  for (std::size_t i = 0; i < 6; ++i) seed[i] += 0.01;
  const auto found = postures_of_tool(arm, {arm.tool_pose(reached)}, seed, 8);
  ASSERT_GE(found.size(), 2U);
  const auto away = [&](const JointState& q) {
    double sum = 0.0;
    for (std::size_t v = 0; v < 6; ++v) sum += std::pow(variable_way(model.variables[v], seed[v], q[v]), 2);
    return sum;
  };
  EXPECT_LT(std::sqrt(away(found.front())), 0.1);
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_GE(away(found[i]), away(found[i - 1]));
    for (std::size_t k = 0; k < i; ++k) {
      double most = 0.0;
      for (std::size_t v = 0; v < 6; ++v) most = std::max(most, std::abs(found[i][v] - found[k][v]));
      EXPECT_GT(most, 1e-6);
    }
  }
}

TEST(ArmInverse, OutOfReachThereIsNone) {
  const ArmKinematics arm(redundant_arm(7));
  ToolGoal goal;
  goal.pose.translation() = Vec3(2.0, 0.0, 0.0);
  EXPECT_TRUE(postures_of_tool(arm, goal, {}, 4).empty());
  goal.place_only = true;
  EXPECT_TRUE(postures_of_tool(arm, goal, {}, 4).empty());
}

TEST(ArmInverse, HalfATurnAway) {
  const ArmModel model = redundant_arm(7);
  const ArmKinematics arm(model);
  const JointState q{0.1, 0.2, -0.3, -1.5, 0.2, 1.5, -1.5};
  JointState seed = q;
  seed[6] += std::numbers::pi;
  EXPECT_FALSE(postures_of_tool(arm, {arm.tool_pose(q)}, seed, 1).empty());
  EXPECT_FALSE(postures_of_tool(arm, {arm.tool_pose(q)}, q, 1).empty());
}

}  // namespace
}  // namespace warren
