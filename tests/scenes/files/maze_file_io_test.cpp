// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/maze_file_io.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/mazes/spanning_maze.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

std::string written(const TemporaryDirectory& directory, const MazeOptions& maze) {
  write_maze_file(HeldCells(generate_maze(maze, {}), CellBits::usual_side_log2), directory.file("a.maze"), {});
  return directory.read("a.maze");
}

Scene read_bytes(std::string_view bytes) { return read_maze_file(InputFile::of_bytes("a.maze", bytes), {}); }

std::string said_of(std::string_view bytes) {
  return test::refusal<InputError>([&] { read_bytes(bytes); });
}

std::uint32_t crc32(std::string_view bytes) {
  return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// With the header's checksum as it should be.
std::string with_number(std::string bytes, std::size_t at, std::uint64_t number, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes[at + i] = static_cast<char>(number >> 8 * i & 0xffU);
  const std::uint32_t sum = crc32(std::string_view(bytes).substr(0, 60));
  for (std::size_t i = 0; i < 4; ++i) bytes[60 + i] = static_cast<char>(sum >> 8 * i & 0xffU);
  return bytes;
}

TEST(MazeFile, HoldsTheMazesOfTheGenerators) {
  const TemporaryDirectory directory;
  for (const auto& [rows, cols] : {std::pair{1U, 1U}, {1U, 700U}, {300U, 1U}, {5U, 7U}, {255U, 257U}, {513U, 258U}}) {
    for (const double loops : {0.0, 0.3, 1.0}) {
      SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(cols) + " loops " + std::to_string(loops));
      const MazeOptions maze{rows, cols, 3, MazeAlgorithm::kruskal, loops};
      const Scene made = maze_scene(maze, false, {});
      const Scene found = read_bytes(written(directory, maze));
      EXPECT_EQ(found.maze, made.maze);
      EXPECT_EQ(found.start, made.start);
      EXPECT_EQ(found.goal, made.goal);
      EXPECT_EQ(scene_hash(found), scene_hash(made));
    }
  }
}

TEST(MazeFile, TheSameBytesFromCellsWallsAndTiles) {
  const TemporaryDirectory directory;
  const MazeOptions maze{300, 520, 5, MazeAlgorithm::mst, 0.1};
  const std::string bytes = written(directory, maze);
  EXPECT_EQ(bytes.size(), 64U + 300 * 130 + 2 * 4);
  for (const bool merged : {false, true}) {
    write_scene(maze_scene(maze, merged, {}), directory.file("b.maze"));
    EXPECT_EQ(directory.read("b.maze"), bytes);
  }
  write_maze_file(SpanningMaze(maze.rows, maze.cols, maze.seed, maze.loops, {}), directory.file("b.maze"),
                  {.threads = 3});
  EXPECT_EQ(directory.read("b.maze"), bytes);
}

TEST(MazeFile, GivesTheTilesOfTheMaze) {
  const TemporaryDirectory directory;
  const MazeOptions maze{600, 523, 2, MazeAlgorithm::wilson, 0.05};
  written(directory, maze);
  const InputFile file(directory.file("a.maze"), {});
  const MazeFile packed(file);
  packed.check({});
  const HeldCells held(generate_maze(maze, {}), CellBits::usual_side_log2);
  ASSERT_EQ(packed.tile_count(), held.tile_count());
  CellTile found;
  CellTile expected;
  for (std::size_t number = 0; number < held.tile_count(); ++number) {
    packed.reader()->read(number, found);
    held.reader()->read(number, expected);
    for (std::ptrdiff_t row = -1; row < std::ptrdiff_t{expected.height}; ++row) {
      for (std::ptrdiff_t col = -1; col < std::ptrdiff_t{expected.width}; ++col) {
        const unsigned shared = (row >= 0 ? 1U : 0U) | (col >= 0 ? 2U : 0U);  // the sides that the tile's cells have
        ASSERT_EQ(found.walls[found.index(col, row)] & shared, expected.walls[expected.index(col, row)] & shared)
            << "tile " << number << " cell " << col << " " << row;
      }
    }
  }
}

TEST(MazeFile, EveryBitThatIsTurnedIsNoticed) {
  const TemporaryDirectory directory;
  const std::string bytes = written(directory, {9, 10, 1});
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string turned = bytes;
    turned[bit / 8] = static_cast<char>(turned[bit / 8] ^ (1 << bit % 8));
    EXPECT_NE(said_of(turned), "") << "bit " << bit;
  }
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_NE(said_of(bytes.substr(0, size)), "") << size;
  EXPECT_NE(said_of(bytes + "x").find("expected"), std::string::npos);
}

TEST(MazeFile, RefusesSizesThatNoFileHas) {
  const TemporaryDirectory directory;
  const std::string bytes = written(directory, {9, 10, 1});
  for (const std::size_t at : {std::size_t{16}, std::size_t{24}}) {
    EXPECT_NE(said_of(with_number(bytes, at, 0, 8)).find("rows and columns must be from 1"), std::string::npos);
    for (const std::uint64_t side : {~std::uint64_t{0}, std::uint64_t{1} << 63, std::uint64_t{1} << 32}) {
      EXPECT_NE(said_of(with_number(bytes, at, side, 8)).find("rows and columns must be from 1"), std::string::npos);
    }
    EXPECT_NE(said_of(with_number(bytes, at, (1U << 27U) - 1, 8)).find("contradicts itself"), std::string::npos);
  }
  EXPECT_NE(said_of(with_number(bytes, 8, 2, 4)).find("version 1"), std::string::npos);
  EXPECT_NE(said_of(with_number(bytes, 12, 255, 4)).find("contradicts itself"), std::string::npos);
  EXPECT_NE(said_of(with_number(bytes, 40, 1, 8)).find("contradicts itself"), std::string::npos);
}

TEST(MazeFile, RefusesAnOutlineWithAnotherDoor) {
  const TemporaryDirectory directory;
  std::string bytes = written(directory, {3, 5, 1});
  bytes[64 + 1] = static_cast<char>(bytes[64 + 1] & ~1);  // right of the first row's last cell
  const std::uint32_t sum = crc32(std::string_view(bytes).substr(64, 3 * 2));
  for (std::size_t i = 0; i < 4; ++i) bytes[64 + 6 + i] = static_cast<char>(sum >> 8 * i & 0xffU);
  EXPECT_NE(said_of(bytes).find("a.maze: rows 0 to 2"), std::string::npos) << said_of(bytes);
  EXPECT_NE(said_of(bytes).find("do not close the maze's outline"), std::string::npos);
}

TEST(MazeFile, RefusesWorldsThatItCantHold) {
  const TemporaryDirectory directory;
  const std::string file = directory.file("a.maze");
  Scene scene = maze_scene({5, 5, 1}, false, {});
  Scene bounded = scene;
  bounded.bounds = Box{{0, 0}, {9, 9}};
  Scene open = scene;
  open.walls = WallSet(RawVector<FloatWall>{{0.5F, 0.5F, 5.5F, 0.5F}});
  for (const Scene& refused : {bounded, open, Scene{}}) {
    EXPECT_THROW(write_maze_file(refused, file, {}), InputError);
    EXPECT_EQ(directory.entries(), 0U);
  }
}

}  // namespace
}  // namespace warren
