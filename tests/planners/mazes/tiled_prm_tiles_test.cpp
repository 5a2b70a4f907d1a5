// SPDX-License-Identifier: BSD-3-Clause
// Where tiles come from changes nothing: filed in bands, from walls in any form, forgotten, or made when asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/mazes/spanning_maze.hpp"
#include "tests/planners/mazes/tiled_cases.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using test::expect_same_answer;
using test::maze_case;
using test::options_of;
using test::plain;
using test::segments_of;
using test::tiled;
using test::TiledCase;

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
    for (const std::uint64_t form : test::seeds(24, 3, 0)) {
      const WallSet& walls = sets[form % 3];
      const std::uint32_t bands = std::array{1U, 2U, 3U, 7U}[form / 3 % 4];
      const unsigned threads = form < 12 ? 1 : 3;
      SCOPED_TRACE(testing::Message() << walls.bytes() << " " << bands << " " << threads);
      TiledProblem problem{walls, {}, {}, c.clearance, c.start, c.goal};
      problem.bands = bands;
      expect_same_bytes(expected, tiled_prm(problem, options_of(c), {.threads = threads}));
    }
  }
}

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

}  // namespace
}  // namespace warren
