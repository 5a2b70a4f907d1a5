// SPDX-License-Identifier: BSD-3-Clause
// The walls of mazes, cells read back from walls, and floods over them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "tests/scenes/mazes/mazes.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using mazes::all_algorithms;
using mazes::distances_from;
using mazes::drawing;
using mazes::maze;
using mazes::openings;

TEST(MazeWalls, StandInTheCoursesOrder) {
  MazeCells cells(2, 3);
  cells.open_right(0, 0);
  cells.open_above(1, 0);
  const WallSet walls = maze_walls(cells, false, {});
  const std::vector<Segment> expected = {{{0.5, 0.5}, {3.5, 0.5}}, {{0.5, 2.5}, {3.5, 2.5}},
                                         {{0.5, 1.5}, {0.5, 2.5}},   // bottom, top, left
                                         {{3.5, 0.5}, {3.5, 1.5}},   // right
                                         {{0.5, 1.5}, {1.5, 1.5}},   // above (0, 0)
                                         {{1.5, 1.5}, {1.5, 2.5}},   // right of (0, 1)
                                         {{2.5, 0.5}, {2.5, 1.5}},   // right of (1, 0)
                                         {{2.5, 1.5}, {2.5, 2.5}},   // right of (1, 1)
                                         {{2.5, 1.5}, {3.5, 1.5}}};  // above (2, 0)
  ASSERT_EQ(walls.size(), expected.size());
  EXPECT_TRUE(walls.holds_packed());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(walls.segment(i), expected[i]) << i;

  const WallSet merged = maze_walls(cells, true, {});
  const std::vector<Segment> expected_merged = {
      {{0.5, 1.5}, {1.5, 1.5}}, {{1.5, 1.5}, {1.5, 2.5}}, {{2.5, 0.5}, {2.5, 2.5}}, {{2.5, 1.5}, {3.5, 1.5}}};
  ASSERT_EQ(merged.size(), 4 + expected_merged.size());
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(merged.segment(i), expected[i]) << i;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(merged.segment(4 + i), expected_merged[i]) << i;
}

TEST(MazeWalls, AreComparedWithoutBeingMade) {
  const MazeCells cells = maze(70, 1100, 3, MazeAlgorithm::kruskal);  // more than one chunk
  const WallSet walls = maze_walls(cells, false, {});
  EXPECT_TRUE(has_maze_walls(walls, cells, {}));
  EXPECT_FALSE(has_maze_walls(maze_walls(cells, true, {}), cells, {}));
  EXPECT_FALSE(has_maze_walls(walls, maze(70, 1100, 4, MazeAlgorithm::kruskal), {}));
  walls.visit([&](auto all) {
    if constexpr (std::is_same_v<decltype(all), std::span<const PackedWall>>) {
      for (const std::size_t i : {std::size_t{2}, std::size_t{4}, all.size() / 2, all.size() - 2}) {
        RawVector<PackedWall> other(all.begin(), all.end());
        std::swap(other[i], other[i + 1]);
        EXPECT_FALSE(has_maze_walls(WallSet(std::move(other)), cells, {})) << i;
      }
    }
  });
}

TEST(MazeWalls, CountMatchesTheCourse) {
  EXPECT_EQ(maze_walls(maze(5, 7, 1, MazeAlgorithm::course), false, {}).size(), 28U);
  EXPECT_EQ(maze_walls(maze(41, 41, 1, MazeAlgorithm::course), false, {}).size(), 1604U);
  EXPECT_EQ(maze_walls(maze(45, 45, 1, MazeAlgorithm::course), false, {}).size(), 1940U);
}

/// Unit pieces of all walls behind the four outline segments, each piece once.
std::set<std::tuple<double, double, double, double>> unit_pieces(const WallSet& walls) {
  std::set<std::tuple<double, double, double, double>> pieces;
  for (std::size_t i = 4; i < walls.size(); ++i) {
    const Segment s = walls.segment(i);
    for (double x = s.a.x, y = s.a.y; x < s.b.x || y < s.b.y;) {
      const double x2 = std::min(x + 1, s.b.x);
      const double y2 = std::min(y + 1, s.b.y);
      EXPECT_TRUE(pieces.emplace(x, y, x2, y2).second) << "twice";
      x = x2;
      y = y2;
    }
  }
  return pieces;
}

