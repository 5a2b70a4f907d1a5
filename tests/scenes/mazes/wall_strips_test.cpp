// SPDX-License-Identifier: BSD-3-Clause
// The oracle holds the maze: maze_walls() of the same cells as floats, byte for byte, however wide the strips are.
#include "scenes/mazes/maze_generator.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/scenes/mazes/mazes.hpp"

namespace warren {
namespace {

std::string held(const MazeCells& cells, bool merged) {
  const WallSet walls = maze_walls(cells, merged, {});
  std::string bytes;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Segment s = walls.segment(i);
    const FloatWall wall{static_cast<float>(s.a.x), static_cast<float>(s.a.y), static_cast<float>(s.b.x),
                         static_cast<float>(s.b.y)};
    bytes.append(reinterpret_cast<const char*>(&wall), sizeof wall);
  }
  return bytes;
}

std::string streamed(const CellWallSource& cells, bool merged, unsigned threads) {
  const Execution execution{.threads = threads};
  const WallStrips strips(cells, merged, execution);
  std::string bytes;
  strips.write([&](std::string_view some) { bytes += some; }, execution);
  EXPECT_EQ(bytes.size(), strips.wall_count() * (strips.holds_floats() ? sizeof(FloatWall) : sizeof(DoubleWall)));
  return bytes;
}

void check(const MazeCells& cells) {
  for (const bool merged : {false, true}) {
    const std::string expected = held(cells, merged);
    for (const unsigned side_log2 : {0U, 1U, 3U, 5U, 8U}) {
      SCOPED_TRACE(side_log2);
      EXPECT_TRUE(streamed(HeldCells(cells, side_log2), merged, 1 + side_log2 % 3) == expected) << merged;
    }
  }
}

TEST(WallStrips, AreTheWallsOfMazesThatAreHeld) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const auto rows = static_cast<std::uint32_t>(1 + seed * 7 % 53);
    const auto cols = static_cast<std::uint32_t>(1 + seed * 13 % 61);
    check(generate_maze({.rows = rows, .cols = cols, .seed = seed, .loops = 0.05 * static_cast<double>(seed % 4)}, {}));
  }
}

TEST(WallStrips, WallsThatGoOnOverManyStripsAreOne) {
  check(MazeCells(9, 300));
  check(MazeCells(300, 9));
  check(MazeCells(1, 40));
  check(MazeCells(40, 1));
  MazeCells cells(5, 100);
  for (const std::uint32_t col : {0U, 7U, 8U, 63U, 64U, 99U}) cells.open_above(col, col % 4);
  check(cells);
}

TEST(WallStrips, FarFromTheOriginTheyAreDoubles) {
  const HeldCells cells(generate_maze({.rows = 1, .cols = 1U << 23U, .algorithm = MazeAlgorithm::mst}, {}), 8);
  const WallStrips strips(cells, true, {.threads = 1});
  EXPECT_FALSE(strips.holds_floats());
  EXPECT_EQ(strips.wall_count(), 4);
}

TEST(WallStrips, TheLimitOfMemoryIsKeptBeforeItIsPassed) {
  const HeldCells cells(MazeCells(300, 300), 4);
  const Deadline tight(1e9, 1);
  EXPECT_THROW(WallStrips(cells, true, {.threads = 1, .deadline = &tight}), Stopped);
}

}  // namespace
}  // namespace warren
