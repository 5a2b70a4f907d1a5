// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/serial_chain.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"
#include "worlds/arms/puma560.hpp"

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
    ChainPosture at;
    chain.place(degrees(pose.q), at);
    EXPECT_LT((at.points[6] - pose.place).cwiseAbs().maxCoeff(), 1e-12);
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
    ChainPosture at;
    chain.place(q, at);
    for (std::size_t point = 0; point < chain.point_count(); ++point) {
      const Point p = origin(plain[point]);
      EXPECT_LT(apart(p, {at.points[point].x(), at.points[point].y(), at.points[point].z()}), 1e-12) << point;
    }
  }
}

TEST(SerialChain, FramesAndPointsAreThoseOfPlainMatrices) {
  expect_same_frames(puma560_table(0.2), 1);
  expect_same_frames(puma560_modified_table(0.2), 2);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    expect_same_frames(random_table(seed, seed % 2 == 0 ? DhConvention::standard : DhConvention::modified), seed);
  }
}

/// The axis of joint j and a point on it, by matrices.
struct Axis {
  Point at;
  Point along;
};
Axis axis_of(const DhTable& table, const JointState& q, std::size_t joint) {
  const std::vector<Matrix> all = frames(table, q);
  const Matrix& m = table.convention == DhConvention::standard ? all[joint] : all[joint + 1];
  return {origin(m), {m[0][2], m[1][2], m[2][2]}};
}

double distance_from(const Axis& axis, const Point& p) {
  const Point v = {p[0] - axis.at[0], p[1] - axis.at[1], p[2] - axis.at[2]};
  const Point& z = axis.along;
  return std::hypot(z[1] * v[2] - z[2] * v[1], z[2] * v[0] - z[0] * v[2], z[0] * v[1] - z[1] * v[0]);
}

TEST(SerialChain, NoPointIsEverFartherFromAnAxisThanItsReach) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const DhTable table = seed == 1 ? puma560_table(0.2)
                          : seed == 2
                              ? puma560_modified_table()
                              : random_table(seed, seed % 2 == 0 ? DhConvention::standard : DhConvention::modified);
    const SerialChain chain(table);
    for (std::uint64_t i = 0; i < 100; ++i) {
      const JointState q = random_state(table, seed, i);
      const std::vector<Point> at = points(table, q);
      ChainPosture posture;
      chain.place(q, posture);
      for (std::size_t joint = 0; joint < table.joints.size(); ++joint) {
        const Axis axis = axis_of(table, q, joint);
        // Points behind the joint, that it moves.
        for (std::size_t point = joint + 1; point < at.size(); ++point) {
          const double distance = distance_from(axis, at[point]);
          EXPECT_LE(distance, chain.reach(joint, point) + 1e-13) << joint << ' ' << point;
          if (!chain.moves(joint)) continue;
          const double here = posture.axes[joint].cross(posture.points[point] - posture.on_axes[joint]).norm();
          EXPECT_NEAR(here, distance, 1e-12);
        }
        for (const Point& p : at) EXPECT_LE(apart(p, {0, 0, 0}), chain.reach() + 1e-12);
      }
    }
  }
}

TEST(SerialChain, ReachesOfThePumaAreTight) {
  const SerialChain chain(puma560_table());
  EXPECT_NEAR(chain.reach(1, 4), 0.4318 + std::hypot(0.0203, 0.4318), 1e-12);  // joint 2 to the wrist
  EXPECT_NEAR(chain.reach(2, 4), std::hypot(0.0203, 0.4318), 1e-12);
  for (std::size_t joint = 3; joint < 6; ++joint) EXPECT_FALSE(chain.moves(joint));
  const SerialChain with_tool(puma560_table(0.1));
  EXPECT_TRUE(with_tool.moves(3));
  EXPECT_TRUE(with_tool.moves(4));
  EXPECT_FALSE(with_tool.moves(5));
  EXPECT_EQ(with_tool.reach(3, 6), 0.0);
}

TEST(SerialChain, TellsWhichJointIsOutsideItsLimits) {
  const SerialChain chain(puma560_table());
  EXPECT_EQ(chain.joint_outside_limits({}), most_joints);
  EXPECT_EQ(chain.joint_outside_limits(degrees({17.5, -83.3, -13.5, 0, 0, 0})), 1U);
  EXPECT_EQ(chain.joint_outside_limits(degrees({160, 225, -225, 170, -100, 266})), most_joints);
  EXPECT_EQ(chain.joint_outside_limits({0, 0, 0, 0, 0, std::nan("")}), 5U);
  const SerialChain symmetric(puma560_table(0.0, PumaLimits::symmetric));
  EXPECT_EQ(symmetric.joint_outside_limits(degrees({0, 0, -161.1, 0, 0, 0})), 2U);
}

TEST(SerialChain, RefusesBadTables) {
  const auto refusal = [](const DhTable& table) -> std::string {
    try {
      const SerialChain chain(table);
    } catch (const InputError& error) {
      return error.what();
    }
    return "taken";
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
