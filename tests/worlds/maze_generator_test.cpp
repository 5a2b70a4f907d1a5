// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/maze_generator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "core/error.hpp"
#include "core/rng.hpp"

namespace warren {
namespace {

using Cell = std::pair<std::uint32_t, std::uint32_t>;
constexpr MazeAlgorithm all_algorithms[] = {MazeAlgorithm::backtracker, MazeAlgorithm::kruskal, MazeAlgorithm::prim,
                                            MazeAlgorithm::wilson, MazeAlgorithm::course};

/// Distances in steps from a cell by a plain breadth-first search; -1: not reached.
std::vector<int> distances_from(const MazeCells& cells, Cell from) {
  std::vector<int> steps(cells.cell_count(), -1);
  const auto id = [&](Cell c) { return std::size_t{c.first} * cells.rows() + c.second; };
  std::queue<Cell> queue;
  steps[id(from)] = 0;
  queue.push(from);
  while (!queue.empty()) {
    const auto [col, row] = queue.front();
    queue.pop();
    std::vector<Cell> next;
    if (col + 1 < cells.cols() && !cells.wall_right(col, row)) next.emplace_back(col + 1, row);
    if (col > 0 && !cells.wall_right(col - 1, row)) next.emplace_back(col - 1, row);
    if (row + 1 < cells.rows() && !cells.wall_above(col, row)) next.emplace_back(col, row + 1);
    if (row > 0 && !cells.wall_above(col, row - 1)) next.emplace_back(col, row - 1);
    for (const Cell& c : next) {
      if (steps[id(c)] >= 0) continue;
      steps[id(c)] = steps[id({col, row})] + 1;
      queue.push(c);
    }
  }
  return steps;
}

std::uint64_t openings(const MazeCells& cells) {
  std::uint64_t count = 0;
  for (std::uint32_t col = 0; col < cells.cols(); ++col) {
    for (std::uint32_t row = 0; row < cells.rows(); ++row) {
      if (col + 1 < cells.cols() && !cells.wall_right(col, row)) ++count;
      if (row + 1 < cells.rows() && !cells.wall_above(col, row)) ++count;
    }
  }
  return count;
}

std::string drawing(const MazeCells& cells) {
  std::string text;
  for (std::uint32_t col = 0; col < cells.cols(); ++col) {
    for (std::uint32_t row = 0; row < cells.rows(); ++row) {
      text += static_cast<char>('0' + 2 * cells.wall_above(col, row) + cells.wall_right(col, row));
    }
  }
  return text;
}

MazeCells maze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, MazeAlgorithm algorithm,
               double loops = 0.0) {
  return generate_maze({rows, cols, seed, algorithm, loops}, {});
}

bool all_reached(const std::vector<int>& steps) {
  return std::all_of(steps.begin(), steps.end(), [](int s) { return s >= 0; });
}

TEST(MazeGenerator, EveryAlgorithmGivesAPerfectMazeOfAnyShape) {
  constexpr std::pair<std::uint32_t, std::uint32_t> shapes[] = {{1, 1},  {1, 2},  {2, 1}, {1, 300}, {300, 1}, {2, 2},
                                                                {2, 40}, {40, 2}, {5, 7}, {13, 8},  {41, 41}};
  for (const MazeAlgorithm algorithm : all_algorithms) {
    for (const auto& [rows, cols] : shapes) {
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(std::string(name_of(algorithm)) + " " + std::to_string(rows) + "x" + std::to_string(cols) +
                     " seed " + std::to_string(seed));
        const MazeCells cells = maze(rows, cols, seed, algorithm);
        ASSERT_TRUE(all_reached(distances_from(cells, {0, 0})));
        ASSERT_EQ(openings(cells), cells.cell_count() - 1);
        ASSERT_EQ(interior_walls(cells, {}), (rows - 1) * (cols - 1));
      }
    }
  }
}

TEST(MazeGenerator, OutlineAndGapsStandAndScratchIsGone) {
  for (const MazeAlgorithm algorithm : all_algorithms) {
    const MazeCells cells = maze(9, 6, 3, algorithm);
    for (std::uint32_t row = 0; row < 9; ++row) EXPECT_TRUE(cells.wall_right(5, row));
    for (std::uint32_t col = 0; col < 6; ++col) EXPECT_TRUE(cells.wall_above(col, 8));
    for (std::size_t i = 0; i < cells.bytes().size(); ++i) {
      EXPECT_EQ(cells.bytes()[i] & ~MazeCells::all_walls, 0);
      if (i % cells.stride() == 0) {
        EXPECT_EQ(cells.bytes()[i], MazeCells::all_walls);
      }
    }
  }
}

