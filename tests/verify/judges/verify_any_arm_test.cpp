// SPDX-License-Identifier: BSD-3-Clause
// The judge of arms and arms of every kind: trees of joints that turn, slide, go around and follow others, with solids
// of every kind, among solids of every kind.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/arms/random_arm.hpp"
#include "verify/judges/judged_arm.hpp"
#include "verify/judges/verify_arm.hpp"

namespace warren {
namespace {

const Execution any_arm_alone{.threads = 1};

Solid moved(Solid solid, const Eigen::Matrix4d& frame) {
  solid.pose.matrix() = frame * solid.pose.matrix();
  return solid;
}

double apart(const Solid& a, const Solid& b) {
  SolidFrame of_a{{a.pose.linear().col(0), a.pose.linear().col(1), a.pose.linear().col(2)}, a.pose.translation()};
  SolidFrame of_b{{b.pose.linear().col(0), b.pose.linear().col(1), b.pose.linear().col(2)}, b.pose.translation()};
  const SolidCore core_a = core_of(a, of_a);
  const SolidCore core_b = core_of(b, of_b);
  constexpr double never = std::numeric_limits<double>::infinity();
  return gap_between({core_a, of_a}, {core_b, of_b}, 1e-9, never).most - core_a.radius - core_b.radius;
}

JointState between(const ArmModel& model, const JointState& a, const JointState& b, double t) {
  JointState q{};
  for (std::size_t i = 0; i < model.variables.size(); ++i)
    q[i] = a[i] + t * variable_way(model.variables[i], a[i], b[i]);
  return q;
}

/// All of the arm's solids at q, by links.
std::vector<std::vector<Solid>> placed(const ArmModel& model, const JointState& q) {
  std::vector<std::vector<Solid>> all;
  for (const ArmLink& link : model.links) {
    all.emplace_back();
    for (const Solid& solid : link.solids) all.back().push_back(moved(solid, random_arm::frame(model, q, link.frame)));
  }
  return all;
}

double clearance_at(const Scene& scene, const ArmModel& model, const JointState& q) {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<Solid>> arm = placed(model, q);
  for (const std::vector<Solid>& link : arm) {
    for (const Solid& solid : link) {
      for (const Solid& obstacle : scene.solids) least = std::min(least, apart(solid, obstacle));
    }
  }
  for (const auto& [a, b] : model.pairs) {
    for (const Solid& solid : arm[a]) {
      for (const Solid& other : arm[b]) least = std::min(least, apart(solid, other));
    }
  }
  return least;
}

/// An arm of a few joints, pairs of its links that are far apart in the tree and at the first state, a short leg.
struct Drawn {
  ArmModel model;
  Scene scene;
  std::vector<JointState> path;

