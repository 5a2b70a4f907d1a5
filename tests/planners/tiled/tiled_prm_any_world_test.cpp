// SPDX-License-Identifier: BSD-3-Clause
// The oracle is the plain pipeline: prm over the same world with the same options.
#include "planners/tiled/tiled_prm_any_world.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"
#include "verify/judges/verify_point.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {
namespace {

using test::length_of;

Execution on(unsigned threads) {
  Execution execution;
  execution.threads = threads;
  return execution;
}

struct TileQuestion {
  Scene scene;
  Vec2 start;
  Vec2 goal;
  RoadmapOptions options;
};

TileQuestion tile_question(std::uint32_t side, double loops, SamplerKind sampler, std::uint64_t seed = 1) {
  TileQuestion q;
  q.scene = maze_scene({side, side, seed, MazeAlgorithm::backtracker, loops}, false, {});
  q.start = {q.scene.start[0], q.scene.start[1]};
  q.goal = {q.scene.goal[0], q.scene.goal[1]};
  q.options.sampler = sampler;
  q.options.seed = seed;
  q.options.lattice = {side, side};
  return q;
}

/// The same answer as the plain pipeline's, the same roadmap, and the same bytes on any number of threads.
void expect_plain_answer(const TileQuestion& q, const std::string& what) {
  SCOPED_TRACE(what);
  const MazeWorld world(q.scene, 0.1, {});
  const auto plain = prm(world, q.start, q.goal, q.options, {});
  const auto tiled = prm_in_tiles(world, q.start, q.goal, q.options, on(1));
  ASSERT_EQ(tiled.outcome, plain.outcome);
  EXPECT_EQ(tiled.roadmap.milestones, plain.roadmap.milestones);
  EXPECT_EQ(tiled.roadmap.edges, plain.roadmap.edges);
  EXPECT_EQ(tiled.roadmap.components, plain.roadmap.components);
  EXPECT_EQ(tiled.counters.edges_checked, plain.counters.edges_checked);
  EXPECT_EQ(tiled.counters.samples, plain.counters.samples);
  EXPECT_EQ(tiled.counters.neighbour_queries, plain.counters.neighbour_queries);
  EXPECT_EQ(tiled.counters.rounds, plain.counters.rounds);
  EXPECT_EQ(tiled.separation.start_size, plain.separation.start_size);
  EXPECT_EQ(tiled.separation.goal_size, plain.separation.goal_size);
  if (plain.outcome == Outcome::solved) {
    EXPECT_NEAR(length_of(tiled.path), length_of(plain.path), 1e-12 * length_of(plain.path));
    VerifyOptions verify;
    verify.clearance = 0.1;
    verify.start = q.start;
    verify.goal = q.goal;
    EXPECT_TRUE(verify_path(q.scene, tiled.path, verify, {}).verified);
  }
  for (const unsigned threads : {2U, 3U, 8U}) {
    const auto again = prm_in_tiles(world, q.start, q.goal, q.options, on(threads));
    EXPECT_EQ(again.path, tiled.path) << threads;
    EXPECT_EQ(again.counters, tiled.counters) << threads;
  }
}

TEST(TiledRoadmap, GivesThePlainAnswerForUniformRoadmaps) {
  for (const double loops : {0.0, 0.1}) {
    for (const std::uint64_t seed : {1U, 2U}) {
      expect_plain_answer(tile_question(100, loops, SamplerKind::uniform, seed),
                          "uniform, loops " + std::to_string(loops));
    }
  }
  expect_plain_answer(tile_question(20, 0.1, SamplerKind::uniform), "less than a tile");
  expect_plain_answer(tile_question(60, 0.3, SamplerKind::halton), "halton");
}

TEST(TiledRoadmap, GivesThePlainAnswerForTheRuleOfTheNearest) {
  TileQuestion q = tile_question(80, 0.2, SamplerKind::uniform);
  q.options.neighbours = 18;
  q.options.samples = 60'000;
  expect_plain_answer(q, "the 18 nearest");
}

TEST(TiledRoadmap, GivesThePlainAnswerForStringyRoadmaps) {
  for (const double loops : {0.0, 0.1}) {
    TileQuestion q = tile_question(250, loops, SamplerKind::lattice);
    expect_plain_answer(q, "a lattice with loops " + std::to_string(loops));  // long chains across four tiles
    q.options.radius = 1.5;
    expect_plain_answer(q, "diagonals too");
    q.options.search = SearchKind::dijkstra;
    expect_plain_answer(q, "uninformed");
  }
}

TEST(TiledRoadmap, SaysHowFarApartThePartsAreThatDoNotMeet) {
  TileQuestion q = tile_question(100, 0.0, SamplerKind::uniform);
  q.options.samples = 25'000;  // too few
  expect_plain_answer(q, "too few samples");
  q = tile_question(5, 0.0, SamplerKind::uniform);
  q.options.samples = 1;
  expect_plain_answer(q, "one sample");
  q = tile_question(150, 0.0, SamplerKind::lattice);
  q.goal = {151.5, 150.9};  // outside, beyond the outline
  expect_plain_answer(q, "no way there");
}

TEST(TiledRoadmap, AnOverlayThatIsReducedAgainGivesTheSamePath) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    TileQuestion q = tile_question(250, 0.02, SamplerKind::lattice, seed);
    const MazeWorld world(q.scene, 0.1, {});
    const auto once = prm_in_tiles(world, q.start, q.goal, q.options, {});
    const Execution execution;
    detail::TiledRoadmapPlan<MazeWorld> plan(world, q.start, q.goal, q.options, execution, 0);
    const auto twice = detail::plan_in_rounds(world, q.start, q.goal, q.options, execution, nullptr, plan);
    ASSERT_EQ(twice.outcome, Outcome::solved);
    EXPECT_LT(twice.counters.expanded, once.counters.expanded) << "it was not reduced";
    EXPECT_NEAR(length_of(twice.path), length_of(once.path), 1e-12 * length_of(once.path));
    for (std::size_t i = 1; i < twice.path.size(); ++i) ASSERT_LE(distance(twice.path[i - 1], twice.path[i]), 1.5);
  }
}

