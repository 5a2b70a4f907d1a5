// SPDX-License-Identifier: BSD-3-Clause
// The oracle is the maze that was written.
#include "verify/streamed/verify_cells.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/base/error.hpp"
#include "scenes/files/maze_file_io.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

TEST(JudgedMazeFile, HasTheWallsOfTheMaze) {
  const TemporaryDirectory directory;
  for (const auto& [rows, cols] : {std::pair{1U, 1U}, {3U, 5U}, {257U, 600U}, {520U, 255U}}) {
    SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(cols));
    const HeldCells held(generate_maze({rows, cols, 4, MazeAlgorithm::prim, 0.2}, {}), CellBits::usual_side_log2);
    write_maze_file(held, directory.file("a.maze"), {});
    const std::string bytes = directory.read("a.maze");
    std::size_t forgotten = 0;
    const JudgedMazeFile judged("a.maze", bytes, [&](std::size_t first, std::size_t last) {
      EXPECT_GE(first, 64U);
      EXPECT_LE(last, bytes.size());
      forgotten += last - first;
    });
    ASSERT_EQ(judged.tile_count(), held.tile_count());
    CellTile found;
    CellTile expected;
    for (std::size_t number = 0; number < held.tile_count(); ++number) {
      judged.reader()->read(number, found);
      held.reader()->read(number, expected);
      EXPECT_EQ(found.walls, expected.walls);
    }
    EXPECT_GE(forgotten, std::size_t{rows} * ((cols + 3) / 4));
  }
}

TEST(JudgedMazeFile, RefusesWhatIsNone) {
  const TemporaryDirectory directory;
  write_maze_file(HeldCells(generate_maze({9, 9, 1}, {}), CellBits::usual_side_log2), directory.file("a.maze"), {});
  const std::string bytes = directory.read("a.maze");
  for (const std::size_t size : {std::size_t{0}, std::size_t{63}, bytes.size() - 1}) {
    EXPECT_THROW(JudgedMazeFile("a.maze", std::string_view(bytes).substr(0, size)), InputError);
  }
  std::string other = bytes;
  other[8] = 2;
  EXPECT_THROW(JudgedMazeFile("a.maze", other), InputError);
}

}  // namespace
}  // namespace warren
