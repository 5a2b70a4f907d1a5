// SPDX-License-Identifier: BSD-3-Clause
// The oracle is the plain pipeline: prm over MazeWorld, with its own index, neighbours, graph and search.
#include "planners/tiled/tiled_prm_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"
#include "planners/roadmap/prm.hpp"
#include "planners/tiles/wall_partition.hpp"
#include "scenes/mazes/held_cells.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/mazes/spanning_maze.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"
#include "verify/judges/verify_point.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {
namespace {

using test::length_of;

struct TiledCase {
  Scene scene;
  LatticeSize lattice;
  double clearance = 0.1;
  Vec2 start;
  Vec2 goal;
};

TiledCase maze_case(const MazeOptions& maze, double clearance = 0.1, bool merged = false) {
  Scene scene = maze_scene(maze, merged, {});
  const Vec2 start{scene.start[0], scene.start[1]};
  const Vec2 goal{scene.goal[0], scene.goal[1]};
  return {std::move(scene), {maze.rows, maze.cols}, clearance, start, goal};
}

std::vector<Segment> segments_of(const WallSet& walls) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < walls.size(); ++i) segments.push_back(walls.segment(i));
  return segments;
}

RoadmapOptions options_of(const TiledCase& c) {
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = c.lattice;
  return options;
}

Solution<Vec2> tiled(const TiledCase& c, const Execution& execution = {}) {
  std::vector<Segment> bounds;
  if (c.scene.bounds) {
    const Box& box = *c.scene.bounds;
    const Vec2 corners[] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    for (int i = 0; i < 4; ++i) bounds.push_back({corners[i], corners[(i + 1) % 4]});
  }
  return tiled_prm({c.scene.walls, bounds, c.scene.bounds, c.clearance, c.start, c.goal}, options_of(c), execution);
}

class TakenPath : public PathTaker {
 public:
  void begin(std::uint64_t count) override { announced = count; }
  void add(std::span<const Vec2> piece) override {
    if (!points.empty()) {
      EXPECT_EQ(points.back(), piece.front());
      piece = piece.subspan(1);
    }
    points.insert(points.end(), piece.begin(), piece.end());
  }
  std::uint64_t announced = 0;
  Path<Vec2> points;
};

/// The same question to walls that are made tile by tile.
Solution<Vec2> streamed(const TiledCase& c, const CellWallSource& cells, const Execution& execution = {}) {
  const WallSet none;
  TakenPath taken;
  Solution<Vec2> solution =
      tiled_prm({none, {}, {}, c.clearance, c.start, c.goal, &cells, true, &taken}, options_of(c), execution);
  EXPECT_EQ(taken.points.size(), taken.announced);
  if (solution.outcome == Outcome::solved) solution.path = std::move(taken.points);
  return solution;
}

Solution<Vec2> plain(const TiledCase& c) {
  const MazeWorld world(c.scene, c.clearance, {});
  return prm(world, c.start, c.goal, options_of(c), {});
}

void expect_same_answer(const TiledCase& c, const Solution<Vec2>& expected, const Solution<Vec2>& found) {
  ASSERT_EQ(name_of(found.outcome), name_of(expected.outcome));
  EXPECT_EQ(found.roadmap.milestones, expected.roadmap.milestones);
  EXPECT_EQ(found.roadmap.edges, expected.roadmap.edges);
  EXPECT_EQ(found.roadmap.components, expected.roadmap.components);
  EXPECT_EQ(found.counters.samples, expected.counters.samples);
  EXPECT_EQ(found.counters.neighbour_queries, expected.counters.neighbour_queries);
  EXPECT_EQ(found.counters.edges_checked, expected.counters.edges_checked);
  EXPECT_NEAR(length_of(found), length_of(expected), 1e-12 * length_of(expected));
  if (found.outcome == Outcome::solved) {
    VerifyOptions verify;
    verify.clearance = c.clearance;
    EXPECT_TRUE(verify_path(c.scene, found.path, verify, {}).verified);
    EXPECT_EQ(found.path.front(), c.start);
    EXPECT_EQ(found.path.back(), c.goal);
  }
  if (found.outcome == Outcome::not_connected) {
    EXPECT_EQ(found.separation.start_size, expected.separation.start_size);
    EXPECT_EQ(found.separation.goal_size, expected.separation.goal_size);
    EXPECT_EQ(found.separation.nearest_gap, expected.separation.nearest_gap);
  }
}

