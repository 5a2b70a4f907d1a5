// SPDX-License-Identifier: BSD-3-Clause
// Planners on arms: the study's scene, one with nine spheres, and worlds from seeds. Every path is judged by
// verify/judges/verify_arm.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "planners/shorten/shortcut.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/kinds/planned_worlds.hpp"
#include "tests/paths.hpp"
#include "tests/seeds.hpp"
#include "verify/judges/verify_arm.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {
namespace {

struct Question {
  Scene scene;
  DhTable table = puma560_table();
  JointState start{};
  JointState goal{};
};

double joint_distance(const JointState& a, const JointState& b) {
  double sum = 0.0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return std::sqrt(sum);
}

void expect_verified(const Question& q, const Path<JointState>& path) {
  ArmVerifyOptions options;
  options.start = q.start;
  options.goal = q.goal;
  const Verification found = verify_arm(q.scene, model_of(q.table, 0.05, false), path, options, {});
  EXPECT_TRUE(found.verified) << (found.first_violation ? found.first_violation->obstacle : "");
}

/// A world from a seed, with start and goal free and the straight way blocked.
Question random_question(std::uint64_t seed, std::size_t spheres = 8) {
  Question q;
  if (seed % 2 == 0) q.table = puma560_table(0.1);
  for (std::uint64_t i = 0; q.scene.spheres.size() < spheres; ++i) {
    const auto at = [&](std::uint64_t axis) { return 2.0 * uniform(seed, i, axis) - 1.0; };
    const Sphere s{at(0), at(1), at(2), 0.1 + 0.1 * uniform(seed, i, 3)};
    if (std::hypot(s.x, s.y, s.z) > s.radius + 0.3) q.scene.spheres.push_back(s);
  }
  const ArmWorld world(q.scene, model_of(q.table, 0.05, false), {});
  auto query = world.make_query();
  for (std::uint64_t i = 0;; ++i) {
    q.start = uniform_state(world, seed + 100, 2 * i);
    q.goal = uniform_state(world, seed + 100, 2 * i + 1);
    if (world.is_free(q.start, query) && world.is_free(q.goal, query) &&
        !world.is_free_motion(q.start, q.goal, query)) {
      return q;
    }
  }
}

RoadmapOptions study_options(std::uint64_t seed) {
  RoadmapOptions options;
  options.samples = 100;
  options.neighbours = 10;
  options.seed = seed;
  options.attach = GrowingAttach{};
  return options;
}

TEST(ArmPlanners, FindVerifiedPathsTheSameForAnyNumberOfThreads) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Question q = random_question(seed);
    const ArmWorld world(q.scene, model_of(q.table, 0.05, false), {});
    RoadmapOptions options = study_options(seed);
    options.samples.reset();
    RrtOptions trees;
    trees.seed = seed;
    std::vector<Solution<JointState>> first;
    for (const unsigned threads : {1U, 2U, 3U, 8U}) {
      const Execution execution{.threads = threads};
      std::vector<Solution<JointState>> all{
          prm(WorldView(world), q.start, q.goal, options, execution),
          lazy_prm(WorldView(world), q.start, q.goal, options, execution),
          rrt(WorldView(world), q.start, std::span(&q.goal, 1), trees, execution),
          rrt_connect(WorldView(world), q.start, std::span(&q.goal, 1), trees, execution)};
      if (first.empty()) first = all;
      for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].outcome, Outcome::solved) << i;
        EXPECT_EQ(all[i].path, first[i].path) << i;
        EXPECT_EQ(all[i].counters, first[i].counters) << i;
      }
    }
    for (const auto& solution : first) expect_verified(q, solution.path);
    // The same roadmap has the same shortest path, whoever checks its edges.
    EXPECT_NEAR(path_length(first[0].path, joint_distance), path_length(first[1].path, joint_distance), 1e-12);
  }
}

/// Of motions that trees ask for among many obstacles more are free.
TEST(ArmPlanners, ADomainKeepsTreesFromObstaclesThatAreNear) {
  Counters with;
  Counters without;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Question q = random_question(seed, 60);
    const ArmWorld world(q.scene, model_of(q.table, 0.05, false), {});
    const auto planned = [&](std::optional<double> domain) {
      const RrtOptions trees{
          .sampler = SamplerKind::halton, .step = 0.5, .domain = domain, .nodes = 1'000, .seed = seed};
      return rrt_connect(WorldView(world), q.start, std::span(&q.goal, 1), trees, {.threads = 1});
    };
    const Solution<JointState> near = planned(5.0);
    if (near.outcome == Outcome::solved) expect_verified(q, near.path);
    EXPECT_EQ(near.path, planned(5.0).path);
    const Solution<JointState> far = planned({});
    if (near.outcome != Outcome::solved || far.outcome != Outcome::solved) continue;
    with += near.counters;
    without += far.counters;
  }
  EXPECT_GT(with.edges_free * without.edges_checked, without.edges_free * with.edges_checked);
}

