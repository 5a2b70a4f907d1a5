// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/serial_chain.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/base/error.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"

namespace warren {
namespace {

using namespace arm_oracle;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double whole_turn = 2.0 * std::numbers::pi;

double farthest(const JointState& a, const JointState& b) {
  double most = 0.0;
  for (std::size_t j = 0; j < a.size(); ++j) most = std::max(most, std::abs(a[j] - b[j]));
  return most;
}

std::vector<JointState> states_at(const DhTable& table, const Point& place, const JointState& q) {
  return puma560_inverse_place(SerialChain(table), {place[0], place[1], place[2]}, {q[3], q[4], q[5]});
}

TEST(Puma560Inverse, EveryBranchBringsTheToolThereAndOneIsTheStateItCameFrom) {
  for (const PumaLimits limits : {PumaLimits::classic, PumaLimits::symmetric}) {
    for (const double tool : {0.0, 0.25}) {
      const DhTable table = puma560_table(tool, limits);
      for (std::uint64_t i = 0; i < 2000; ++i) {
        SCOPED_TRACE(i);
        const JointState q = random_state(table, 7, i);
        const Point place = points(table, q).back();
        double nearest = 1e9;
        for (const JointState& found : states_at(table, place, q)) {
          EXPECT_LT(apart(points(table, found).back(), place), 1e-9);
          EXPECT_TRUE(is_within_limits(table, found));
          for (std::size_t j = 3; j < 6; ++j) EXPECT_NEAR(std::remainder(found[j] - q[j], whole_turn), 0.0, 1e-12);
          nearest = std::min(nearest, farthest(found, q));
        }
        EXPECT_LT(nearest, 1e-6);
      }
    }
  }
}

/// Free of limits there are four branches; each angle has as many full turns as the limits hold.
TEST(Puma560Inverse, FindsFourBranchesAndTheirFullTurns) {
  DhTable table = puma560_table(0.1);
  for (DhJoint& joint : table.joints) {
    joint.low_rad = -std::numbers::pi;
    joint.high_rad = std::nextafter(std::numbers::pi, 0.0);
  }
  const JointState q{0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
  const Point place = points(table, q).back();
  const std::vector<JointState> all = states_at(table, place, q);
  EXPECT_EQ(all.size(), 4U);
  EXPECT_EQ(std::set<JointState>(all.begin(), all.end()).size(), 4U);
  table.joints[5].low_rad = -3.0 * std::numbers::pi;
  table.joints[5].high_rad = std::nextafter(3.0 * std::numbers::pi, 0.0);
  EXPECT_EQ(states_at(table, place, q).size(), 12U);
}

TEST(Puma560Inverse, OfTheEndOfTheReachAndBeyond) {
  const DhTable table = puma560_table();
  const JointState stretched{0, 0, -std::atan2(0.4318, 0.0203), 0, 0, 0};
  const Point place = points(table, stretched).back();
  const std::vector<JointState> all = states_at(table, place, stretched);
  ASSERT_FALSE(all.empty());
  for (const JointState& found : all) EXPECT_LT(apart(points(table, found).back(), place), 1e-7);
  EXPECT_TRUE(states_at(table, {1, 0, 0}, {}).empty());
  EXPECT_TRUE(states_at(table, {0.1, 0, 0}, {}).empty()) << "nearer to the axis than the shoulder's offset";
}

/// The study's goal: its numeric solution is outside the limits, one closed-form branch is inside.
TEST(Puma560Inverse, TheStudysGoalHasOneBranchWithinTheLimits) {
  const std::vector<JointState> all = states_at(puma560_table(), {0.5, 0.0, -0.5}, {});
  ASSERT_EQ(all.size(), 1U);
  const JointState expected{17.5 * degree, -9.4 * degree, -161.1 * degree, 0, 0, 0};
  EXPECT_LT(farthest(all.front(), expected), 0.06 * degree);
}

TEST(Puma560Inverse, RefusesOtherArms) {
  EXPECT_FALSE(has_puma560_shape(SerialChain(modified_puma_table())));
  EXPECT_THROW(states_at(modified_puma_table(), {0.5, 0, 0}, {}), InputError);
  DhTable table = puma560_table();
  table.joints.pop_back();
  EXPECT_THROW(states_at(table, {0.5, 0, 0}, {}), InputError);
}

TEST(Puma560, BothTablesAreOneArmToMillimetres) {
  const SerialChain standard(puma560_table());
  const SerialChain modified(modified_puma_table());
  for (std::uint64_t i = 0; i < 100; ++i) {
    const JointState q = random_state(standard.table(), 5, i);
    // The modified table counts joint 3 from the other side; how joint 2 counts does not matter to the distance.
    const JointState p{q[0], q[1], q[2] + std::numbers::pi, q[3], q[4], q[5]};
    EXPECT_NEAR(standard.tool_pose(q).translation().norm(), modified.tool_pose(p).translation().norm(), 2e-3);
  }
}

}  // namespace
}  // namespace warren
