// SPDX-License-Identifier: BSD-3-Clause
// The oracle is Kruskal's algorithm over all edges of the grid at once, with the weights as docs/algorithms.md says
// them.
#include "scenes/mazes/spanning_maze.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/error.hpp"
#include "tests/scenes/mazes/mazes.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

std::uint64_t weight(std::uint64_t seed, std::uint64_t col, std::uint64_t row, unsigned direction) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;
  const std::uint64_t number = (row << 32) + 2 * col + direction;
  return mixed(mixed(seed + golden) + golden * (number + 1));
}

bool falls(std::uint64_t weight, double loops) {
  return static_cast<double>(mixed(~weight) >> 11) < loops * 9007199254740992.0;
}

std::size_t root(std::vector<std::size_t>& parents, std::size_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

/// Row by row, a character a cell: '0' + 1 where a wall stands on its right, + 2 above; the outline stands.
std::string kruskal(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops = 0.0) {
  std::vector<std::tuple<std::uint64_t, std::size_t, unsigned>> edges;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t col = 0; col < cols; ++col) {
      const std::size_t cell = std::size_t{row} * cols + col;
      if (col + 1 < cols) edges.emplace_back(weight(seed, col, row, 0), cell, 0U);
      if (row + 1 < rows) edges.emplace_back(weight(seed, col, row, 1), cell, 1U);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::size_t> parents(std::size_t{rows} * cols);
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  std::string walls(parents.size(), '3');
  for (const auto& [w, cell, direction] : edges) {
    const std::size_t a = root(parents, cell);
    const std::size_t b = root(parents, cell + (direction == 0 ? 1 : cols));
    if (a == b && !falls(w, loops)) continue;
    parents[b] = a;
    walls[cell] = static_cast<char>(walls[cell] - (1 << direction));
  }
  return walls;
}

/// The same of tiles; each side of a tile's cells must be said alike by the tile that it is shared with.
std::string stitched(const SpanningMaze& maze) {
  std::string walls(std::size_t{maze.rows()} * maze.cols(), '?');
  const auto reader = maze.reader();
  CellTile tile;
  const auto shared = [&](std::ptrdiff_t col, std::ptrdiff_t row, unsigned bit) {
    const std::ptrdiff_t at_col = std::ptrdiff_t{tile.first_col} + col;
    const std::ptrdiff_t at_row = std::ptrdiff_t{tile.first_row} + row;
    const bool stands = (tile.walls[tile.index(col, row)] & bit) != 0;
    if (at_col < 0 || at_row < 0) {
      EXPECT_EQ(stands, at_row != 0 || at_col >= 0) << "the outline opens left of the first cell";
      return;
    }
    EXPECT_EQ(stands, ((walls[static_cast<std::size_t>(at_row * maze.cols() + at_col)] - '0') & bit) != 0);
  };
  for (std::size_t t = 0; t < maze.tile_count(); ++t) {
    reader->read(t, tile);
    for (std::uint32_t row = 0; row < tile.height; ++row) {
      for (std::uint32_t col = 0; col < tile.width; ++col) {
        walls[std::size_t{tile.first_row + row} * maze.cols() + tile.first_col + col] =
            static_cast<char>('0' + tile.walls[tile.index(col, row)]);
      }
    }
    for (std::uint32_t row = 0; row < tile.height; ++row) shared(-1, row, CellTile::right_wall);
    for (std::uint32_t col = 0; col < tile.width; ++col) shared(col, -1, CellTile::upper_wall);
  }
  EXPECT_EQ((walls.back() - '0') & 1, 0) << "the outline opens right of the last cell";
  walls.back() = static_cast<char>(walls.back() + 1);
  return walls;
}

std::string held(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops, unsigned threads) {
  const MazeCells cells = generate_maze({rows, cols, seed, MazeAlgorithm::mst, loops}, {.threads = threads});
  std::string walls;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t col = 0; col < cols; ++col) {
      walls += static_cast<char>('0' + (cells.wall_right(col, row) ? 1 : 0) + (cells.wall_above(col, row) ? 2 : 0));
    }
  }
  return walls;
}

constexpr std::pair<std::uint32_t, std::uint32_t> shapes[] = {{1, 1},   {1, 40},  {40, 1},  {2, 2},   {3, 17},
                                                              {16, 16}, {17, 33}, {64, 64}, {61, 90}, {150, 130}};

TEST(SpanningMaze, TilesOfAnySideAreKruskalsMazeEdgeForEdge) {
  for (const auto& [rows, cols] : shapes) {
    for (const std::uint64_t seed : test::seeds(20, 2, 0)) {
      const std::string expected = kruskal(rows, cols, seed);
      for (const std::uint64_t side_log2 : test::seeds(9, 4, 0)) {
        SCOPED_TRACE(std::to_string(rows) + "x" + std::to_string(cols) + " seed " + std::to_string(seed) + " side 2^" +
                     std::to_string(side_log2));
        ASSERT_EQ(stitched(SpanningMaze(rows, cols, seed, 0.0, {.threads = 2}, side_log2)), expected);
      }
    }
  }
}

TEST(SpanningMaze, LoopsFallByTheirWeights) {
  for (const double loops : {0.01, 0.3, 1.0}) {
    for (const std::uint64_t seed : test::seeds(20, 5, 0)) {
      SCOPED_TRACE(std::to_string(loops) + " seed " + std::to_string(seed));
      const std::string expected = kruskal(50, 70, seed, loops);
      ASSERT_EQ(stitched(SpanningMaze(50, 70, seed, loops, {}, 4)), expected);
      ASSERT_EQ(held(50, 70, seed, loops, 2), expected);
    }
  }
  const std::string open = kruskal(50, 70, 1, 1.0);
  EXPECT_EQ(std::count(open.begin(), open.end(), '0'), 49 * 69) << "every wall between two cells falls";
}

TEST(SpanningMaze, AHeldMazeIsTheSameForAnyThreads) {
  const std::uint32_t rows = test::asks_all() ? 700 : 150;
  const std::string expected = kruskal(rows, 600, 5);
  for (const unsigned threads : {1U, 2U, 3U, 8U}) EXPECT_EQ(held(rows, 600, 5, 0.0, threads), expected);
}

TEST(SpanningMaze, LargeTilesAreKruskalsMazeToo) {
  const std::string expected = kruskal(600, 500, 9);
  for (const std::uint64_t side_log2 : test::seeds(4, 1, 5)) {
    EXPECT_EQ(stitched(SpanningMaze(600, 500, 9, 0.0, {}, side_log2)), expected);
  }
}

TEST(SpanningMaze, RefusesSizesAndLoopsOutOfRange) {
  EXPECT_THROW(SpanningMaze(0, 5, 1, 0.0, {}), InputError);
  EXPECT_THROW(SpanningMaze(5, SpanningMaze::most_side + 1, 1, 0.0, {}), InputError);
  EXPECT_THROW(SpanningMaze(5, 5, 1, 1.5, {}), InputError);
}

TEST(SpanningMaze, StopsAtTheDeadlineAndBeforeTheMemoryIsPassed) {
  const Deadline none_left(nullptr, 0.0);
  EXPECT_THROW(SpanningMaze(3000, 3000, 1, 0.0, {.deadline = &none_left}), Stopped);
}

}  // namespace
}  // namespace warren
