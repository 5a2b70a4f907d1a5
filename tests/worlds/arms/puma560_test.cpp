// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/puma560.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/base/error.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"

namespace warren {
namespace {

using namespace arm_oracle;

constexpr double degree = std::numbers::pi / 180.0;

Eigen::Isometry3d pose_by_matrices(const DhTable& table, const JointState& q) {
  const Matrix m = frames(table, q).back();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) pose.matrix()(r, c) = m[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  }
  return pose;
}

double farthest(const JointState& a, const JointState& b) {
  double most = 0.0;
  for (std::size_t j = 0; j < a.size(); ++j) most = std::max(most, std::abs(a[j] - b[j]));
  return most;
}

TEST(Puma560Inverse, EveryBranchBringsTheToolThereAndOneIsTheStateItCameFrom) {
  for (const PumaLimits limits : {PumaLimits::classic, PumaLimits::symmetric}) {
    for (const double tool : {0.0, 0.2}) {
      const DhTable table = puma560_table(tool, limits);
      const SerialChain chain(table);
      for (std::uint64_t i = 0; i < 2000; ++i) {
        SCOPED_TRACE(i);
        const JointState q = random_state(table, 7, i);
        const Eigen::Isometry3d pose = pose_by_matrices(table, q);
        const std::vector<JointState> all = puma560_inverse(chain, pose);
        double nearest = 1e9;
        for (const JointState& found : all) {
          EXPECT_LT((pose_by_matrices(table, found).matrix() - pose.matrix()).cwiseAbs().maxCoeff(), 1e-9);
          EXPECT_EQ(chain.joint_outside_limits(found), most_joints);
          nearest = std::min(nearest, farthest(found, q));
        }
        EXPECT_LT(nearest, 1e-6);
      }
    }
  }
}

/// Free of limits there are eight branches; each angle has as many full turns as the limits hold.
TEST(Puma560Inverse, FindsEightBranchesAndTheirFullTurns) {
  DhTable table = puma560_table(0.1);
  for (DhJoint& joint : table.joints) {
    joint.low_rad = -std::numbers::pi;
    joint.high_rad = std::nextafter(std::numbers::pi, 0.0);
  }
  const SerialChain chain(table);
  const Eigen::Isometry3d pose = pose_by_matrices(table, {0.3, 0.4, 0.5, 0.6, 0.7, 0.8});
  const std::vector<JointState> all = puma560_inverse(chain, pose);
  EXPECT_EQ(all.size(), 8U);
  EXPECT_EQ(std::set<JointState>(all.begin(), all.end()).size(), 8U);
  table.joints[5].low_rad = -3.0 * std::numbers::pi;
  table.joints[5].high_rad = std::nextafter(3.0 * std::numbers::pi, 0.0);
  EXPECT_EQ(puma560_inverse(SerialChain(table), pose).size(), 24U);
}

TEST(Puma560Inverse, StraightWristAndEndsOfReachHaveFewerBranches) {
  const DhTable table = puma560_table();
  const SerialChain chain(table);
  for (const JointState& q :
       {JointState{0.2, 0.5, -0.4, 0.0, 0.0, 0.9}, JointState{0, 0, -std::numbers::pi / 2, 0, 0, 0}}) {
    const std::vector<JointState> all = puma560_inverse(chain, pose_by_matrices(table, q));
    ASSERT_FALSE(all.empty());
    for (const JointState& found : all) {
      EXPECT_LT((pose_by_matrices(table, found).matrix() - pose_by_matrices(table, q).matrix()).cwiseAbs().maxCoeff(),
                1e-7);
    }
  }
  Eigen::Isometry3d far = Eigen::Isometry3d::Identity();
  far.translation() = Vec3(1, 0, 0);
  EXPECT_TRUE(puma560_inverse(chain, far).empty());
  far.translation() = Vec3(0.1, 0, 0);  // nearer to the axis than the shoulder's offset
  EXPECT_TRUE(puma560_inverse(chain, far).empty());
}

/// The study's goal: its numeric solution is outside the limits, one closed-form branch is inside.
TEST(Puma560Inverse, TheStudysGoalHasOneBranchWithinTheLimits) {
  const SerialChain chain(puma560_table());
  const std::vector<JointState> all = puma560_inverse_place(chain, {0.5, 0.0, -0.5}, {0, 0, 0});
  ASSERT_EQ(all.size(), 1U);
  const JointState expected{17.5 * degree, -9.4 * degree, -161.1 * degree, 0, 0, 0};
  EXPECT_LT(farthest(all.front(), expected), 0.06 * degree);
}

TEST(Puma560Inverse, OfAPlaceKeepsTheWrist) {
  for (const double tool : {0.0, 0.25}) {
    const DhTable table = puma560_table(tool);
    const SerialChain chain(table);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      SCOPED_TRACE(i);
      const JointState q = random_state(table, 3, i);
      const Point place = points(table, q).back();
      const auto all = puma560_inverse_place(chain, {place[0], place[1], place[2]}, {q[3], q[4], q[5]});
      double nearest = 1e9;
      for (const JointState& found : all) {
        EXPECT_LT(apart(points(table, found).back(), place), 1e-9);
        EXPECT_EQ(found[3], q[3]);
        nearest = std::min(nearest, farthest(found, q));
      }
      EXPECT_LT(nearest, 1e-6);
    }
  }
}

TEST(Puma560Inverse, RefusesOtherArms) {
  EXPECT_FALSE(has_puma560_shape(SerialChain(puma560_modified_table())));
  EXPECT_THROW(puma560_inverse(SerialChain(puma560_modified_table()), Eigen::Isometry3d::Identity()), InputError);
  DhTable table = puma560_table();
  table.joints.pop_back();
  EXPECT_THROW(puma560_inverse_place(SerialChain(table), {0.5, 0, 0}, {0, 0, 0}), InputError);
}

TEST(Puma560, BothTablesAreOneArmToMillimetres) {
  const SerialChain standard(puma560_table());
  const SerialChain modified(puma560_modified_table());
  for (std::uint64_t i = 0; i < 100; ++i) {
    const JointState q = random_state(standard.table(), 5, i);
    // The modified table counts joint 3 from the other side; how joint 2 counts does not matter to the distance.
    const JointState p{q[0], q[1], q[2] + std::numbers::pi, q[3], q[4], q[5]};
    EXPECT_NEAR(standard.tool_pose(q).translation().norm(), modified.tool_pose(p).translation().norm(), 2e-3);
  }
}

}  // namespace
}  // namespace warren
