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
  return ConvexBody(link.solids[draw.below(link.solids.size())]).core_support(draw.vector());
}

Vec3 place_of(const ArmModel& model, const JointState& q, int frame, const Vec3& point) {
  return (random_arm::frame(model, q, frame) * point.homogeneous()).head<3>();
}

JointState after(const JointState& q, const JointState& way, double t) {
  JointState to;
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = q[i] + t * way[i];
  return to;
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

TEST(ArmKinematics, VelocitiesAndBendsBoundWhatPointsDo) {
  double nearest = 0.0;
  for (const std::uint64_t seed : test::seeds(80, 20)) {
    SCOPED_TRACE(seed);
    const ArmModel model = random_arm::arm(seed, 1 + seed % 9, true);
    const ArmKinematics arm(model);
    Draw draw(seed + 1000);
    for (std::size_t link = 0; link < model.links.size(); ++link) {
      const int frame = model.links[link].frame;
      const JointState q = random_arm::state(model, seed, link);
      JointState way{};
      for (std::size_t i = 0; i < arm.size(); ++i) way[i] = draw.number();
      const Vec3 point = core_point(model.links[link], draw);
      const auto at = [&](double t) { return place_of(model, after(q, way, t), frame, point); };
      ArmPosture posture;
      arm.place(q, posture);
      arm.move(way, posture);
      const MovingFrame& moving = ArmKinematics::frame(posture, frame);
      const double h = 1e-4;
      const Vec3 velocity = moving.velocity + moving.spin.cross(moving.turn * point);
      EXPECT_LT(((at(h) - at(-h)) / (2.0 * h) - velocity).norm(), 1e-6);
      const double acceleration = ((at(h) - 2.0 * at(0.0) + at(-h)) / (h * h)).norm();
      const double bend = arm.bend(link, way);
      EXPECT_LE(acceleration, bend + 1e-6);
      if (bend > 0.1) nearest = std::max(nearest, acceleration / bend);
      EXPECT_LE((at(0.3) - at(0.0)).norm(), 0.3 * arm.travel(link, way) + 1e-12);
    }
  }
  EXPECT_GT(nearest, 0.5) << "no more than what is needed";
}

TEST(ArmKinematics, OfASetOfJointsTheOthersAreAtRest) {
  const ArmModel model = random_arm::arm(3, 7, true);
  const ArmKinematics arm(model);
  const JointState q = random_arm::state(model, 3, 1);
  JointState way{};
  way.fill(0.7);
  ArmPosture posture;
  arm.place(q, posture);
  for (std::size_t a = 0; a < model.links.size(); ++a) {
    for (std::size_t b = a + 1; b < model.links.size(); ++b) {
      const JointSet between = arm.joints_between(model.links[a].frame, model.links[b].frame);
      arm.move(way, posture, between);
      const auto seen = [&](double t) {
        const JointState at = after(q, way, t);
        const Eigen::Matrix4d inverse = random_arm::frame(model, at, model.links[a].frame).inverse();
        return Vec3((inverse * random_arm::frame(model, at, model.links[b].frame)).topRightCorner<3, 1>());
      };
      const MovingFrame& of_a = ArmKinematics::frame(posture, model.links[a].frame);
      const MovingFrame& of_b = ArmKinematics::frame(posture, model.links[b].frame);
      const Vec3 against = of_b.velocity - of_a.velocity - of_a.spin.cross(of_b.at - of_a.at);
      EXPECT_LT(((seen(1e-5) - seen(-1e-5)) / 2e-5 - of_a.turn.transpose() * against).norm(), 1e-7);
      EXPECT_LE(arm.bend(a, way, between), arm.bend(a, way) + 1e-12);
    }
  }
}

TEST(ArmKinematics, NothingReachesFartherFromAnAxis) {
  double most = 0.0;
  for (const std::uint64_t seed : test::seeds(40, 10)) {
    SCOPED_TRACE(seed);
    const ArmModel model = random_arm::arm(seed, 1 + seed % 6, true);
    const ArmKinematics arm(model);
    Draw draw(seed + 2000);
    for (std::uint64_t i = 0; i < 40; ++i) {
      const JointState q = random_arm::state(model, seed, i);
      const std::size_t link = draw.below(model.links.size());
      const Vec3 point = place_of(model, q, model.links[link].frame, core_point(model.links[link], draw));
      for (std::size_t j = 0; j < model.joints.size(); ++j) {
        const bool above = (arm.joints_above(model.links[link].frame) >> j & 1U) != 0;
        EXPECT_EQ(arm.reach(j, link) > 0.0, above);
        if (!above || model.joints[j].slides) continue;
        const Eigen::Matrix4d frame = random_arm::frame(model, q, static_cast<int>(j));
        const Vec3 axis = frame.topLeftCorner<3, 3>() * model.joints[j].axis;
        const double away = axis.cross(point - frame.topRightCorner<3, 1>()).norm();
        EXPECT_LE(away, arm.reach(j, link));
        most = std::max(most, away / arm.reach(j, link));
      }
    }
  }
  EXPECT_GT(most, 0.95);
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
