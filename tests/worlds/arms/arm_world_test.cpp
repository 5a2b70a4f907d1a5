// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/arm_world.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {
namespace {

using namespace arm_oracle;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What a seed tests: a table, a scene, options.
struct Setting {
  DhTable table;
  Scene scene;
  ArmOptions options;
  double radius = 0.05;
  bool self_collision = false;
};
ArmWorld world_of(const Setting& s) { return {s.scene, model_of(s.table, s.radius, s.self_collision), s.options}; }
Setting setting(std::uint64_t seed) {
  Setting s;
  s.table = seed % 4 == 0   ? modified_puma_table(0.15)
            : seed % 4 == 1 ? puma560_table()
            : seed % 4 == 2 ? puma560_table(0.2, PumaLimits::symmetric)
                            : random_table(seed, seed % 8 == 3 ? DhConvention::standard : DhConvention::modified);
  s.scene = scattered_spheres(seed, 4 + seed % 6);
  if (seed % 3 == 0) add_boxes(s.scene, seed, 4);
  s.radius = seed % 5 == 0 ? 0.1 : 0.05;
  return s;
}
bool has_length(const DhTable& table) { return !model_of(table, 0.05, false).links.empty(); }

TEST(ArmWorld, IsFreeWhereTheCapsulesKeepTheClearance) {
  for (const std::uint64_t seed : test::seeds(24)) {
    SCOPED_TRACE(seed);
    Setting s = setting(seed);
    if (!has_length(s.table)) continue;
    for (const double room : {0.0, 0.01, 0.1}) {
      s.options.clearance = room;
      const ArmWorld world = world_of(s);
      auto query = world.make_query();
      for (std::uint64_t i = 0; i < 40; ++i) {
        const JointState q = random_state(s.table, seed, i);
        const double expected = clearance(s.scene, s.table, s.radius, q);
        if (std::abs(expected - room) > 1e-7) {
          EXPECT_EQ(world.is_free(q, query), expected > room);
        }
      }
    }
  }
}

/// Random states, near and far ones.
JointState other_state(const DhTable& table, const JointState& a, std::uint64_t seed, std::uint64_t i) {
  return at_share(a, random_state(table, seed + 1000, i), i % 2 == 0 ? 1.0 : 0.1);
}

/// Is the motion free at so many places?
bool sampled_free(const Setting& s, const JointState& a, const JointState& b, int places, double margin) {
  for (int i = 0; i <= places; ++i) {
    const JointState q = at_share(a, b, static_cast<double>(i) / places);
    if (quick_clearance(s.scene, s.table, s.radius + margin, q) <= 0.0) return false;
  }
  return true;
}

TEST(ArmWorld, AcceptedMotionsAreFreeAndFewFreeOnesAreRefused) {
  int free_by_margin = 0;
  int refused = 0;
  std::uint64_t accepted = 0;
  for (const std::uint64_t seed : test::seeds(20)) {
    SCOPED_TRACE(seed);
    Setting s = setting(seed);
    s.scene.boxes.clear();
    if (!has_length(s.table)) continue;
    const ArmWorld world = world_of(s);
    for (std::uint64_t i = 0; i < test::share(60, 20); ++i) {
      SCOPED_TRACE(i);
      const JointState a = random_state(s.table, seed, i);
      const JointState b = other_state(s.table, a, seed, i);
      const MotionVerdict verdict = world.judge_motion(a, b);
      if (verdict == MotionVerdict::free) {
        ++accepted;
        EXPECT_TRUE(sampled_free(s, a, b, 2000, 0.0));
      } else if (sampled_free(s, a, b, 1000, 0.01 * s.radius)) {
        ++refused;
      }
      free_by_margin += verdict == MotionVerdict::free ? 1 : 0;
    }
  }
  EXPECT_GT(accepted, test::share(200, 8));
  EXPECT_EQ(refused, 0) << "of " << free_by_margin;
}

Setting study_setting() {
  Setting s;
  s.table = puma560_table();
  s.scene = scattered_spheres(4, 9);
  return s;
}
JointState study_state(std::uint64_t index) { return random_state(puma560_table(), 99, index); }

/// The study tests a motion at its start and ten places between, whatever its length; the goal was tested before.
bool study_accepts(const Setting& s, const JointState& a, const JointState& b) {
  return sampled_free(s, a, b, 11, 0.0);
}

/// Found by the search below among some 8700 motions that the study's test accepts, 278 of which collide; in the first
/// six the links' very centre lines pass through a sphere.
TEST(ArmWorld, BlocksMotionsThatTenSamplesAccept) {
  const Setting s = study_setting();
  const ArmWorld world = world_of(s);
  for (const auto& [first, second] : std::vector<std::pair<std::uint64_t, std::uint64_t>>{{1000, 1005},
                                                                                          {1012, 1015},
                                                                                          {1038, 1042},
                                                                                          {115, 119},
                                                                                          {1150, 1154},
                                                                                          {119, 123},
                                                                                          {1001, 1005},
                                                                                          {1002, 1005},
                                                                                          {1985, 1987}}) {
    SCOPED_TRACE(first);
    const JointState a = study_state(first);
    const JointState b = study_state(second);
    EXPECT_TRUE(study_accepts(s, a, b));
    EXPECT_FALSE(sampled_free(s, a, b, 10'000, 0.0));
    EXPECT_EQ(world.judge_motion(a, b), MotionVerdict::blocked);
  }
}

TEST(ArmWorld, SearchFindsMotionsThatTenSamplesAcceptAndNoneThatItAcceptsItself) {
  const Setting s = study_setting();
  const ArmWorld world = world_of(s);
  std::uint64_t accepted_by_study = 0;
  std::uint64_t wrongly = 0;
  for (const std::uint64_t seed : test::seeds(120, 12)) {
    const std::uint64_t i = seed - 1;
    for (std::uint64_t k = i + 1; k < i + 6; ++k) {
      if (!study_accepts(s, study_state(i), study_state(k))) continue;
      ++accepted_by_study;
      if (sampled_free(s, study_state(i), study_state(k), 3000, 0.0)) continue;
      ++wrongly;
      EXPECT_NE(world.judge_motion(study_state(i), study_state(k)), MotionVerdict::free) << i << ' ' << k;
    }
  }
  EXPECT_GT(accepted_by_study, test::share(300, 20));
  if (test::asks_all()) EXPECT_GT(wrongly, 5U);
}

TEST(ArmWorld, SelfCollisionKeepsLinksApartThatAreNoNeighbours) {
  for (const std::uint64_t seed : test::seeds(12)) {
    SCOPED_TRACE(seed);
    Setting s = setting(seed);
    if (!has_length(s.table)) continue;
    s.scene = {};
    s.self_collision = true;
    s.radius = 0.04;
    const ArmWorld world = world_of(s);
    const auto folded = [&](const JointState& q) {
      const auto all = spines(s.table, q);
      double least = infinity;
      for (std::size_t i = 0; i < all.size(); ++i) {
        double between_them = 0.0;
        for (std::size_t k = i + 2; k < all.size(); ++k) {
          between_them += apart(all[k - 1][0], all[k - 1][1]);
          if (between_them <= 2.0 * s.radius + 1e-6) continue;
          least = std::min(least, segments_apart(all[i][0], all[i][1], all[k][0], all[k][1]));
        }
      }
      return least - 2.0 * s.radius;
    };
    auto query = world.make_query();
    for (std::uint64_t i = 0; i < 12; ++i) {
      const JointState a = random_state(s.table, seed, i);
      const double expected = folded(a);
      if (std::abs(expected) > 1e-6) {
        EXPECT_EQ(world.is_free(a, query), expected > 0.0);
      }
      const JointState b = other_state(s.table, a, seed, i);
      if (world.judge_motion(a, b) != MotionVerdict::free) continue;
      for (int k = 1; k <= 6; ++k) EXPECT_GT(folded(at_share(a, b, k / 7.0)), -1e-6);
    }
  }
}

TEST(ArmWorld, SamplesStayWithinTheLimitsAndKeepIdleJointsAtRest) {
  const ArmWorld world({}, model_of(puma560_table(), 0.05, false), {});
  EXPECT_EQ(world.sampled_dimension(), 3U);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const JointState q = uniform_state(world, 1, i);
    EXPECT_EQ(world.kinematics().variable_outside_limits(q), most_joints);
    for (std::size_t j = 3; j < 6; ++j) EXPECT_EQ(q[j], 0.0);
  }
  const ArmWorld with_tool({}, model_of(puma560_table(0.1), 0.05, false), {});
  EXPECT_EQ(with_tool.sampled_dimension(), 5U);
}

/// Three links in a plane; at half of the motion nothing is near, at its end the last link lies across the first.
TEST(ArmWorld, MotionsOfTheJointBehindALinkAreHeldAgainstIt) {
  DhTable table;
  for (const double length : {2.0, 1.0, 2.0}) table.joints.push_back({.a = length, .low_rad = -3.0, .high_rad = 3.0});
  const ArmWorld world({}, model_of(table, 0.05, true), {});
  auto query = world.make_query();
  EXPECT_TRUE(world.is_free({0.0, 0.0, 2.3}, query));
  EXPECT_TRUE(world.is_free_motion({0.0, -2.0, 2.3}, {0.0, 0.0, 2.3}, query));
  EXPECT_FALSE(world.is_free_motion({0.0, -2.0, 2.3}, {0.0, 2.0, 2.3}, query));
}

/// Three links and a pair, then four links and none: what was looked at first of the one must not hide a link of the
/// other.
TEST(ArmWorld, AnArmThatWasAskedBeforeHidesNoLink) {
  const auto straight = [](std::size_t links, double length) {
    DhTable table;
    for (std::size_t i = 0; i < links; ++i) table.joints.push_back({.a = length, .low_rad = -3.0, .high_rad = 3.0});
    return table;
  };
  Scene at_the_last;
  at_the_last.spheres.push_back({1.8, 0.0, 0.0, 0.05});
  const ArmWorld three({}, model_of(straight(3, 1.0), 0.05, true), {});
  const ArmWorld four(at_the_last, model_of(straight(4, 0.5), 0.05, false), {});
  ASSERT_EQ(three.model().pairs.size(), 1U);
  auto query = three.make_query();
  auto other = four.make_query();
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(three.is_free({0.0, 0.5, 0.5}, query));
    EXPECT_FALSE(four.is_free({}, other));
    EXPECT_FALSE(four.is_free_motion({0.01}, {-0.01}, other));
  }
}

TEST(ArmWorld, PosturesBeyondALimitAreBlocked) {
  const ArmWorld world({}, model_of(puma560_table(), 0.05, false), {});
  auto query = world.make_query();
  for (std::size_t j = 0; j < world.unit_dimension(); ++j) {
    for (const double beyond : {-1e-6, 1e-6}) {
      JointState q = world.at_unit({0.5, 0.5, 0.5, 0.5, 0.5, 0.5});
      EXPECT_TRUE(world.is_free(q, query));
      q[j] = beyond < 0.0 ? world.model().variables[j].low : world.model().variables[j].high;
      EXPECT_TRUE(world.is_free(q, query)) << j;
      q[j] += beyond;
      EXPECT_FALSE(world.is_free(q, query)) << j;
    }
  }
}

TEST(ArmWorld, TheEmbeddingHasTheMetricOfJointsWithLimits) {
  const ArmWorld world({}, model_of(puma560_table(0.1), 0.05, false), {});
  for (std::uint64_t i = 0; i < 200; ++i) {
    const JointState a = random_state(puma560_table(), 1, 2 * i);
    const JointState b = random_state(puma560_table(), 1, 2 * i + 1);
    double sum = 0.0;
    double plain = 0.0;
    for (std::size_t j = 0; j < a.size(); ++j) {
      sum += std::pow(a[j] - b[j], 2.0);
      plain += std::pow(world.embed(a)[j] - world.embed(b)[j], 2.0);
    }
    EXPECT_NEAR(world.distance(a, b), std::sqrt(sum), 1e-12);
    EXPECT_NEAR(world.distance(a, b), std::sqrt(plain), 1e-12);
  }
}

/// Joints without end: the way is the shorter one around, and a plain distance of the embeddings is no longer.
TEST(ArmWorld, AJointWithoutEndGoesTheShorterWay) {
  ArmModel model = model_of(puma560_table(0.1), 0.05, false);
  for (const std::size_t j : {0U, 3U}) {
    model.variables[j].continuous = true;
    model.variables[j].low = -std::numbers::pi;
    model.variables[j].high = std::numbers::pi;
  }
  const ArmWorld world({}, model, {});
  auto query = world.make_query();
  EXPECT_NEAR(world.distance({4.6}, {-1.68}), 2.0 * std::numbers::pi - 6.28, 1e-12);
  EXPECT_TRUE(world.is_free({1000.0, 0.5, 0.5}, query));
  for (std::uint64_t i = 0; i < 400; ++i) {
    JointState a = uniform_state(world, 1, 2 * i);
    const JointState b = uniform_state(world, 1, 2 * i + 1);
    a[0] += 2.0 * std::numbers::pi * static_cast<double>(i % 3);
    double plain = 0.0;
    for (std::size_t j = 0; j < ArmWorld::Embedding{}.size(); ++j) {
      plain += std::pow(world.embed(a)[j] - world.embed(b)[j], 2.0);
    }
    EXPECT_LE(std::sqrt(plain), world.distance(a, b) + 1e-12);
    const JointState m = world.interpolate(a, b, 0.3);
    EXPECT_NEAR(world.distance(a, m), 0.3 * world.distance(a, b), 1e-9);
    EXPECT_NEAR(world.distance(m, b), 0.7 * world.distance(a, b), 1e-9);
    EXPECT_LE(std::abs(m[0]), std::numbers::pi);
  }
}

TEST(ArmWorld, EvenIdleJointsMoveNothingAndNeverLengthen) {
  const ArmWorld world({}, model_of(puma560_table(), 0.05, false), {});
  Path<JointState> path{{0, 0, 0, 1, 0, 0}, {1, 0, 0, -2, 0.5, 0}, {1, 1, 0, 0, 0, 3}, {1, 1, 2, 1, 1, 1}};
  const Path<JointState> even = with_even_idle_joints(world, path);
  const auto length = [&](const Path<JointState>& states) {
    double sum = 0.0;
    for (std::size_t i = 1; i < states.size(); ++i) sum += world.distance(states[i - 1], states[i]);
    return sum;
  };
  EXPECT_NEAR(length(even), std::sqrt(16.0 + 2.0), 1e-12);
  EXPECT_EQ(even.front(), path.front());
  EXPECT_EQ(even.back(), path.back());
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(even[i][j], path[i][j]);
  }
}

TEST(ArmWorld, RefusesBadOptions) {
  const ArmModel model = model_of(puma560_table(), 0.05, false);
  const auto refuses = [&](const ArmOptions& options) { EXPECT_THROW(ArmWorld({}, model, options), InputError); };
  refuses({.clearance = -1.0});
  refuses({.clearance = std::nan("")});
  refuses({.resolution = 0.0});
  DhTable point;
  point.joints.push_back({0, 0, 0, -1, 1, 0});
  EXPECT_THROW(ArmWorld({}, model_of(point, 0.05, false), {}), InputError);
}

}  // namespace
}  // namespace warren
