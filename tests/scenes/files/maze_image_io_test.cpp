// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/image_io.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/base/error.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/scenes/files/test_images.hpp"

namespace warren {
namespace {

constexpr const char* rows[] = {"#.###", "#...#", "###.#", "#...#", "###.#"};  // from the top
bool is_wall(unsigned x, unsigned y) { return rows[y][x] == '#'; }

void expect_maze(const OccupancyMap& map) {
  ASSERT_EQ(map.width(), 5U);
  ASSERT_EQ(map.height(), 5U);
  for (unsigned y = 0; y < 5; ++y) {
    for (unsigned x = 0; x < 5; ++x) EXPECT_EQ(map.blocked.test(x, 4 - y), is_wall(x, y)) << x << " " << y;
  }
  EXPECT_EQ(map.free, 9U);
  EXPECT_EQ(map.occupied, 16U);
  EXPECT_EQ(map.start, (Vec2{1.5, 4.5}));
  EXPECT_EQ(map.goal, (Vec2{3.5, 0.5}));
}

TEST(MazeImage, EveryKindOfImageGivesTheSameMaze) {
  const TemporaryDirectory directory;
  const auto read = [&](const std::string& bytes) {
    return read_maze_image(InputFile(directory.write("m", bytes), {}), {});
  };
  for (const int depth : {1, 2, 4, 8, 16}) {
    const unsigned white = (1U << depth) - 1;
    for (const bool interlaced : {false, true}) {
      SCOPED_TRACE(depth);
      expect_maze(read(png_bytes({PNG_COLOR_TYPE_GRAY, depth, interlaced}, 5, 5,
                                 [&](unsigned x, unsigned y, unsigned) { return is_wall(x, y) ? 0U : white; })));
    }
  }
  expect_maze(read(png_bytes({PNG_COLOR_TYPE_RGB}, 5, 5, [](unsigned x, unsigned y, unsigned channel) {
    return is_wall(x, y) ? (channel == 1 ? 255U : 60U) : (channel == 2 ? 0U : 200U);  // means 125 and 133
  })));
  expect_maze(read(png_bytes({PNG_COLOR_TYPE_RGB_ALPHA}, 5, 5, [](unsigned x, unsigned y, unsigned channel) {
    return channel == 3 && is_wall(x, y) ? 255U : 0U;  // black walls on nothing
  })));
  std::string ascii = "P2\n5 5\n100\n";
  for (unsigned i = 0; i < 25; ++i) ascii += is_wall(i % 5, i / 5) ? "50 " : "51 ";  // 127.5 and 130 of 255
  expect_maze(read(ascii));
}

TEST(MazeImage, OpeningsAreFoundOnlyWhereThereIsExactlyOne) {
  const TemporaryDirectory directory;
  const auto read = [&](const char* text) { return read_maze_image(InputFile(directory.write("m", text), {}), {}); };
  const OccupancyMap two = read("P2 3 2 1\n1 0 1\n0 0 1\n");
  EXPECT_FALSE(two.start);
  EXPECT_EQ(two.goal, (Vec2{2.5, 0.5}));
  const OccupancyMap none = read("P2 3 2 1\n0 0 0\n0 0 0\n");
  EXPECT_FALSE(none.start);
  EXPECT_FALSE(none.goal);
}

TEST(MazeImage, WideImagesFillWholeWords) {
  const TemporaryDirectory directory;
  for (const unsigned width : {63U, 64U, 65U, 200U}) {
    const auto wall = [](unsigned x, unsigned y) { return (x * 7 + y * 13) % 5 < 2; };
    const OccupancyMap map = read_maze_image(
        InputFile(
            directory.write("m", png_bytes({}, width, 3,
                                           [&](unsigned x, unsigned y, unsigned) { return wall(x, y) ? 127U : 128U; })),
            {}),
        {});
    std::uint64_t walls = 0;
    for (unsigned y = 0; y < 3; ++y) {
      for (unsigned x = 0; x < width; ++x) {
        EXPECT_EQ(map.blocked.test(x, 2 - y), wall(x, y)) << x;
        walls += wall(x, y) ? 1 : 0;
      }
    }
    EXPECT_EQ(map.occupied, walls);
  }
}

}  // namespace
}  // namespace warren