TEST(MazeGenerator, SeedDecidesAndNothingElse) {
  for (const MazeAlgorithm algorithm : all_algorithms) {
    SCOPED_TRACE(std::string(name_of(algorithm)));
    std::set<std::string> drawings;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const MazeOptions options{20, 30, seed, algorithm, 0.25};
      const std::string one = drawing(generate_maze(options, {.threads = 1}));
      EXPECT_EQ(one, drawing(generate_maze(options, {.threads = 3})));
      drawings.insert(one);
    }
    EXPECT_EQ(drawings.size(), 20U);
  }
}

// The bits are part of the interface: results are compared across machines and compilers by seed.
TEST(MazeGenerator, BitsStayTheSameEverywhere) {
  const auto digest = [](const MazeCells& cells) {
    std::uint64_t hash = 1469598103934665603U;
    for (const char c : drawing(cells)) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
    return hash;
  };
  constexpr std::uint64_t expected[] = {3614975158479845027U, 13133869192796919984U, 16610607138873445930U,
                                        17079016545190615992U, 3932689423106552720U};
  for (std::size_t k = 0; k < 5; ++k) {
    SCOPED_TRACE(std::string(name_of(all_algorithms[k])));
    EXPECT_EQ(digest(maze(33, 47, 7, all_algorithms[k], 0.1)), expected[k]);
  }
}

TEST(MazeGenerator, LoopsTakeOutExactlyTheirShare) {
  for (const double loops : {0.0, 0.001, 0.05, 0.5, 1.0}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE(std::to_string(loops) + " seed " + std::to_string(seed));
      const MazeCells cells = maze(17, 23, seed, MazeAlgorithm::kruskal, loops);
      EXPECT_EQ(openings(cells), 17U * 23 - 1 + static_cast<std::uint64_t>(std::lround(loops * 16 * 22)));
    }
  }
}

TEST(MazeGenerator, LoopsOpenEachWallEquallyOften) {
  // One of the walls of a maze falls; over many seeds each place among the standing walls is drawn alike.
  constexpr int trials = 4000;
  std::vector<int> hits((5 - 1) * (6 - 1), 0);
  for (std::uint64_t seed = 0; seed < trials; ++seed) {
    const MazeCells before = maze(5, 6, seed, MazeAlgorithm::backtracker);
    const MazeCells after = maze(5, 6, seed, MazeAlgorithm::backtracker, 1.0 / static_cast<double>(hits.size()));
    std::size_t place = 0;
    for (std::uint32_t col = 0; col < 6; ++col) {
      for (std::uint32_t row = 0; row < 5; ++row) {
        if (col < 5 && before.wall_right(col, row)) hits[place++] += after.wall_right(col, row) ? 0 : 1;
        if (row < 4 && before.wall_above(col, row)) hits[place++] += after.wall_above(col, row) ? 0 : 1;
      }
    }
  }
  EXPECT_EQ(std::accumulate(hits.begin(), hits.end(), 0), trials);
  for (const int hit : hits) EXPECT_NEAR(hit, trials / 20, 5 * std::sqrt(trials / 20.0));
}

TEST(MazeGenerator, WilsonDrawsEverySpanningTreeEquallyOften) {
  // A 2x3 grid graph has 15 spanning trees.
  std::map<std::string, int> counts;
  constexpr int trials = 15'000;
  for (std::uint64_t seed = 0; seed < trials; ++seed) ++counts[drawing(maze(2, 3, seed, MazeAlgorithm::wilson))];
  EXPECT_EQ(counts.size(), 15U);
  for (const auto& [tree, count] : counts) EXPECT_NEAR(count, 1000, 5 * std::sqrt(1000.0)) << tree;
}

struct PathStatistics {
  std::uint32_t rows, cols;
  int seeds;
  double mean, tolerance, least, most;
};

