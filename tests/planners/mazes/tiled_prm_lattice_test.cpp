// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/tiled_prm_lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "tests/planners/mazes/tiled_cases.hpp"

namespace warren {
namespace {

using test::expect_same_answer;
using test::maze_case;
using test::options_of;
using test::plain;
using test::segments_of;
using test::tiled;
using test::TiledCase;

TEST(TiledPrm, GivesThePlainAnswerInMazesThatStraddleTiles) {
  const LatticeSize sizes[] = {{1, 1}, {1, 90}, {70, 1}, {5, 7}, {63, 65}, {64, 64}, {65, 129}, {128, 40}, {130, 131}};
  std::uint64_t seed = 1;
  for (const LatticeSize size : sizes) {
    for (const MazeAlgorithm algorithm : {MazeAlgorithm::backtracker, MazeAlgorithm::kruskal, MazeAlgorithm::wilson}) {
      for (const double loops : {0.0, 0.1, 1.0}) {
        SCOPED_TRACE(std::to_string(size.rows) + "x" + std::to_string(size.cols) + " seed " + std::to_string(++seed) +
                     " loops " + std::to_string(loops));
        expect_same_answer(maze_case({size.rows, size.cols, seed, algorithm, loops}));
      }
    }
  }
}

TEST(TiledPrm, GivesThePlainAnswerForEveryClearance) {
  for (const double clearance : {0.0, 0.3, 0.499999, 0.5, 0.7, 3.0, 8.0}) {
    SCOPED_TRACE(clearance);
    expect_same_answer(maze_case({66, 70, 3, MazeAlgorithm::backtracker, 0.2}, clearance));
  }
}

/// Walls of all kinds: short, long, slanted, of length zero, on and off the grid; few enough to leave ways through.
std::vector<Segment> random_walls(std::uint64_t seed, LatticeSize lattice, int count) {
  SequentialRng rng(seed);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(rng.next() >> 11) * 0x1p-53;
  };
  std::vector<Segment> walls = {{{0.5, 0.5}, {lattice.cols + 0.5, 0.5}},
                                {{0.5, lattice.rows + 0.5}, {lattice.cols + 0.5, lattice.rows + 0.5}}};
  for (int i = 0; i < count; ++i) {
    const double reach = i % 40 == 0 ? 300.0 : i % 5 == 0 ? 12.0 : 1.5;
    Vec2 a{number(-5, lattice.cols + 6.0), number(-5, lattice.rows + 6.0)};
    Vec2 b{a.x + number(-reach, reach), a.y + number(-reach, reach)};
    const double step = i % 3 == 0 ? 0.5 : i % 3 == 1 ? 1.0 / 128 : 0.0;  // every third anywhere
    if (step > 0.0) {
      for (double* c : {&a.x, &a.y, &b.x, &b.y}) *c = std::round(*c / step) * step;
    }
    if (i % 50 == 7) b = a;
    walls.push_back({a, b});
  }
  return walls;
}

TEST(TiledPrm, GivesThePlainAnswerAmongArbitrarySegments) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const LatticeSize lattice{70, 140};
    const int count = seed % 4 == 0 ? 3000 : seed % 4 == 1 ? 60 : seed % 4 == 2 ? 700 : 1500;
    const double clearances[] = {0.0, 0.1, 0.02, 0.6};
    TiledCase c{{}, lattice, clearances[seed / 4 % 4], {0.5, 1.0}, {140.5, 70.0}};
    c.scene.walls = WallSet::narrowest(random_walls(seed, lattice, count));
    expect_same_answer(c);
  }
}

TEST(TiledPrm, TheOrderAndTheCutOfTheWallsDontMatter) {
  const TiledCase whole = maze_case({70, 130, 5, MazeAlgorithm::kruskal, 0.05});
  const Solution<Vec2> expected = tiled(whole);
  std::vector<Segment> walls = segments_of(whole.scene.walls);
  std::vector<Segment> split;
  for (const Segment& w : walls) {
    const Vec2 middle = 0.5 * (w.a + w.b);
    split.push_back({w.a, middle});
    split.push_back({w.b, middle});
  }
  std::vector<Segment> mixed = walls;
  SequentialRng rng(1);
  for (std::size_t i = mixed.size(); i > 1; --i) std::swap(mixed[i - 1], mixed[rng.below(i)]);
  for (Segment& w : mixed) {
    if (rng.below(2) == 1) std::swap(w.a, w.b);
  }
  std::vector<Segment> reversed(walls.rbegin(), walls.rend());
  std::vector<Segment> doubled = walls;
  doubled.insert(doubled.end(), walls.begin(), walls.end());
  doubled.push_back({{1e60, 1e60}, {1e60, -1e60}});  // makes doubles of all
  const std::vector<Segment> merged =
      segments_of(maze_case({70, 130, 5, MazeAlgorithm::kruskal, 0.05}, 0.1, true).scene.walls);
  const std::vector<Segment>* variants[] = {&split, &mixed, &reversed, &doubled, &merged};
  for (std::size_t i = 0; i < std::size(variants); ++i) {
    SCOPED_TRACE(i);
    TiledCase c = whole;
    c.scene.walls = WallSet::narrowest(*variants[i]);
    const Solution<Vec2> found = tiled(c);
    EXPECT_EQ(found.path, expected.path);
    EXPECT_EQ(found.counters, expected.counters);
    EXPECT_EQ(found.roadmap.edges, expected.roadmap.edges);
  }
}

