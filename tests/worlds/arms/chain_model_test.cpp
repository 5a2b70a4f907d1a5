// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/serial_chain.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"
#include "worlds/arms/arm_kinematics.hpp"

namespace warren {
namespace {

DhTable table_of(std::uint64_t seed) {
  DhTable table = arm_oracle::random_table(seed, seed % 2 == 0 ? DhConvention::standard : DhConvention::modified);
  if (table.joints.size() > most_chain_joints) table.joints.resize(most_chain_joints);
  return table;
}

/// The ends of all capsules, at q.
std::vector<std::array<Vec3, 2>> capsules(const ArmKinematics& arm, const JointState& q) {
  ArmPosture posture;
  arm.place(q, posture);
  std::vector<std::array<Vec3, 2>> all;
  for (const ArmLink& link : arm.model().links) {
    const Solid& capsule = link.solids.front();
    const MovingFrame& frame = ArmKinematics::frame(posture, link.frame);
    const auto end = [&](double side) -> Vec3 {
      return frame.at + frame.turn * (capsule.pose * Vec3(0.0, 0.0, side * capsule.half.z()));
    };
    all.push_back({end(-1.0), end(1.0)});
  }
  return all;
}

TEST(ChainModel, StandsWhereTheTableSays) {
  for (const std::uint64_t seed : test::seeds(200, 50)) {
    SCOPED_TRACE(seed);
    const DhTable table = table_of(seed);
    const SerialChain chain(table);
    if (arm_oracle::spines(table, {}).empty()) continue;
    const ArmModel model = model_of(table, 0.05, true);
    EXPECT_EQ(model.variables.size(), most_chain_joints);
    const ArmKinematics arm(model);
    for (std::uint64_t i = 0; i < 3; ++i) {
      const JointState q = arm_oracle::random_state(table, seed, i);
      EXPECT_EQ(arm.variable_outside_limits(q), most_joints);
      EXPECT_LT((arm.tool_pose(q).matrix() - chain.tool_pose(q).matrix()).norm(), 1e-12);
      const auto spines = arm_oracle::spines(table, q);
      const auto ends = capsules(arm, q);
      ASSERT_EQ(spines.size(), ends.size());
      for (std::size_t k = 0; k < ends.size(); ++k) {
        for (std::size_t end = 0; end < 2; ++end) {
          const arm_oracle::Point& p = spines[k][end];
          EXPECT_LT((ends[k][end] - Vec3(p[0], p[1], p[2])).norm(), 1e-12);
        }
      }
    }
    for (std::size_t j = 0; j < most_chain_joints; ++j) {
      if (arm.moves(j)) continue;
      JointState q = arm_oracle::random_state(table, seed, 0);
      const auto before = capsules(arm, q);
      q[j] += 1.0;
      const auto after = capsules(arm, q);
      for (std::size_t k = 0; k < after.size(); ++k) {
        for (std::size_t end = 0; end < 2; ++end) EXPECT_LT((after[k][end] - before[k][end]).norm(), 1e-12);
      }
    }
  }
}

TEST(ChainModel, APumaWithoutAToolHasIdleWrist) {
  const ArmKinematics arm(model_of(puma560_table(0.0), 0.05, true));
  for (std::size_t j = 0; j < 6; ++j) EXPECT_EQ(arm.moves(j), j < 3);
  EXPECT_EQ(arm.model().variables[2].name, "joint 3");
  EXPECT_EQ(arm.model().links.front().name, "link 0");
}

TEST(ChainModel, NeighboursAreNoPair) {
  DhTable table;
  for (const double a : {0.5, 0.05, 0.5, 0.5}) table.joints.push_back({0.0, a, 0.0, -1.0, 1.0, 0.0});
  EXPECT_TRUE(model_of(table, 0.05, false).pairs.empty());
  EXPECT_EQ(model_of(table, 0.05, true).pairs, (std::vector<LinkPair>{{0, 3}, {1, 3}}));
  EXPECT_EQ(model_of(table, 0.02, true).pairs, (std::vector<LinkPair>{{0, 2}, {0, 3}, {1, 3}}));
  EXPECT_EQ(model_of(table, 0.02, true, 0.02).pairs, (std::vector<LinkPair>{{0, 3}, {1, 3}}));
}

TEST(ChainModel, RefusesWhatHasNoLinkOrNoRadius) {
  DhTable table;
  table.joints.push_back({0.0, 0.0, 0.0, -1.0, 1.0, 0.0});
  EXPECT_THROW(model_of(table, 0.05, false), InputError);
  table.joints.front().a = 1.0;
  EXPECT_THROW(model_of(table, -0.05, false), InputError);
  EXPECT_EQ(model_of(table, 0.0, false).links.size(), 1U);
}

}  // namespace
}  // namespace warren
