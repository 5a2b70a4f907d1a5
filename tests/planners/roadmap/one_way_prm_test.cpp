// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap/one_way_prm.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "planners/shorten/shortcut.hpp"
#include "solve/kinds/planned_worlds.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "verify/judges/verify_turning.hpp"
#include "worlds/poses/car_world.hpp"

namespace warren {
namespace {

using Forwards = CarWorld<DubinsCurve>;
using BothWays = CarWorld<ReedsSheppCurve>;

/// Three walls to be passed in a slalom.
Scene slalom() {
  Scene scene;
  scene.bounds = Box{{0, 0}, {12, 6}};
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{3, 0}, {3, 3.5}}, {{6, 6}, {6, 2.5}}, {{9, 0}, {9, 3.5}}});
  return scene;
}

constexpr Se2 start{1, 1, 0};
constexpr Se2 goal{11, 1, 0};
const CarOptions car{.turning_radius = 0.7, .radius = 0.2};

/// What the program does with a path: joints, and at most a quarter turn a leg.
template <class W>
std::vector<Se2> poses_along(const W& world, const Path<Se2>& path) {
  std::vector<Se2> poses{path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const SteeringCurve curve = world.curve(path[i - 1], path[i]);
    double begin = 0.0;
    for (std::size_t k = 0; k < curve.piece_count(); ++k) {
      for (int part = 1; part < 8; ++part) poses.push_back(curve.at(begin + curve.piece_length(k) * part / 8));
      begin += curve.piece_length(k);
      poses.push_back(curve.joint(k + 1));
    }
  }
  return poses;
}

template <class W>
void expect_verified(const Scene& scene, const W& world, const Path<Se2>& path) {
  ASSERT_GE(path.size(), 2U);
  const RobotSpec body{.kind = RobotKind::car,
                       .radius = car.radius,
                       .turning_radius = car.turning_radius,
                       .steering = W::one_way ? SteeringKind::dubins : SteeringKind::reeds_shepp};
  const auto v = verify_car(scene, body, poses_along(world, path), {.start = start, .goal = goal}, {});
  EXPECT_TRUE(v.verified) << v.first_violation->obstacle;
  const auto length = [&](const Se2& a, const Se2& b) { return world.distance(a, b); };
  EXPECT_NEAR(v.length, path_length(path, length), 1e-8);
}

TEST(OneWayPrm, SolvesASlalomWithVerifiedPathsOnEverySeed) {
  const Scene scene = slalom();
  const Forwards world(scene, car);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    for (const bool lazy : {false, true}) {
      const auto solution = one_way_prm(WorldView(world), start, goal, {.seed = seed}, lazy, {});
      ASSERT_EQ(solution.outcome, Outcome::solved);
      expect_verified(scene, world, solution.path);
    }
  }
}

TEST(OneWayPrm, LazilyThePathIsTheSame) {
  const Forwards world(slalom(), car);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const RoadmapOptions options{.samples = 400, .seed = seed};
    const auto all = one_way_prm(WorldView(world), start, goal, options, false, {});
    const auto lazy = one_way_prm(WorldView(world), start, goal, options, true, {});
    EXPECT_EQ(all.outcome, lazy.outcome);
    EXPECT_EQ(all.path, lazy.path);
    EXPECT_LT(lazy.counters.edges_checked, all.counters.edges_checked);
  }
}

TEST(OneWayPrm, SameAnswerForAnyNumberOfThreads) {
  const Forwards world(slalom(), car);
  for (const bool lazy : {false, true}) {
    Execution one;
    one.threads = 1;
    const auto expected = one_way_prm(WorldView(world), start, goal, {.samples = 500, .seed = 2}, lazy, one);
    for (const unsigned threads : {2U, 3U, 8U}) {
      Execution many;
      many.threads = threads;
      const auto found = one_way_prm(WorldView(world), start, goal, {.samples = 500, .seed = 2}, lazy, many);
      EXPECT_EQ(found.path, expected.path);
      EXPECT_EQ(found.counters.edges_checked, expected.counters.edges_checked);
      EXPECT_EQ(found.counters.expanded, expected.counters.expanded);
      EXPECT_EQ(found.roadmap.edges, expected.roadmap.edges);
    }
  }
}