TEST(MazeGenerator, CourseMazesHaveTheCoursesPathLengths) {
  // Published figures: 5x7 mean 12.2 (sd 1.6), 41x41 119 (85 to 173), 45x45 134 (109 to 187).
  constexpr PathStatistics cases[] = {
      {5, 7, 2000, 12.2, 0.2, 11, 24}, {41, 41, 150, 119, 6, 81, 230}, {45, 45, 150, 134, 8, 89, 250}};
  for (const PathStatistics& c : cases) {
    SCOPED_TRACE(std::to_string(c.rows) + "x" + std::to_string(c.cols));
    double sum = 0.0;
    double sum_sq = 0.0;
    for (int seed = 0; seed < c.seeds; ++seed) {
      const MazeCells cells = maze(c.rows, c.cols, static_cast<std::uint64_t>(seed), MazeAlgorithm::course);
      const double path_cells = distances_from(cells, {0, 0}).back() + 1.0;
      EXPECT_GE(path_cells, c.least);
      EXPECT_LE(path_cells, c.most);
      sum += path_cells;
      sum_sq += path_cells * path_cells;
    }
    const double mean = sum / c.seeds;
    EXPECT_NEAR(mean, c.mean, c.tolerance);
    if (c.rows == 5) {
      EXPECT_NEAR(std::sqrt(sum_sq / c.seeds - mean * mean), 1.6, 0.2);
    }
  }
}

TEST(MazeGenerator, RefusesSizesAlgorithmsAndLoopsOutOfRange) {
  constexpr std::uint32_t huge = 65536;
  EXPECT_THROW(maze(0, 5, 1, MazeAlgorithm::prim), InputError);
  EXPECT_THROW(maze(5, 0, 1, MazeAlgorithm::prim), InputError);
  EXPECT_THROW(maze(huge, huge, 1, MazeAlgorithm::prim), InputError);
  for (const double loops : {-0.1, 1.1, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(maze(5, 5, 1, MazeAlgorithm::prim, loops), InputError);
  }
  try {
    maze_algorithm_named("growing-tree");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("backtracker, kruskal, prim, wilson, course"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("growing-tree"), std::string::npos);
  }
  for (const MazeAlgorithm algorithm : all_algorithms) EXPECT_EQ(maze_algorithm_named(name_of(algorithm)), algorithm);
}

TEST(MazeGenerator, StopsAtTheDeadlineAndAsksForMemoryFirst) {
  const Deadline over(0.0);
  const Deadline small(1e9, resident_bytes() + (std::size_t{64} << 20));
  for (const MazeAlgorithm algorithm : all_algorithms) {
    EXPECT_THROW(generate_maze({2000, 2000, 1, algorithm, 0.0}, {.deadline = &over}), Stopped);
    EXPECT_THROW(generate_maze({65535, 65535, 1, algorithm, 0.0}, {.deadline = &small}), Stopped);
  }
  EXPECT_THROW(maze_scene({3000, 3000}, false, {.deadline = &small}), Stopped);
}

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
  EXPECT_TRUE(walls.holds_floats());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(walls.segment(i), expected[i]) << i;

  const WallSet merged = maze_walls(cells, true, {});
  const std::vector<Segment> expected_merged = {
      {{0.5, 1.5}, {1.5, 1.5}}, {{1.5, 1.5}, {1.5, 2.5}}, {{2.5, 0.5}, {2.5, 2.5}}, {{2.5, 1.5}, {3.5, 1.5}}};
  ASSERT_EQ(merged.size(), 4 + expected_merged.size());
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(merged.segment(i), expected[i]) << i;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(merged.segment(4 + i), expected_merged[i]) << i;
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
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
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
    one.visit([&](auto a) {
      const FloatWall* b = many.visit([](auto span) { return reinterpret_cast<const FloatWall*>(span.data()); });
      for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i].segment(), b[i].segment());
    });
  }
}

TEST(MazeWalls, TurnToDoublesWhereFloatsWouldRound) {
  const auto corridor = [](std::uint32_t cols) {
    MazeCells cells(1, cols);
    std::fill(cells.bytes().begin(), cells.bytes().end(), MazeCells::upper_wall);
    return maze_walls(cells, false, {});
  };
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
      const Cell a{static_cast<std::uint32_t>(rng.below(cols)), static_cast<std::uint32_t>(rng.below(rows))};
      const Cell b{static_cast<std::uint32_t>(rng.below(cols)), static_cast<std::uint32_t>(rng.below(rows))};
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