  explicit Drawn(std::uint64_t seed, std::size_t obstacles = 6) : model(random_arm::arm(seed, 3 + seed % 3, true)) {
    random_arm::Draw draw(seed + 1000);
    ArmLink base{"base", base_frame, {draw.solid(random_arm::kinds[seed % 5], 0.2)}};
    model.links.push_back(base);
    path = {random_arm::state(model, seed, 0), random_arm::state(model, seed, 1)};
    path[1] = between(model, path[0], path[1], 0.3);
    const std::vector<std::vector<Solid>> arm = placed(model, path[0]);
    for (std::uint32_t b = 2; b < arm.size(); b += 2) {
      if (apart(arm[0][0], arm[b][0]) > 0.05) model.pairs.push_back({0, b});
    }
    while (scene.solids.size() < obstacles) {
      Solid solid = draw.solid(random_arm::kinds[scene.solids.size() % 5], 0.4);
      solid.pose.translation() += 1.2 * draw.vector();
      scene.solids.push_back(solid);
    }
  }
};

TEST(VerifyAnyArm, AgreesWithDenseSamplingAndMeasuresTheClearance) {
  std::size_t free = 0;
  std::size_t refuted = 0;
  for (const std::uint64_t seed : test::seeds(200, 30)) {
    SCOPED_TRACE(seed);
    const Drawn drawn(seed);
    double sampled = std::numeric_limits<double>::infinity();
    constexpr int steps = 60;
    for (int k = 0; k <= steps; ++k) {
      const JointState q = between(drawn.model, drawn.path[0], drawn.path[1], k / double{steps});
      sampled = std::min(sampled, clearance_at(drawn.scene, drawn.model, q));
    }
    const Verification found = verify_arm(drawn.scene, drawn.model, drawn.path, {}, any_arm_alone);
    (found.verified ? free : refuted) += 1;
    if (!found.verified) {
      EXPECT_LT(sampled, 0.02) << found.first_violation->obstacle;
      continue;
    }
    EXPECT_GT(sampled, 0.0);
    EXPECT_LE(found.min_clearance, sampled + 1e-9);
    EXPECT_GE(found.min_clearance, sampled - 0.02);
    // Just below what it has it keeps, just above it does not.
    EXPECT_TRUE(
        verify_arm(drawn.scene, drawn.model, drawn.path, {.clearance = 0.999 * found.min_clearance}, any_arm_alone)
            .verified);
    EXPECT_FALSE(
        verify_arm(drawn.scene, drawn.model, drawn.path, {.clearance = sampled + 1e-9}, any_arm_alone).verified);
  }
  EXPECT_GT(free, test::share(30, 1));
  EXPECT_GT(refuted, test::share(30, 1));  // of any thirty that follow each other two are
}

/// A speck within a link at an odd moment, found by no even sampling.
TEST(VerifyAnyArm, RefutesWhatIsPlantedBetweenSamples) {
  for (const std::uint64_t seed : test::seeds(500, 40)) {
    SCOPED_TRACE(seed);
    Drawn drawn(seed, 0);
    drawn.model.pairs.clear();
    const JointState q = between(drawn.model, drawn.path[0], drawn.path[1], 0.001 + 0.998 * uniform(seed, 3, 0));
    const std::vector<std::vector<Solid>> arm = placed(drawn.model, q);
    const std::vector<Solid>& link = arm[random_bits(seed, 4, 0) % arm.size()];
    const Solid& solid = link[random_bits(seed, 5, 0) % link.size()];
    SolidFrame frame{{solid.pose.linear().col(0), solid.pose.linear().col(1), solid.pose.linear().col(2)},
                     solid.pose.translation()};
    const SolidCore core = core_of(solid, frame);
    const Vec3 n = random_arm::Draw(seed).vector().normalized();
    Solid speck{.kind = random_arm::kinds[seed % 4], .half = {1e-4, 1e-4, 1e-4}};
    speck.pose.translation() = frame.point(core.support(frame.seen(n))) + (core.radius + 0.9e-4) * n;
    drawn.scene.solids = {speck};
    const Verification found = verify_arm(drawn.scene, drawn.model, drawn.path, {}, any_arm_alone);
    EXPECT_FALSE(found.verified);
  }
}

TEST(VerifyAnyArm, SaysTheSameOfATurnedAndMovedWorld) {
  for (const std::uint64_t seed : test::seeds(100, 10)) {
    SCOPED_TRACE(seed);
    Drawn drawn(seed);
    const Verification here = verify_arm(drawn.scene, drawn.model, drawn.path, {}, any_arm_alone);
    const Eigen::Isometry3d way = random_arm::Draw(seed + 5000).pose(3.0);
    for (Solid& solid : drawn.scene.solids) solid = moved(solid, way.matrix());
    for (ArmJoint& joint : drawn.model.joints) {
      if (joint.parent == base_frame) joint.origin = way * joint.origin;
    }
    for (Solid& solid : drawn.model.links.back().solids) solid = moved(solid, way.matrix());
    const Verification there = verify_arm(drawn.scene, drawn.model, drawn.path, {}, any_arm_alone);
    EXPECT_EQ(there.verified, here.verified);
    if (here.verified) EXPECT_NEAR(there.min_clearance, here.min_clearance, 0.01);
  }
}

/// A finger of length 1 that turns without end, and slides.
class VerifyFinger : public ::testing::Test {
 protected:
  VerifyFinger() {
    model_.variables = {{.name = "roll", .continuous = true, .low = -3.2, .high = 3.2},
                        {.name = "lift", .slides = true, .low = 0.0, .high = 0.5}};
    model_.joints = {{.name = "lift", .slides = true, .variable = 1}, {.name = "roll", .parent = 0, .variable = 0}};
    Solid finger{.kind = SolidKind::box, .half = {0.5, 0.02, 0.02}};
    finger.pose.translation() = Vec3(0.5, 0.0, 0.0);
    model_.links = {{"finger", 1, {finger}}};
    model_.tool_frame = 1;
    model_.tool.translation() = Vec3(1.0, 0.0, 0.0);
  }
  std::string refusal(const std::vector<JointState>& path, const ArmVerifyOptions& options = {}) const {
    const Verification found = verify_arm(scene_, model_, path, options, any_arm_alone);
    EXPECT_EQ(found.verified, !found.first_violation);
    return found.first_violation ? found.first_violation->obstacle : "";
  }
  void put(SolidKind kind, double angle, double height) {
    Solid solid{.kind = kind, .half = {0.05, 0.05, 0.05}, .name = "can"};
    solid.pose.translation() = Vec3(0.9 * std::cos(angle), 0.9 * std::sin(angle), height);
    scene_.solids.push_back(solid);
  }
  ArmModel model_;
  Scene scene_;
};

TEST_F(VerifyFinger, GoesTheShorterWayAroundAndUpEvenly) {
  put(SolidKind::cylinder, 0.0, 0.0);
  EXPECT_EQ(refusal({{3.0}, {-3.0}}), "");
  EXPECT_EQ(refusal({{1.0}, {-1.0}}).substr(0, 15), "cylinder 0 can:");
  EXPECT_EQ(refusal({{100.0}, {101.0}}), "cylinder 0 can: at 0.9 0 0, touches link finger");  // 32 pi is 100.53
  EXPECT_EQ(refusal({{1.0, 0.0}, {-1.0, 0.5}}), "");
  EXPECT_NEAR(verify_arm(scene_, model_, std::vector<JointState>{{3.0}, {-3.0, 0.3}}, {}, any_arm_alone).length,
              std::hypot(2.0 * std::numbers::pi - 6.0, 0.3), 1e-12);
}

TEST_F(VerifyFinger, IsHeldToLimitsAndEnds) {
  EXPECT_EQ(refusal({{0.0, 0.6}}), "limits: joint lift at 0.6, which has 0 to 0.5 m");
  EXPECT_EQ(refusal({{0.0, 0.0, 0.1}}).substr(0, 15), "limits: joint 3");
  EXPECT_EQ(refusal({{0.1}, {1.0}}, {.start = JointState{0.1 - 2.0 * std::numbers::pi}, .goal = JointState{1.0}}), "");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Vec3(0.0, 1.0, 0.25);
  const std::vector<JointState> up{{0.0}, {0.5 * std::numbers::pi, 0.25}};
  EXPECT_EQ(refusal(up, {.goal_place = pose.translation()}), "");
  EXPECT_EQ(refusal(up, {.goal_pose = pose}), "goal: 0 1 0.25");
  pose.linear() = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitZ()).toRotationMatrix();
  EXPECT_EQ(refusal(up, {.goal_pose = pose}), "");
}

TEST_F(VerifyFinger, IsHeldToThemToTheTolerance) {
  for (const double share : {0.5, 2.0}) {
    SCOPED_TRACE(share);
    const double off = share * ArmVerifyOptions::tolerance;
    const bool refused = share > 1.0;
    const std::vector<JointState> up{{0.0, 0.1}, {0.5 * std::numbers::pi, 0.25}};
    for (const std::size_t joint : {0U, 1U}) {
      JointState start = up.front();
      JointState goal = up.back();
      start[joint] -= off;
      goal[joint] += off;
      EXPECT_EQ(refusal(up, {.start = start}).starts_with("start:"), refused);
      EXPECT_EQ(refusal(up, {.goal = goal}).starts_with("goal:"), refused);
    }
    EXPECT_EQ(refusal({{0.0, -off}}).starts_with("limits:"), refused);
    EXPECT_EQ(refusal({{0.0, 0.5 + off}}).starts_with("limits:"), refused);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitZ()).toRotationMatrix();
    pose.translation() = Vec3(0.0, 1.0, 0.25 + off);
    EXPECT_EQ(refusal(up, {.goal_place = pose.translation()}).starts_with("goal:"), refused);
    EXPECT_EQ(refusal(up, {.goal_pose = pose}).starts_with("goal:"), refused);
    pose.translation().z() = 0.25;
    pose.linear() = pose.linear() * Eigen::AngleAxisd(off, Vec3::UnitX()).toRotationMatrix();
    EXPECT_EQ(refusal(up, {.goal_pose = pose}).starts_with("goal:"), refused);
  }
}

