// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/arm_kinematics.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/error.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/arms/random_arm.hpp"

namespace warren {
namespace {

using random_arm::Draw;

/// A point of a core that is fixed in its link's frame: an end of a random direction.
Vec3 core_point(const ArmLink& link, Draw& draw) {
  std::size_t near = 0;
  return ConvexBody(link.solids[draw.below(link.solids.size())]).core_support(draw.vector(), near);
}

Vec3 place_of(const ArmModel& model, const JointState& q, int frame, const Vec3& point) {
  return (random_arm::frame(model, q, frame) * point.homogeneous()).head<3>();
}

TEST(ArmKinematics, FramesAreMatricesMultipliedOut) {
  for (const std::uint64_t seed : test::seeds(80, 20)) {
    SCOPED_TRACE(seed);
    const ArmModel model = random_arm::arm(seed, 1 + seed % 14, true);
    const ArmKinematics arm(model);
    const JointState q = random_arm::state(model, seed, 1);
    ArmPosture posture;
    arm.place(q, posture);
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      const Eigen::Matrix4d frame = random_arm::frame(model, q, static_cast<int>(j));
      EXPECT_LT((posture[j].turn - frame.topLeftCorner<3, 3>()).norm(), 1e-13);
      EXPECT_LT((posture[j].at - frame.topRightCorner<3, 1>()).norm(), 1e-13);
    }
    const Eigen::Matrix4d tool = random_arm::frame(model, q, model.tool_frame) * model.tool.matrix();
    EXPECT_LT((arm.tool_pose(q).matrix() - tool).norm(), 1e-13);
  }
}

TEST(ArmKinematics, NothingReachesFartherFromTheBase) {
  double most = 0.0;
  for (const std::uint64_t seed : test::seeds(40, 10)) {
    SCOPED_TRACE(seed);
    const ArmModel model = random_arm::arm(seed, 1 + seed % 6, true);
    const ArmKinematics arm(model);
    Draw draw(seed + 2000);
    for (std::uint64_t i = 0; i < 40; ++i) {
      const JointState q = random_arm::state(model, seed, i);
      const ArmLink& link = model.links[draw.below(model.links.size())];
      const double away = place_of(model, q, link.frame, core_point(link, draw)).norm();
      EXPECT_LE(away, arm.reach());
      EXPECT_LE(arm.tool_pose(q).translation().norm(), arm.reach());
      most = std::max(most, away / arm.reach());
    }
  }
  EXPECT_GT(most, 0.6) << "no more than what is needed";
}

TEST(ArmKinematics, TheToolGoesNoFartherThanAVariableBringsIt) {
  double most = 0.0;
  for (const std::uint64_t seed : test::seeds(40, 10)) {
    SCOPED_TRACE(seed);
    const ArmModel model = random_arm::arm(seed, 1 + seed % 6, true);
    const ArmKinematics arm(model);
    for (std::size_t i = 0; i < 10 * arm.size(); ++i) {
      const std::size_t variable = i % arm.size();
      JointState q = random_arm::state(model, seed, i);
      const Vec3 from = arm.tool_pose(q).translation();
      const double way = 1e-3 * (model.variables[variable].high - q[variable]);
      q[variable] += way;
      const double gone = (arm.tool_pose(q).translation() - from).norm();
      EXPECT_LE(gone, way * arm.tool_reach(variable) + 1e-14);
      if (gone > 0.0) most = std::max(most, gone / (way * arm.tool_reach(variable)));
    }
  }
  EXPECT_GT(most, 0.95) << "no more than what is needed";
}

TEST(ArmKinematics, TellsWhatIsBeyondTheLimits) {
  ArmModel model = random_arm::arm(1, 3, false);
  model.variables[0].continuous = false;
  model.variables[1].continuous = true;
  model.variables[2].continuous = false;
  const ArmKinematics arm(model);
  const double high = model.variables[2].high;
  EXPECT_EQ(arm.variable_outside_limits({0.0, 50.0, high}), most_joints);
  EXPECT_EQ(arm.variable_outside_limits({0.0, 50.0, high + 1e-11}), 2U);
  EXPECT_EQ(arm.variable_outside_limits({model.variables[0].low - 0.1, 0.0, 99.0}), 0U);
  EXPECT_EQ(arm.variable_outside_limits({0.0, std::numeric_limits<double>::quiet_NaN(), 0.0}), 1U);
  EXPECT_EQ(arm.variable_outside_limits({0.0, 0.0, 0.0, 0.0, 1e-6}), 4U);
}

TEST(ArmKinematics, AJointThatMovesNothingIsIdle) {
  ArmModel model = random_arm::arm(1, 2, false);
  model.links.clear();
  model.tool.translation() = 0.3 * model.joints[1].axis;
  EXPECT_TRUE(ArmKinematics(model).moves(0));
  EXPECT_FALSE(ArmKinematics(model).moves(1)) << "the tool lies on its axis";
  model.tool.translation() = Vec3(0.3, 0.2, 0.1);
  EXPECT_TRUE(ArmKinematics(model).moves(1));
  EXPECT_FALSE(ArmKinematics(model).moves(2));
}

TEST(ArmKinematics, RefusesWhatIsNoTree) {
  const ArmModel good = random_arm::arm(1, 3, false);
  ArmModel bad = good;
  bad.joints[1].parent = 1;
  EXPECT_THROW(ArmKinematics{bad}, InputError);
  bad = good;
  bad.joints[2].variable = 3;
  EXPECT_THROW(ArmKinematics{bad}, InputError);
  bad = good;
  bad.variables.clear();
  EXPECT_THROW(ArmKinematics{bad}, InputError);
  bad = good;
  bad.variables[0].low = 5.0;
  EXPECT_THROW(ArmKinematics{bad}, InputError);
  bad = good;
  bad.pairs = {{1, 1}};
  EXPECT_THROW(ArmKinematics{bad}, InputError);
  bad = good;
  bad.joints[0].axis *= 2.0;
  EXPECT_THROW(ArmKinematics{bad}, InputError);
}

}  // namespace
}  // namespace warren
