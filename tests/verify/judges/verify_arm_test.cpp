// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_arm.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {
namespace {

using namespace arm_oracle;

const Execution one_thread{.threads = 1};

/// Least clearance at many places of the path.
double sampled_clearance(const Scene& scene, const DhTable& table, double radius, const std::vector<JointState>& path) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < path.size(); ++i) {
    for (int k = 0; k <= 200; ++k) {
      least = std::min(least, clearance(scene, table, radius, at_share(path[i - 1], path[i], k / 200.0)));
    }
  }
  return least;
}

TEST(VerifyArm, AgreesWithDenseSamplingAndNeverPromisesMoreClearanceThanThereIs) {
  std::uint64_t verified = 0;
  std::uint64_t refuted = 0;
  for (const std::uint64_t seed : test::seeds(20, 5)) {
    SCOPED_TRACE(seed);
    Scene scene = scattered_spheres(seed, 8);
    add_boxes(scene, seed, 2);
    const DhTable table = seed % 2 == 0 ? puma560_table(0.1) : modified_puma_table();
    const double radius = 0.04;
    const ArmModel model = model_of(table, radius, false);
    for (std::uint64_t i = 0; i < 4; ++i) {
      const JointState a = random_state(table, seed, i);
      const std::vector<JointState> path{a, at_share(a, random_state(table, seed, i + 50), i % 2 == 0 ? 1.0 : 0.2)};
      const Verification found = verify_arm(scene, model, path, {}, one_thread);
      const double sampled = sampled_clearance(scene, table, radius, path);
      (found.verified ? verified : refuted) += 1;
      if (found.verified) {
        EXPECT_GT(sampled, 0.0);
        EXPECT_LE(found.min_clearance, sampled + 1e-9);
        EXPECT_GE(found.min_clearance, sampled - 0.02 * radius - 0.02 * sampled - 1e-3);
      } else {
        ASSERT_TRUE(found.first_violation.has_value());
        EXPECT_LT(sampled, 0.01);
      }
      EXPECT_NEAR(found.length, ArmWorld({}, model, {}).distance(path[0], path[1]), 1e-12);
    }
  }
  EXPECT_GT(verified, test::share(15, 4));
  EXPECT_GT(refuted, test::share(15, 1));
}

TEST(VerifyArm, PassesEveryMotionThatThePlannersAccept) {
  std::uint64_t accepted = 0;
  for (const std::uint64_t seed : test::seeds(20)) {
    SCOPED_TRACE(seed);
    Scene scene = scattered_spheres(seed, 5);
    add_boxes(scene, seed, 3);
    const DhTable table = seed % 2 == 0 ? puma560_table(0.1) : modified_puma_table(0.1);
    const bool self = seed % 3 == 0;
    const ArmModel model = model_of(table, 0.05, self, 0.01);
    const ArmWorld world(scene, model, {.clearance = 0.01});
    for (std::uint64_t i = 0; i < 60; ++i) {
      const JointState a = random_state(table, seed, i);
      const JointState b = at_share(a, random_state(table, seed, i + 99), i % 2 == 0 ? 1.0 : 0.2);
      if (world.judge_motion(a, b) != MotionVerdict::free) continue;
      ++accepted;
      const Verification found = verify_arm(scene, model, std::vector{a, b}, {.clearance = 0.01}, one_thread);
      EXPECT_TRUE(found.verified) << i << ' ' << (found.first_violation ? found.first_violation->obstacle : "");
      EXPECT_GE(found.min_clearance, 0.01);
    }
  }
  EXPECT_GT(accepted, test::share(200));
}

class VerifyArmPath : public ::testing::Test {
 protected:
  Verification verify(const std::vector<JointState>& path, const ArmVerifyOptions& options = {}) const {
    return verify_arm(scene_, model_of(table_, radius_, self_collision_, options.clearance), path, options, one_thread);
  }
  std::string refusal(const std::vector<JointState>& path, const ArmVerifyOptions& options = {}) const {
    const Verification found = verify(path, options);
    EXPECT_EQ(found.verified, !found.first_violation);
    return found.first_violation ? found.first_violation->obstacle : "";
  }
  DhTable table_ = puma560_table();
  Scene scene_;
  double radius_ = 0.05;
  bool self_collision_ = false;
  JointState rest_{};
  JointState turned_{1, 0, 0, 0, 0, 0};
};