TEST(MazeWalls, MergedWallsCoverTheSameAndJoinNoFurther) {
  for (const std::uint64_t seed : test::seeds(20, 5, 0)) {
    SCOPED_TRACE(seed);
    const std::uint32_t rows = seed < 3 ? 300 : 40;  // 300 x 270 cells are two chunks
    const MazeCells cells = maze(rows, 270, seed, all_algorithms[seed % 4], seed % 2 == 0 ? 0.0 : 0.3);
    const WallSet units = maze_walls(cells, false, {.threads = 1});
    const WallSet merged = maze_walls(cells, true, {.threads = 3});
    EXPECT_EQ(unit_pieces(units), unit_pieces(merged));
    EXPECT_LT(merged.size(), units.size());
    std::set<std::tuple<bool, double, double>> ends;  // of horizontal or vertical walls: none may begin where one ends
    for (std::size_t i = 4; i < merged.size(); ++i) {
      const Segment s = merged.segment(i);
      EXPECT_TRUE(ends.emplace(s.a.x == s.b.x, s.a.x, s.a.y).second);
      EXPECT_TRUE(ends.emplace(s.a.x == s.b.x, s.b.x, s.b.y).second);
    }
  }
}

TEST(MazeWalls, AreTheSameForAnyThreadCount) {
  const MazeCells cells = maze(700, 500, 5, MazeAlgorithm::backtracker, 0.1);
  const WallSet one = maze_walls(cells, false, {.threads = 1});
  for (const unsigned threads : {2U, 3U, 8U}) {
    const WallSet many = maze_walls(cells, false, {.threads = threads});
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one.segment(i), many.segment(i));
  }
}

TEST(MazeWalls, TurnToDoublesWhereFloatsWouldRound) {
  const auto corridor = [](std::uint32_t cols) {
    MazeCells cells(1, cols);
    std::fill(cells.bytes().begin(), cells.bytes().end(), MazeCells::upper_wall);
    return maze_walls(cells, false, {});
  };
  EXPECT_TRUE(corridor(262142).holds_packed());
  EXPECT_EQ(corridor(262142).segment(1).b.x, 262142.5);
  EXPECT_TRUE(corridor(262143).holds_floats());
  EXPECT_EQ(corridor(262143).segment(1).b.x, 262143.5);
  EXPECT_EQ(maze_wall_bytes(1, 262142), sizeof(PackedWall));
  EXPECT_EQ(maze_wall_bytes(262143, 1), sizeof(FloatWall));
  EXPECT_TRUE(corridor(8388607).holds_floats());
  const WallSet wide = corridor(8388608);
  EXPECT_FALSE(wide.holds_floats());
  EXPECT_EQ(wide.segment(0).b.x, 8388608.5);
}

TEST(MazeScene, CarriesHintStartAndGoal) {
  const Scene scene = maze_scene({5, 7, 3, MazeAlgorithm::prim, 0.0}, false, {});
  EXPECT_EQ(scene.walls.size(), 28U);
  EXPECT_EQ(*scene.maze, (MazeHint{5, 7}));
  EXPECT_EQ(scene.start, (std::vector<double>{0.5, 1.0}));
  EXPECT_EQ(scene.goal, (std::vector<double>{7.5, 5.0}));
}

/// The same walls cut, doubled, turned around and shuffled.
WallSet mangled(const WallSet& walls, std::uint64_t seed) {
  std::vector<Segment> pieces;
  SequentialRng rng(seed);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Segment s = walls.segment(i);
    const double length = std::max(s.b.x - s.a.x, s.b.y - s.a.y);
    const auto cut = static_cast<double>(rng.below(static_cast<std::uint64_t>(length) + 1));
    const Vec2 m = s.a.x == s.b.x ? Vec2{s.a.x, s.a.y + cut} : Vec2{s.a.x + cut, s.a.y};
    pieces.push_back({m, s.a});
    pieces.push_back({m, s.b});
    if (rng.below(3) == 0) pieces.push_back({s.b, s.a});
  }
  for (std::size_t i = pieces.size(); i > 1; --i) std::swap(pieces[i - 1], pieces[rng.below(i)]);
  return WallSet::narrowest(pieces);
}

