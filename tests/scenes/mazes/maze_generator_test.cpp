// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/maze_generator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "tests/memory_limit.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/mazes/mazes.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using mazes::all_algorithms;
using mazes::distances_from;
using mazes::drawing;
using mazes::maze;
using mazes::openings;

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
        ASSERT_EQ(maze_walls(cells, false, {}).size(), 4 + (rows - 1) * (cols - 1));
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
  constexpr std::uint64_t expected[] = {3614975158479845027U,  13133869192796919984U, 16610607138873445930U,
                                        17079016545190615992U, 3932689423106552720U,  5564428437584211932U};
  for (std::size_t k = 0; k < std::size(expected); ++k) {
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
  for (const std::uint64_t i : test::seeds(std::size(cases), 1, 0)) {
    const PathStatistics& c = cases[i];
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
  const std::string said = test::refusal<InputError>([] { maze_algorithm_named("growing-tree"); });
  EXPECT_NE(said.find("backtracker, kruskal, prim, wilson, course"), std::string::npos);
  EXPECT_NE(said.find("growing-tree"), std::string::npos);
  for (const MazeAlgorithm algorithm : all_algorithms) EXPECT_EQ(maze_algorithm_named(name_of(algorithm)), algorithm);
}

TEST(MazeGenerator, StopsAtTheDeadlineAndAsksForMemoryFirst) {
  const Deadline over(0.0);
  const Deadline small = test::limit_from_here(std::size_t{64} << 20);
  for (const MazeAlgorithm algorithm : all_algorithms) {
    EXPECT_THROW(generate_maze({2000, 2000, 1, algorithm, 0.0}, {.deadline = &over}), Stopped);
    EXPECT_THROW(generate_maze({65535, 65535, 1, algorithm, 0.0}, {.deadline = &small}), Stopped);
  }
  EXPECT_THROW(maze_scene({3000, 3000}, false, {.deadline = &small}), Stopped);
}

}  // namespace
}  // namespace warren