TEST(TiledPrm, AnyNumberOfThreadsGivesTheSameAnswer) {
  std::vector<TiledCase> cases = {maze_case({200, 300, 2, MazeAlgorithm::backtracker, 0.0}),
                                  maze_case({210, 190, 3, MazeAlgorithm::kruskal, 0.3})};
  TiledCase open{{}, {150, 150}, 0.1, {0.5, 1.0}, {150.5, 150.0}};
  open.scene.walls = WallSet::narrowest(random_walls(9, open.lattice, 900));
  cases.push_back(std::move(open));
  for (const TiledCase& c : cases) {
    Execution one;
    one.threads = 1;
    const Solution<Vec2> expected = tiled(c, one);
    for (const unsigned threads : {2U, 3U, 8U}) {
      SCOPED_TRACE(threads);
      Execution execution;
      execution.threads = threads;
      const Solution<Vec2> found = tiled(c, execution);
      EXPECT_EQ(found.outcome, expected.outcome);
      EXPECT_EQ(found.path, expected.path);
      EXPECT_EQ(found.counters, expected.counters);
      EXPECT_EQ(found.roadmap.components, expected.roadmap.components);
    }
  }
}

TEST(TiledPrm, LargerTilesGiveThePlainAnswerToo) {
  // 600 x 500 cells have tiles of 128, 2050 x 2100 tiles of 256.
  expect_same_answer(maze_case({600, 500, 4, MazeAlgorithm::backtracker, 0.02}));
}

TEST(TiledPrm, StartAndGoalMayStandAnywhere) {
  const TiledCase base = maze_case({66, 67, 8, MazeAlgorithm::backtracker, 0.1});
  SequentialRng rng(4);
  const auto place = [&] {
    const auto number = [&] { return 0.5 + 66.0 * static_cast<double>(rng.next() >> 11) * 0x1p-53; };
    return Vec2{number(), number()};
  };
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    TiledCase c = base;
    c.start = place();
    c.goal = i % 4 == 0 ? c.start : i % 4 == 1 ? Vec2{c.start.x + 0.3, c.start.y} : place();
    if (i % 5 == 0) c.start = {std::round(c.start.x), std::round(c.start.y)};
    expect_same_answer(c);
  }
}

TEST(TiledPrm, AnEndOnAWallOrOutsideTheBoxIsBlocked) {
  TiledCase c = maze_case({20, 20, 1});
  c.start = {5.5, 0.5};
  EXPECT_EQ(tiled(c).outcome, Outcome::start_blocked);
  c.start = {-3.0, 4.0};
  EXPECT_EQ(tiled(c).outcome, Outcome::start_blocked);
  c = maze_case({20, 20, 1});
  c.goal = {40.0, 4.0};
  EXPECT_EQ(tiled(c).outcome, Outcome::goal_blocked);
  EXPECT_TRUE(tiled(c).path.empty());
}

TEST(TiledPrm, BoundsAreWallsAndConfineTheMilestones) {
  TiledCase c = maze_case({40, 40, 1, MazeAlgorithm::backtracker, 0.5});
  c.scene.bounds = Box{{3.2, 2.1}, {30.0, 38.95}};
  c.start = {5.0, 4.0};
  c.goal = {28.0, 36.0};
  expect_same_answer(c);
}

TEST(TiledPrm, AWallAcrossTheMazeParts) {
  TiledCase c = maze_case({80, 90, 6, MazeAlgorithm::prim, 0.1});
  std::vector<Segment> walls = segments_of(c.scene.walls);
  walls.push_back({{0.5, 20.3}, {90.5, 61.7}});
  c.scene.walls = WallSet::narrowest(walls);
  ASSERT_EQ(plain(c).outcome, Outcome::not_connected);
  expect_same_answer(c);
}

TEST(TiledPrm, AnEmptyWorldIsCrossedStraight) {
  TiledCase c{{}, {150, 70}, 0.1, {0.5, 1.0}, {70.5, 150.0}};
  c.scene.walls = WallSet::narrowest(std::vector<Segment>{{{0.5, 0.5}, {70.5, 0.5}}, {{0.5, 150.5}, {70.5, 150.5}}});
  expect_same_answer(c);
}

TEST(TiledPrm, ABudgetThatHasEndedStopsIt) {
  const TiledCase c = maze_case({100, 100, 1});
  const Deadline ended(0.0);
  Execution execution;
  execution.deadline = &ended;
  EXPECT_EQ(tiled(c, execution).outcome, Outcome::stopped);
  const Deadline no_memory(1e6, 1);
  execution.deadline = &no_memory;
  const Solution<Vec2> solution = tiled(c, execution);
  EXPECT_EQ(solution.outcome, Outcome::stopped);
  EXPECT_EQ(solution.stop_reason, StopReason::memory);
}

TEST(TiledPrm, RefusesWhatItCannotAnswerAsThePlainPipeline) {
  const TiledCase c = maze_case({10, 10, 1});
  RoadmapOptions options = options_of(c);
  EXPECT_TRUE(tiled_prm_applies(options, 0.1));
  EXPECT_FALSE(tiled_prm_applies(options, 9.0));
  options.radius = 1.5;
  EXPECT_FALSE(tiled_prm_applies(options, 0.1));
  const TiledProblem problem{c.scene.walls, {}, obstacle_box(c.scene), 0.1, c.start, c.goal};
  EXPECT_THROW(tiled_prm(problem, options, {}), InputError);
  options = options_of(c);
  options.sampler = SamplerKind::uniform;
  EXPECT_FALSE(tiled_prm_applies(options, 0.1));
  options = options_of(c);
  options.search = SearchKind::bfs;
  EXPECT_FALSE(tiled_prm_applies(options, 0.1));
}

}  // namespace
}  // namespace warren