TEST_F(VerifyArmPath, NamesWhatIsInTheWay) {
  EXPECT_EQ(refusal({rest_, turned_}), "");
  scene_.spheres.push_back({-1, -1, -1, 0.1});
  // Between the two states, where the wrist passes: 0.4521 ahead, 0.15005 to the side, 0.4318 up.
  const double reach = std::hypot(0.4521, 0.15005);
  const double heading = 0.5 - std::atan2(0.15005, 0.4521);
  scene_.spheres.push_back({reach * std::cos(heading), reach * std::sin(heading), 0.4318, 0.01});
  EXPECT_EQ(refusal({turned_, rest_}).substr(0, 9), "sphere 1:");
  scene_.spheres.pop_back();
  SolidBox box{};
  box.low = {0.2, 0.1, 0.1};
  box.high = {0.4, 0.3, 0.5};
  scene_.boxes.push_back(box);
  EXPECT_EQ(refusal({rest_, turned_}).substr(0, 6), "box 0:");
}

TEST_F(VerifyArmPath, HoldsThePathToItsEndsAndLimits) {
  EXPECT_EQ(refusal({rest_, turned_}, {.start = turned_}).substr(0, 6), "start:");
  EXPECT_EQ(refusal({rest_, turned_}, {.goal = rest_}).substr(0, 5), "goal:");
  EXPECT_EQ(refusal({rest_, turned_}, {.start = rest_, .goal = turned_}), "");
  EXPECT_EQ(refusal({turned_, rest_}, {.goal_place = Vec3(0.4521, -0.15005, 0.4318)}), "");
  EXPECT_EQ(refusal({rest_, turned_}, {.goal_place = Vec3(0.4521, -0.15005, 0.4318)}).substr(0, 5), "goal:");
  const std::vector<JointState> beyond = {rest_, {0, -0.8, 0, 0, 0, 0}};
  EXPECT_EQ(refusal(beyond).substr(0, 15), "limits: joint 2");
  EXPECT_EQ(verify(beyond).first_violation->kind, ViolationKind::motion);
  EXPECT_EQ(verify({rest_, turned_}, {.goal = rest_}).first_violation->kind, ViolationKind::obstacle);
  EXPECT_EQ(refusal({rest_, {0, 0, 1e50, 0, 0, 0}}).substr(0, 15), "limits: joint 3");
}

TEST_F(VerifyArmPath, KeepsLinksApartOnlyWhereAskedTo) {
  // Upper arm and forearm lie along each other when the elbow is folded; the shoulder's offset parts them by 0.15.
  const std::vector<JointState> folded{{0, 0, -1.57, 0, 0, 0}, {0, 0, -3.5, 0, 0, 0}};
  radius_ = 0.06, self_collision_ = true;
  EXPECT_EQ(refusal(folded), "");
  radius_ = 0.0745, self_collision_ = false;
  EXPECT_EQ(refusal(folded), "");
  self_collision_ = true;
  EXPECT_EQ(refusal(folded, {.clearance = 0.001}), "");
}

/// Three links in a plane, the last across the middle of the first: no end of either is near the other.
TEST(VerifyArm, LinksThatCrossBetweenTheirEndsCollide) {
  DhTable table;
  for (const double length : {2.0, 1.0, 2.0}) table.joints.push_back({.a = length, .low_rad = -3.0, .high_rad = 3.0});
  const auto verified = [&](double last) {
    const std::vector<JointState> path{{0.0, 2.0, last}, {0.1, 2.0, last}};
    return verify_arm({}, model_of(table, 0.05, true), path, {}, one_thread).verified;
  };
  EXPECT_FALSE(verified(2.3));
  EXPECT_TRUE(verified(0.0));
}

TEST_F(VerifyArmPath, RefusesWhatIsNoPath) {
  EXPECT_THROW(verify({}), InputError);
  EXPECT_THROW(verify({{std::nan(""), 0, 0, 0, 0, 0}}), InputError);
  EXPECT_THROW(verify({rest_}, {.clearance = -1.0}), InputError);
}

TEST_F(VerifyArmPath, IsTheSameForAnyNumberOfThreadsAndStops) {
  scene_ = scattered_spheres(3, 3);
  std::vector<JointState> path;
  for (std::uint64_t i = 0; i < 12; ++i) path.push_back(at_share(rest_, random_state(table_, 1, i), 0.1));
  const Verification one = verify(path);
  for (const unsigned threads : {2U, 3U, 8U}) {
    const Verification many = verify_arm(scene_, model_of(table_, radius_, false), path, {}, {.threads = threads});
    EXPECT_EQ(many.verified, one.verified);
    EXPECT_EQ(many.min_clearance, one.min_clearance);
    EXPECT_EQ(many.length, one.length);
  }
}

}  // namespace
}  // namespace warren