TEST(TiledRoadmap, StandsAtTheGoalAndWithoutMilestones) {
  TileQuestion q = tile_question(30, 0.0, SamplerKind::uniform);
  q.goal = q.start;
  expect_plain_answer(q, "start and goal are one");
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {  // of single samples a fifth is blocked
    q = tile_question(3, 0.0, SamplerKind::random, seed);
    q.options.samples = 1;
    expect_plain_answer(q, "one sample, seed " + std::to_string(seed));
  }
}

TEST(TiledRoadmap, SaysWhichEndIsBlocked) {
  TileQuestion q = tile_question(20, 0.0, SamplerKind::uniform);
  q.start = {1.5, 1.5};  // a corner of cells, where a wall ends
  const MazeWorld world(q.scene, 0.1, {});
  EXPECT_EQ(prm_in_tiles(world, q.start, q.goal, q.options, {}).outcome, Outcome::start_blocked);
  EXPECT_EQ(prm_in_tiles(world, q.goal, q.start, q.options, {}).outcome, Outcome::goal_blocked);
}

TEST(TiledRoadmap, StopsAtTheDeadlineAndWithoutMemory) {
  const TileQuestion q = tile_question(60, 0.0, SamplerKind::uniform);
  const MazeWorld world(q.scene, 0.1, {});
  const Deadline over(0.0);
  Execution execution;
  execution.deadline = &over;
  const auto late = prm_in_tiles(world, q.start, q.goal, q.options, execution);
  EXPECT_EQ(late.outcome, Outcome::stopped);
  EXPECT_TRUE(late.path.empty());
  const Deadline small(std::numeric_limits<double>::infinity(), 1);
  execution.deadline = &small;
  const auto starved = prm_in_tiles(world, q.start, q.goal, q.options, execution);
  EXPECT_EQ(starved.outcome, Outcome::stopped);
  EXPECT_EQ(starved.stop_reason, StopReason::memory);
}

TEST(TiledRoadmap, RefusesSearchesThatDoNotSeekTheShortest) {
  TileQuestion q = tile_question(10, 0.0, SamplerKind::uniform);
  q.options.search = SearchKind::bfs;
  const MazeWorld world(q.scene, 0.1, {});
  EXPECT_THROW(prm_in_tiles(world, q.start, q.goal, q.options, {}), InputError);
}

}  // namespace
}  // namespace warren