/// Dijkstra by hand over the graph that the planner keeps.
TEST(OneWayPrm, ThePathIsTheShortestOfItsRoadmap) {
  const Forwards world(slalom(), car);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    PlannedRoadmap<Se2> roadmap;
    const auto solution =
        one_way_prm(WorldView(world), start, goal, {.samples = 400, .seed = seed}, false, {}, &roadmap);
    if (solution.outcome != Outcome::solved) continue;
    const std::size_t n = roadmap.states.size();
    std::vector<double> best(n, std::numeric_limits<double>::infinity());
    best[n - 2] = 0.0;
    auto query = world.make_query();
    for (bool better = true; better;) {  // Bellman and Ford
      better = false;
      for (VertexId v = 0; v < n; ++v) {
        for (const VertexId w : roadmap.graph.neighbours(v)) {
          const double through = best[v] + world.distance(roadmap.states[v], roadmap.states[w]);
          if (through < best[w] - 1e-12) best[w] = through, better = true;
        }
      }
    }
    const auto length = [&](const Se2& a, const Se2& b) { return world.distance(a, b); };
    EXPECT_NEAR(path_length(solution.path, length), best[n - 1], 1e-9);
    for (VertexId v = 0; v < n; ++v) {
      for (const VertexId w : roadmap.graph.neighbours(v)) {
        ASSERT_TRUE(world.is_free_motion(roadmap.states[v], roadmap.states[w], query));
      }
    }
  }
}

TEST(OneWayPrm, TellsHowFarStartAndGoalAreApart) {
  Scene scene = slalom();
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{6, 0}, {6, 6}}});
  const Forwards world(scene, car);
  const auto solution = one_way_prm(WorldView(world), start, goal, {.samples = 300, .seed = 1}, true, {});
  EXPECT_EQ(solution.outcome, Outcome::not_connected);
  const auto checked = one_way_prm(WorldView(world), start, goal, {.samples = 300, .seed = 1}, false, {});
  EXPECT_EQ(solution.counters.edges_checked, checked.counters.edges_checked)
      << "what the search asked is not asked again";
  EXPECT_EQ(solution.counters.edges_free, checked.counters.edges_free);
  EXPECT_GT(solution.separation.start_size, 20U);
  EXPECT_GT(solution.separation.goal_size, 20U);
  EXPECT_GT(solution.separation.nearest_gap, 0.0);
  const RoadmapOptions untold{.samples = 300, .seed = 1, .tells_separation = false};
  const auto unasked = one_way_prm(WorldView(world), start, goal, untold, true, {});
  EXPECT_EQ(unasked.outcome, Outcome::not_connected);
  EXPECT_FALSE(unasked.separation.is_known());
  EXPECT_LT(unasked.counters.edges_checked, solution.counters.edges_checked) << "nobody wants the other edges";
  EXPECT_EQ(one_way_prm(WorldView(world), {6, 1, 0}, goal, {.samples = 10}, true, {}).outcome, Outcome::start_blocked);
  EXPECT_EQ(one_way_prm(WorldView(world), start, {6, 1, 0}, {.samples = 10}, true, {}).outcome, Outcome::goal_blocked);
}

/// The goals' tree grows backwards: its curves are driven towards the goal.
template <class W>
void expect_trees_to_solve() {
  const Scene scene = slalom();
  const W world(scene, car);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    for (const auto planner : {rrt<Se2, is_one_way<W>>, rrt_connect<Se2, is_one_way<W>>}) {
      PlannedRoadmap<Se2> trees;
      const auto solution = planner(WorldView(world), start, std::span(&goal, 1), {.seed = seed}, {}, &trees);
      ASSERT_EQ(solution.outcome, Outcome::solved);
      expect_verified(scene, world, solution.path);
      auto query = world.make_query();
      for (const Edge& motion : trees.motions) {
        ASSERT_TRUE(world.is_free_motion(trees.states[motion.from], trees.states[motion.to], query));
      }
    }
  }
}

TEST(OneWayTrees, SolveAndVerifyForwards) { expect_trees_to_solve<Forwards>(); }
TEST(OneWayTrees, SolveAndVerifyBothWays) { expect_trees_to_solve<BothWays>(); }

template <class W>
void expect_shortcuts_to_shorten() {
  const Scene scene = slalom();
  const W world(scene, car);
  const auto length = [&](const Se2& a, const Se2& b) { return world.distance(a, b); };
  double before = 0.0;
  double after = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    const auto solution = rrt_connect(WorldView(world), start, std::span(&goal, 1), {.seed = seed}, {});
    ASSERT_EQ(solution.outcome, Outcome::solved);
    Counters counters;
    const auto shorter = shortcut_path(WorldView(world), solution.path, length, {.seed = seed}, {}, counters);
    expect_verified(scene, world, shorter);
    EXPECT_LE(path_length(shorter, length), path_length(solution.path, length) + 1e-9);
    before += path_length(solution.path, length);
    after += path_length(shorter, length);
  }
  EXPECT_LT(after, 0.95 * before);
}

TEST(OneWayTrees, ShortcutsFollowCurvesForwards) { expect_shortcuts_to_shorten<Forwards>(); }
TEST(OneWayTrees, ShortcutsFollowCurvesBothWays) { expect_shortcuts_to_shorten<BothWays>(); }

}  // namespace
}  // namespace warren
