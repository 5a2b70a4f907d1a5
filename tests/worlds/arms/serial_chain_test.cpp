// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/serial_chain.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/refusals.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"

namespace warren {
namespace {

using namespace arm_oracle;

constexpr double one_degree = std::numbers::pi / 180.0;

JointState degrees(const JointState& q) {
  JointState rad;
  for (std::size_t j = 0; j < q.size(); ++j) rad[j] = q[j] * one_degree;
  return rad;
}

TEST(SerialChain, PumaStandsWhereTheStandardPosesSay) {
  struct Pose {
    JointState q;
    Vec3 place;
  };
  // The toolbox prints five digits; the rest follows from the table by hand.
  const double s = std::sqrt(0.5);
  const double ahead = 0.4318 * s + 0.4318 * s - 0.0203 * s;
  const double up = 0.4318 * s - 0.4318 * s - 0.0203 * s;
  const Pose poses[] = {{{0, 0, 0, 0, 0, 0}, {0.45210, -0.15005, 0.43180}},
                        {{0, 90, -90, 0, 0, 0}, {0.02030, -0.15005, 0.86360}},
                        {{0, 0, -90, 0, 0, 0}, {0.86360, -0.15005, -0.02030}},
                        {{0, 45, 180, 0, 45, 0}, {ahead, -0.15005, up}}};
  EXPECT_NEAR(ahead, 0.59630, 5e-6);
  EXPECT_NEAR(up, -0.01435, 5e-6);
  const SerialChain chain(puma560_table());
  for (const Pose& pose : poses) {
    EXPECT_LT((chain.tool_pose(degrees(pose.q)).translation() - pose.place).cwiseAbs().maxCoeff(), 1e-12);
  }
}

void expect_same_frames(const DhTable& table, std::uint64_t seed) {
  const SerialChain chain(table);
  for (std::uint64_t i = 0; i < 50; ++i) {
    const JointState q = random_state(table, seed, i);
    const std::vector<Matrix> plain = frames(table, q);
    for (std::size_t number = 0; number <= table.joints.size(); ++number) {
      const Eigen::Matrix4d frame = chain.frame(q, number).matrix();
      for (std::size_t r = 0; r < 4; ++r) {
        for (std::size_t c = 0; c < 4; ++c) {
          EXPECT_NEAR(frame(static_cast<int>(r), static_cast<int>(c)), plain[number][r][c], 1e-12) << number;
        }
      }
    }
    const Vec3 tool = chain.tool_pose(q).translation();
    EXPECT_LT(apart(origin(plain.back()), {tool.x(), tool.y(), tool.z()}), 1e-12);
    for (const Matrix& m : plain) EXPECT_LE(apart(origin(m), {0, 0, 0}), chain.reach() + 1e-12);
  }
}

TEST(SerialChain, FramesAreThoseOfPlainMatricesAndWithinReach) {
  expect_same_frames(puma560_table(0.2), 1);
  expect_same_frames(modified_puma_table(0.2), 2);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    expect_same_frames(random_table(seed, seed % 2 == 0 ? DhConvention::standard : DhConvention::modified), seed);
  }
}

TEST(SerialChain, RefusesBadTables) {
  const auto refusal = [](const DhTable& table) {
    return test::refusal<InputError>([&] { const SerialChain chain(table); });
  };
  EXPECT_NE(refusal({}).find("from 1 to 6 joints"), std::string::npos);
  DhTable table = puma560_table();
  table.joints[2].a = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal(table).find("joint 3: lengths"), std::string::npos);
  table = puma560_table();
  table.joints[1].alpha_rad = std::nan("");
  EXPECT_NE(refusal(table).find("joint 2: angles"), std::string::npos);
  table = puma560_table();
  std::swap(table.joints[4].low_rad, table.joints[4].high_rad);
  EXPECT_NE(refusal(table).find("joint 5: the lower limit"), std::string::npos);
  table = puma560_table();
  table.joints.push_back(table.joints.back());
  EXPECT_NE(refusal(table).find("joints"), std::string::npos);
  table = puma560_table(std::nan(""));
  EXPECT_NE(refusal(table).find("tool"), std::string::npos);
}

}  // namespace
}  // namespace warren