void expect_same_bytes(const Solution<Vec2>& expected, const Solution<Vec2>& found) {
  ASSERT_EQ(name_of(found.outcome), name_of(expected.outcome));
  EXPECT_EQ(found.path, expected.path);
  EXPECT_EQ(found.counters, expected.counters);
  EXPECT_EQ(found.roadmap.milestones, expected.roadmap.milestones);
  EXPECT_EQ(found.roadmap.edges, expected.roadmap.edges);
  EXPECT_EQ(found.roadmap.components, expected.roadmap.components);
  EXPECT_EQ(found.separation.start_size, expected.separation.start_size);
  EXPECT_EQ(found.separation.goal_size, expected.separation.goal_size);
  if (found.outcome == Outcome::not_connected) {
    EXPECT_EQ(found.separation.nearest_gap, expected.separation.nearest_gap);
  }
}

TEST(TiledPrm, BandsAndFormsOfWallsChangeNothing) {
  for (const double loops : {0.0, 0.05, -1.0}) {  // below 0: start and goal are apart
    SCOPED_TRACE(loops);
    TiledCase c = maze_case({500, 640, 5, MazeAlgorithm::backtracker, std::max(loops, 0.0)});
    if (loops < 0.0) {
      std::vector<Segment> walls = segments_of(c.scene.walls);
      walls.push_back({{300.5, 0.5}, {300.5, 500.5}});
      c.scene.walls = WallSet::narrowest(walls);
    }
    ASSERT_TRUE(c.scene.walls.holds_packed());
    RawVector<FloatWall> floats;
    RawVector<DoubleWall> doubles;
    for (const Segment& s : segments_of(c.scene.walls)) {
      doubles.push_back({s.a.x, s.a.y, s.b.x, s.b.y});
      floats.push_back(unpacked(PackedWall::of(s.a.x, s.a.y, s.b.x, s.b.y)));
    }
    const WallSet sets[] = {c.scene.walls, WallSet(std::move(floats)), WallSet(std::move(doubles))};
    const Solution<Vec2> expected = tiled(c);
    EXPECT_EQ(expected.outcome, loops < 0.0 ? Outcome::not_connected : Outcome::solved);
    for (const WallSet& walls : sets) {
      for (const std::uint32_t bands : {1U, 2U, 3U, 7U}) {
        for (const unsigned threads : {1U, 3U}) {
          SCOPED_TRACE(testing::Message() << walls.bytes() << " " << bands << " " << threads);
          TiledProblem problem{walls, {}, {}, c.clearance, c.start, c.goal};
          problem.bands = bands;
          expect_same_bytes(expected, tiled_prm(problem, options_of(c), {.threads = threads}));
        }
      }
    }
  }
}

void expect_same_answer(const TiledCase& c) { expect_same_answer(c, plain(c), tiled(c)); }

TEST(TiledPrm, GivesThePlainAnswerWhereTilesAreMadeWhenTheyAreAskedFor) {
  const LatticeSize sizes[] = {{1, 1}, {1, 90}, {70, 1}, {63, 65}, {64, 64}, {130, 131}};
  for (const LatticeSize size : sizes) {
    for (const double loops : {0.0, 0.1, 1.0}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(std::to_string(size.rows) + "x" + std::to_string(size.cols) + " seed " + std::to_string(seed) +
                     " loops " + std::to_string(loops));
        const MazeOptions maze{size.rows, size.cols, seed, MazeAlgorithm::backtracker, loops};
        const TiledCase c = maze_case(maze);
        const Solution<Vec2> expected = plain(c);
        for (const unsigned side_log2 : {2U, 5U, 8U}) {
          const HeldCells cells(generate_maze(maze, {}), side_log2);
          expect_same_answer(c, expected, streamed(c, cells));
        }
      }
    }
  }
}