TEST(CellsOfWalls, ReadBackWhatWasGeneratedInAnyOrderAndCut) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const MazeCells cells = maze(23, 31, seed, all_algorithms[seed % 4], 0.2);
    const WallSet walls = maze_walls(cells, seed % 2 == 0, {});
    EXPECT_EQ(drawing(cells_of_walls(walls, {23, 31}, {})), drawing(cells));
    EXPECT_EQ(drawing(cells_of_walls(mangled(walls, seed), {23, 31}, {})), drawing(cells));
  }
}

TEST(CellsOfWalls, RefuseWallsOffTheGrid) {
  const Segment cases[] = {{{1.5, 0.5}, {1.5, 1.25}}, {{1.0, 0.5}, {1.0, 1.5}},         {{1.5, 0.5}, {2.5, 1.5}},
                           {{5.5, 1.5}, {6.5, 1.5}},  {{-0.5, 1.5}, {0.5, 1.5}},        {{0.5, 1.5}, {0.5, 1e300}},
                           {{0.5, 5.5}, {1.5, 5.5}},  {{0.5, std::nan("")}, {0.5, 1.5}}};
  for (const Segment& s : cases) {
    const std::vector<Segment> segments{{{1.5, 0.5}, {1.5, 1.5}}, s};
    EXPECT_EQ(first_wall_off_grid(WallSet::narrowest(segments), {4, 5}, {}), 1U) << s.a.x << " " << s.a.y;
    EXPECT_THROW(cells_of_walls(WallSet::narrowest(segments), {4, 5}, {}), InputError);
  }
  const std::vector<Segment> point{{{2.5, 2.5}, {2.5, 2.5}}};
  EXPECT_EQ(openings(cells_of_walls(WallSet::narrowest(point), {4, 5}, {})), 31U);
}

TEST(FloodConnects, AgreesWithBreadthFirstSearchOnRandomWalls) {
  int connected = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const auto rows = static_cast<std::uint32_t>(1 + seed % 9);
    const auto cols = static_cast<std::uint32_t>(1 + seed % 14);
    MazeCells cells(rows, cols);
    SequentialRng rng(seed);
    for (std::uint32_t col = 0; col < cols; ++col) {
      for (std::uint32_t row = 0; row < rows; ++row) {
        if (col + 1 < cols && rng.below(100) < 55) cells.open_right(col, row);
        if (row + 1 < rows && rng.below(100) < 55) cells.open_above(col, row);
      }
    }
    for (int pair = 0; pair < 10; ++pair) {
      const mazes::Cell a{static_cast<std::uint32_t>(rng.below(cols)), static_cast<std::uint32_t>(rng.below(rows))};
      const mazes::Cell b{static_cast<std::uint32_t>(rng.below(cols)), static_cast<std::uint32_t>(rng.below(rows))};
      const bool expected = distances_from(cells, a)[std::size_t{b.first} * rows + b.second] >= 0;
      EXPECT_EQ(flood_connects(cells, a, b, {}), expected);
      connected += expected ? 1 : 0;
    }
  }
  EXPECT_GT(connected, 500);
  EXPECT_LT(connected, 1500);
}

TEST(FloodConnects, RefusesCellsOutsideAndStopsAtTheDeadline) {
  const MazeCells cells = maze(400, 400, 1, MazeAlgorithm::backtracker);
  EXPECT_THROW(flood_connects(cells, {0, 400}, {0, 0}, {}), InputError);
  EXPECT_THROW(flood_connects(cells, {0, 0}, {400, 0}, {}), InputError);
  const Deadline over(0.0);
  EXPECT_THROW(flood_connects(cells, {0, 0}, {399, 399}, {.deadline = &over}), Stopped);
  EXPECT_THROW(maze_walls(cells, false, {.deadline = &over}), Stopped);
  EXPECT_THROW(cells_of_walls(maze_walls(cells, false, {}), {400, 400}, {.deadline = &over}), Stopped);
}

}  // namespace
}  // namespace warren
