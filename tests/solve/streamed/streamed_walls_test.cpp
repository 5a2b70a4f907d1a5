// SPDX-License-Identifier: BSD-3-Clause
#include "solve/streamed/solve_streamed.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/base/error.hpp"
#include "scenes/files/maze_file_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

constexpr std::uint32_t rows = 800;
constexpr std::uint32_t cols = 523;

Scene unmade(const std::string& path) { return unmade_maze(InputFile(path, {})).value(); }

/// Of these rows of tiles: but for the corner, and the sides that are not the tile's.
void expect_the_same_tiles(const CellWallSource& part, const CellWallSource& whole, Range own) {
  ASSERT_EQ(part.tile_count(), whole.tile_count());
  CellTile found;
  CellTile expected;
  for (std::size_t number = own.first * whole.tile_cols(); number < own.last * whole.tile_cols(); ++number) {
    part.reader()->read(number, found);
    whole.reader()->read(number, expected);
    for (std::ptrdiff_t row = -1; row < std::ptrdiff_t{expected.height}; ++row) {
      for (std::ptrdiff_t col = -1; col < std::ptrdiff_t{expected.width}; ++col) {
        const unsigned shared = (row >= 0 ? CellTile::right_wall : 0U) | (col >= 0 ? CellTile::upper_wall : 0U);
        ASSERT_EQ(found.walls[found.index(col, row)] & shared, expected.walls[expected.index(col, row)] & shared)
            << "tile " << number << " cell " << col << " " << row;
      }
    }
  }
}

TEST(StreamedWalls, OfSomeRowsOfTilesAreThoseOfAll) {
  const TemporaryDirectory directory;
  const MazeOptions maze{rows, cols, 3, MazeAlgorithm::kruskal, 0.2};
  for (const char* name : {"a.maze", "units.npy", "merged.npy"}) {
    write_scene(maze_scene(maze, name[0] == 'm', {}), directory.file(name));
    const Scene scene = unmade(directory.file(name));
    const auto whole = streamed_walls(scene, {.threads = 1});
    for (const Range own : {Range{0, 1}, {0, 4}, {1, 2}, {1, 3}, {2, 4}, {3, 4}}) {
      SCOPED_TRACE(std::string(name) + " from " + std::to_string(own.first) + " to " + std::to_string(own.last));
      const auto part = streamed_walls(scene, own, {.threads = 2});
      expect_the_same_tiles(part->planned(), whole->planned(), own);
      expect_the_same_tiles(part->judged(), whole->planned(), own);
      EXPECT_EQ(part->hash(), whole->hash());
      EXPECT_EQ(part->wall_count(), whole->wall_count());
    }
  }
}

TEST(StreamedWalls, OfAMazeFileNoRowsButThoseAndTheTilesBelowAreLookedAt) {
  const TemporaryDirectory directory;
  write_scene(maze_scene({rows, cols, 3, MazeAlgorithm::kruskal, 0.2}, false, {}), directory.file("a.maze"));
  std::string bytes = directory.read("a.maze");
  char& byte = bytes[64 + 300 * ((cols + 3) / 4)];  // in the second row of tiles
  byte = static_cast<char>(byte ^ 1);
  const Scene scene = unmade(directory.write("b.maze", bytes));
  for (const Range own : {Range{0, 1}, {3, 4}}) EXPECT_NO_THROW(streamed_walls(scene, own, {}));
  for (const Range own : {Range{0, 2}, {1, 2}, {1, 4}, {2, 3}, {2, 4}}) {
    EXPECT_THROW(streamed_walls(scene, own, {}), InputError);
  }
  EXPECT_THROW(streamed_walls(scene, {}), InputError);
}

}  // namespace
}  // namespace warren
