// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/cell_bits.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "scenes/mazes/maze_generator.hpp"

namespace warren {
namespace {

TEST(HashOfCells, IsThatOfTheWallsWhateverTilesAndThreads) {
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes{{1, 1},   {1, 90},   {90, 1},   {2, 3},
                                                                   {64, 65}, {63, 200}, {700, 513}};
  for (const auto& [rows, cols] : sizes) {
    for (const double loops : {0.0, 0.4}) {
      const MazeOptions maze{rows, cols, 5, MazeAlgorithm::kruskal, loops};
      const Scene scene = maze_scene(maze, false, {});
      for (const unsigned side_log2 : {4U, 6U, 8U}) {
        SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(cols) + " by 2^" + std::to_string(side_log2));
        const HeldCells cells(generate_maze(maze, {}), side_log2);
        for (const unsigned threads : {1U, 2U, 3U}) {
          const HashedCells found = hash_of_cells(cells, {.threads = threads});
          EXPECT_EQ(found.hash, scene_hash(scene));
          EXPECT_EQ(found.walls, scene.walls.size());
        }
      }
    }
  }
}

TEST(HashOfCells, WallsGoOnFromPieceToPiece) {
  using Size = std::pair<std::uint32_t, std::uint32_t>;  // pieces of a strip; strips, and walls that are floats
  for (const auto& [rows, cols] : {Size{20000, 130}, Size{5, 270000}}) {
    MazeCells maze(rows, cols);
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
      maze.open_above(row * 11 % cols, row);
      maze.open_right(row * 7 % (cols - 1), row);
    }
    Scene scene;
    scene.walls = maze_walls(maze, false, {});
    const HashedCells found = hash_of_cells(HeldCells(maze, 6), {});
    EXPECT_EQ(found.hash, scene_hash(scene)) << rows;
    EXPECT_EQ(found.walls, scene.walls.size());
  }
}

}  // namespace
}  // namespace warren