/// Of the motions that trees grow; where as many move as there are joints, none is left out.
TEST(ArmPlanners, MotionsTowardsSamplesMoveSomeJoints) {
  double few = 0.0;
  double more = 0.0;
  double all = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Question q = random_question(seed, 60);
    const ArmWorld world(q.scene, model_of(q.table, 0.05, false), {});
    const auto moved = [&](std::optional<double> moving) {
      const RrtOptions trees{.sampler = SamplerKind::halton, .step = 0.1, .moving = moving, .nodes = 400, .seed = seed};
      PlannedRoadmap<JointState> grown;
      const auto found = rrt_connect(WorldView(world), q.start, std::span(&q.goal, 1), trees, {.threads = 1}, &grown);
      if (found.outcome == Outcome::solved) expect_verified(q, found.path);
      double joints = 0.0;
      for (const Edge& motion : grown.motions) {
        for (std::size_t j = 0; j < 6; ++j)
          joints += grown.states[motion.from][j] != grown.states[motion.to][j] ? 1 : 0;
      }
      return std::pair(joints / static_cast<double>(std::max<std::size_t>(1, grown.motions.size())), found.path);
    };
    const auto whole = moved({});
    EXPECT_EQ(moved(6.0), whole);
    few += moved(2.0).first;
    more += moved(4.0).first;
    all += whole.first;
  }
  EXPECT_LT(few + 5.0, more);
  EXPECT_LT(more + 5.0, all);
}

constexpr const char* nine_spheres = "tests/data/nine-spheres.scene";

class StudyScene : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    question_.scene = read_world(test::source_dir() + "/" + GetParam(), {});
    std::copy_n(question_.scene.start.begin(), most_chain_joints, question_.start.begin());
    std::copy_n(question_.scene.goal.begin(), most_chain_joints, question_.goal.begin());
    world_.emplace(question_.scene, model_of(question_.table, 0.05, false), ArmOptions{});
  }
  Question question_;
  std::optional<ArmWorld> world_;
};

TEST_P(StudyScene, AHundredSamplesSolveItForEachOfAHundredSeeds) {
  std::vector<double> lengths;
  std::vector<std::uint64_t> seeds = test::seeds(88, 4, 13);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) seeds.push_back(seed);
  for (const std::uint64_t seed : seeds) {
    SCOPED_TRACE(seed);
    const auto found = prm(WorldView(*world_), question_.start, question_.goal, study_options(seed), {});
    ASSERT_EQ(found.outcome, Outcome::solved);
    if (seed > 12) continue;
    Counters counters;
    const auto shorter = shortcut_path(WorldView(*world_), found.path, joint_distance, {.seed = seed}, {}, counters);
    expect_verified(question_, shorter);
    lengths.push_back(path_length(shorter, joint_distance));
  }
  if (GetParam() != std::string(nine_spheres)) return;
  constexpr double best_known = 3.752;  // of 350 paths: prm's and rrt-connect's, made shorter
  std::sort(lengths.begin(), lengths.end());
  EXPECT_LE(lengths.front(), 1.05 * best_known);
  EXPECT_LE(lengths[lengths.size() / 2], 1.15 * best_known);
  EXPECT_GT(lengths.front(), joint_distance(question_.start, question_.goal));  // the straight line, which is blocked
}

TEST_P(StudyScene, ThePathsEndsAreAttachedWithinARadiusThatGrows) {
  RoadmapOptions options = study_options(1);
  options.attach = GrowingAttach{.radius = 1e-3, .step = 1e-3, .tries = 10};
  const auto narrow = prm(WorldView(*world_), question_.start, question_.goal, options, {});
  const bool straight = world_->judge_motion(question_.start, question_.goal) == MotionVerdict::free;
  if (!straight) {
    EXPECT_EQ(narrow.outcome, Outcome::not_connected);  // nothing is so near
    EXPECT_EQ(narrow.separation.start_size, 1U);
    EXPECT_EQ(narrow.separation.goal_size, 1U);
  }
  options.attach = GrowingAttach{.radius = 0.1, .step = 0.5, .tries = 10};
  EXPECT_EQ(prm(WorldView(*world_), question_.start, question_.goal, options, {}).outcome, Outcome::solved);
  options.attach->tries = 0;
  EXPECT_THROW(prm(WorldView(*world_), question_.start, question_.goal, options, {}), InputError);
}

INSTANTIATE_TEST_SUITE_P(Puma, StudyScene, ::testing::Values("examples/worlds/puma.scene", nine_spheres));

}  // namespace
}  // namespace warren