TEST(TiledPrm, WalksFromAnywhereAmongTilesThatAreMadeWhenTheyAreAskedFor) {
  const MazeOptions maze{50, 60, 4, MazeAlgorithm::kruskal, 0.1};
  const HeldCells cells(generate_maze(maze, {}), 4);
  TiledCase c = maze_case(maze, 0.2);
  for (const Vec2 start : {Vec2{17, 31}, Vec2{16.2, 16.7}, Vec2{59.7, 50.2}, Vec2{17.5, 16.5}}) {
    c.start = start;
    SCOPED_TRACE(std::to_string(start.x) + " " + std::to_string(start.y));
    expect_same_answer(c, plain(c), streamed(c, cells));
  }
}

TEST(TiledPrm, SaysHowFarApartTheEndsAreWhereTilesWereForgotten) {
  MazeCells cells = generate_maze({40, 40, 2, MazeAlgorithm::kruskal, 0.0}, {});
  MazeCells closed(40, 40);
  for (std::uint32_t col = 0; col < 40; ++col) {
    for (std::uint32_t row = 0; row < 40; ++row) {
      if (col != 19 && !cells.wall_right(col, row)) closed.open_right(col, row);
      if (!cells.wall_above(col, row)) closed.open_above(col, row);
    }
  }
  TiledCase c = maze_case({40, 40, 2, MazeAlgorithm::kruskal, 0.0});
  c.scene.walls = maze_walls(closed, false, {});
  expect_same_answer(c, plain(c), streamed(c, HeldCells(closed, 3)));
}

TEST(TiledPrm, MadeTilesGiveTheSamePathForAnyThreads) {
  const SpanningMaze cells(300, 280, 3, 0.05, {}, 5);
  const TiledCase c = maze_case({300, 280, 3, MazeAlgorithm::mst, 0.05});
  const Solution<Vec2> expected = streamed(c, cells, {.threads = 1});
  expect_same_answer(c, plain(c), expected);
  for (const unsigned threads : {2U, 3U, 8U}) EXPECT_EQ(streamed(c, cells, {.threads = threads}).path, expected.path);
}

TEST(TiledPrm, RefusesAClearanceOfHalfACellWhereTilesAreMade) {
  const TiledCase c = maze_case({5, 5, 1}, 0.5);
  EXPECT_THROW(streamed(c, HeldCells(generate_maze({5, 5, 1}, {}), 3)), InputError);
}

TEST(TiledPrm, HeldWallsGiveTheSamePathWhereTheirTilesAreForgotten) {
  const TiledCase c = maze_case({200, 190, 6, MazeAlgorithm::backtracker, 0.1});
  const Solution<Vec2> found =
      tiled_prm({c.scene.walls, {}, {}, c.clearance, c.start, c.goal, nullptr, true}, options_of(c), {});
  EXPECT_EQ(found.path, tiled(c).path);
}

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

TEST(WallPartition, KnowsTheBoxOfFloatsAndDoubles) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    std::vector<Segment> segments;
    for (int i = 0; i < 50; ++i) {
      const auto number = [&] { return static_cast<double>(rng.below(4000)) / 16.0 - 100.0; };
      segments.push_back({{number(), number()}, {number(), 3.0 * number()}});
    }
    if (seed % 2 == 0) segments.push_back({{0.1, 0.2}, {0.3, -0.4}});  // no floats: the set holds doubles
    if (seed == 20) segments.clear();
    Scene scene;
    scene.walls = WallSet::narrowest(segments);
    const TileGrid grid = TileGrid::of({70, 90});
    const Box found = WallPartition(scene.walls, {}, grid, 1.2, {}).box();
    const Box box = obstacle_box(scene);
    EXPECT_EQ(found.min, box.min);
    EXPECT_EQ(found.max, box.max);
  }
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