TEST_F(VerifyFinger, IsJudgedAmongSizesOfAllKindsOrRefused) {
  Solid huge{.kind = SolidKind::box, .half = {1e60, 1e60, 1e59}};
  huge.pose.translation() = Vec3(0.0, 0.0, -1e59);
  scene_.boxes.push_back({{-1e60, -1e60, -1e60}, {1e60, 1e60, -0.1}});
  scene_.spheres.push_back({1e60, -1e60, 1e30, 1.0});
  EXPECT_EQ(refusal({{0.0}, {3.0}}), "");
  EXPECT_EQ(refusal({{0.0}, {3.0}}, {.clearance = 0.07999999}), "");
  EXPECT_EQ(refusal({{0.0}, {3.0}}, {.clearance = 0.08000001}).substr(0, 6), "box 0:");
  EXPECT_EQ(refusal({{0.0, 1e60}}).substr(0, 6), "limits");
  scene_.solids.push_back(huge);
  EXPECT_NE(refusal({{0.0}, {3.0}}), "");
  scene_.solids = {{.kind = SolidKind::hull}};
  EXPECT_THROW(refusal({{}}), InputError);
  scene_.solids.front().corners = {{0.5, 0.5, 0.0}};
  EXPECT_NE(refusal({{0.0}, {2.0}}), "");
  EXPECT_EQ(refusal({{1.0}, {2.0}}), "");
  scene_.solids.front().pose.linear() *= 1.1;
  EXPECT_THROW(refusal({{}}), InputError);
  model_.links.front().frame = 2;
  scene_.solids.clear();
  EXPECT_THROW(refusal({{}}), InputError);
}

TEST_F(VerifyFinger, StopsAmongHullsOfManyCorners) {
  Solid hull{.kind = SolidKind::hull};
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    const double angle = 1e-3 * static_cast<double>(i);
    hull.corners.push_back({std::cos(angle), std::sin(angle), 1e-6 * static_cast<double>(i) - 1.1001});
  }
  scene_.solids.assign(5, hull);
  const Deadline over(0.0);
  EXPECT_THROW(verify_arm(scene_, model_, std::vector<JointState>{{0.0}, {3.0}}, {}, {.deadline = &over}), Stopped);
  const Deadline small(1e9, 1);
  EXPECT_THROW(verify_arm(scene_, model_, std::vector<JointState>{{0.0}, {3.0}}, {}, {.deadline = &small}), Stopped);
}

}  // namespace
}  // namespace warren
