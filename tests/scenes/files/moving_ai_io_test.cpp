// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/plane_formats_io.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/base/error.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

std::string with_crlf(std::string text) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  return text;
}

constexpr const char* small_map = "type octile\nheight 3\nwidth 4\nmap\n.GS@\nOTW.\n....\n";

TEST(MovingAiMap, ReadsTerrainTopRowFirst) {
  const TemporaryDirectory directory;
  for (const std::string& text : {std::string(small_map), with_crlf(small_map), std::string(small_map).substr(0, 52)}) {
    const OccupancyMap map = read_moving_ai_map(InputFile(directory.write("a.map", text), {}), {});
    ASSERT_EQ(map.width(), 4U);
    ASSERT_EQ(map.height(), 3U);
    const char* rows[] = {"....", "###.", "...#"};  // from the bottom
    for (std::uint32_t y = 0; y < 3; ++y) {
      for (std::uint32_t x = 0; x < 4; ++x) EXPECT_EQ(map.blocked.test(x, y), rows[y][x] == '#') << x << " " << y;
    }
    EXPECT_TRUE(map.water.test(2, 1));
    EXPECT_EQ(map.water.count(), 1U);
    EXPECT_EQ(map.free, 8U);
    EXPECT_EQ(map.occupied, 4U);
  }
}

TEST(MovingAiMap, TakesBlanksAroundAndATinyMap) {
  const TemporaryDirectory directory;
  const std::string texts[] = {
      "type octile\nheight 2\nwidth 3\nmap\n.@.  \n...\t\n",
      "type   octile  \n height\t2 \nwidth 3\t\nmap \n.@. \n...",
      with_crlf("type octile\nheight 2\nwidth 3\nmap\n.@. \n...\n\n \n"),
  };
  for (const std::string& text : texts) {
    SCOPED_TRACE(text);
    const OccupancyMap map = read_moving_ai_map(InputFile(directory.write("a.map", text), {}), {});
    EXPECT_EQ(map.width(), 3U);
    EXPECT_EQ(map.free, 5U);
    EXPECT_TRUE(map.blocked.test(1, 1));
  }
  const OccupancyMap one =
      read_moving_ai_map(InputFile(directory.write("b.map", "type octile\nheight 1\nwidth 1\nmap\n."), {}), {});
  EXPECT_EQ(one.free, 1U);
}

TEST(MovingAiMap, AByteOrderMarkMayStandBeforeAndANoteBehindABlankLine) {
  const TemporaryDirectory directory;
  const std::string marked = "\xef\xbb\xbftype octile\nheight 1\nwidth 1\nmap\n.\n";
  EXPECT_EQ(read_moving_ai_map(InputFile(directory.write("a.map", marked), {}), {}).free, 1U);
  for (const char* note : {"\n/////\n  title={Benchmarks},\n}\n", "\r\n\r\ncite me\r\n", "\n\n"}) {
    const std::string text = std::string("type octile\nheight 2\nwidth 2\nmap\n..\n.@\n") + note;
    EXPECT_EQ(read_moving_ai_map(InputFile(directory.write("a.map", text), {}), {}).free, 3U);
  }
}

TEST(MovingAiMap, WaterIsPassableFromWaterOnly) {
  const TemporaryDirectory directory;
  const OccupancyMap map =
      read_moving_ai_map(InputFile(directory.write("a.map", "type octile\nheight 1\nwidth 4\nmap\n.WW.\n"), {}), {});
  const Bitmap from_land = blocked_from(map, {0, 0});
  const Bitmap from_water = blocked_from(map, {1, 0});
  for (std::uint32_t x = 0; x < 4; ++x) {
    EXPECT_EQ(from_land.test(x, 0), x == 1 || x == 2);
    EXPECT_EQ(from_water.test(x, 0), x == 0 || x == 3);
  }
}

TEST(MovingAiMap, RefusesWithFileAndLine) {
  const TemporaryDirectory directory;
  const std::pair<const char*, const char*> cases[] = {
      {"type tile\nheight 1\nwidth 1\nmap\n.\n", ":1: expected `type octile` (found: tile)"},
      {"type octile\nwidth 1\nheight 1\nmap\n.\n", ":2: expected `height N`, N from 1 to 2147483647 (found: width)"},
      {"type octile\nheight 0\nwidth 1\nmap\n", ":2: expected `height N`, N from 1 to 2147483647 (found: 0)"},
      {"type octile\nheight 1\nwidth x\nmap\n", ":3: expected `width N`, N from 1 to 2147483647 (found: x)"},
      {"type octile\nheight 1\nwidth 99999\n.\n", ":4: expected `map`"},
      {"type octile\nheight 1\n", ":2: expected `width N`"},
      {"type octile\nheight 100000\nwidth 100000\nmap\n", "a map has 1 to 2^32 - 1 cells"},
      {"type octile\nheight 10000\nwidth 10000\nmap\n..\n", "expected 10000 rows of 10000 cells"},
      {"type octile\nheight 2\nwidth 2\nmap\n..\n", "expected 2 rows after `map` (found: 1)"},
      {"type octile\nheight 2\nwidth 2\nmap\n..\n.\n", ":6: expected a row of 2 cells (found: 1 characters)"},
      {"type octile\nheight 2\nwidth 2\nmap\n..\n...\n", ":6: expected a row of 2 cells (found: 3 characters)"},
      {"type octile\nheight 2\nwidth 2\nmap\n..\n.x\n", ":6: expected one of . G S W @ O T at column 2 (found: x)"},
      {"type octile\nheight 2\nwidth 2\nmap\n..\n..\n\n..\n", ":8: expected nothing after 2 rows"},
      {"type octile\nheight 2\nwidth 2\nmap\n..\n..\nnote\n", ":7: expected nothing after 2 rows"},
  };
  for (const auto& [text, expected] : cases) {
    SCOPED_TRACE(expected);
    const std::string file = directory.write("bad.map", text);
    const std::string said = test::refusal<InputError>([&] { read_moving_ai_map(InputFile(file, {}), {}); });
    EXPECT_EQ(said.find(file), 0U) << said;
    EXPECT_NE(said.find(expected), std::string::npos) << said;
  }
}

TEST(Scenarios, ReadsBothVersionsAndLineEnds) {
  const TemporaryDirectory directory;
  const std::string one = "version 1\n3\tmaps/a b.map\t4\t3\t0\t1\t2\t2\t12.5\n0\ta.map\t4\t3\t0\t0\t0\t0\t0\n";
  for (const std::string& text : {one, with_crlf(one), "version 1.0" + one.substr(9)}) {
    const auto scenarios = read_scenarios(InputFile(directory.write("a.scen", text), {}), {});
    ASSERT_EQ(scenarios.size(), 2U);
    EXPECT_EQ(scenarios[0].bucket, 3U);
    EXPECT_EQ(scenarios[0].map, "maps/a b.map");
    EXPECT_EQ(scenarios[0].map_width, 4U);
    EXPECT_EQ(scenarios[0].map_height, 3U);
    EXPECT_EQ(scenarios[0].start, (Cell{0, 1}));
    EXPECT_EQ(scenarios[0].goal, (Cell{2, 2}));
    EXPECT_EQ(scenarios[0].length, 12.5);
    EXPECT_EQ(scenarios[1].line, 3U);
  }
  const auto old = read_scenarios(InputFile(directory.write("b.scen", "3 a.map 0 1 2 2 12.5\n"), {}), {});
  ASSERT_EQ(old.size(), 1U);
  EXPECT_EQ(old[0].map_width, 0U);
  EXPECT_EQ(old[0].length, 12.5);
}

TEST(Scenarios, TellHowFarTheirOptimaAreRounded) {
  const TemporaryDirectory directory;
  const auto half_unit = [&](const std::string& length) {
    const std::string file = directory.write("c.scen", "version 1\n3\ta.map\t4\t3\t0\t1\t2\t2\t" + length + "\n");
    return read_scenarios(InputFile(file, {}), {})[0].half_unit;
  };
  EXPECT_DOUBLE_EQ(half_unit("1008.81"), 0.005);
  EXPECT_DOUBLE_EQ(half_unit("1105.1"), 0.05);
  EXPECT_DOUBLE_EQ(half_unit("34.071067"), 5e-7);
  EXPECT_DOUBLE_EQ(half_unit("12"), 5e-5) << "six digits, of which zeros were left out";
  EXPECT_DOUBLE_EQ(half_unit("123456"), 0.5);
  EXPECT_DOUBLE_EQ(half_unit("1.23e+06"), 5e3);
  EXPECT_LT(half_unit("0"), 1e-5);
}

TEST(Scenarios, CellsCountFromTheTopAndScaleToTheMap) {
  const TemporaryDirectory directory;
  const OccupancyMap map = read_moving_ai_map(InputFile(directory.write("a.map", small_map), {}), {});
  Scenario scenario;
  EXPECT_EQ(cell_of(map, scenario, {3, 0}, "a.scen"), (Cell{3, 2}));
  EXPECT_EQ(cell_of(map, scenario, {3, 2}, "a.scen"), (Cell{3, 0}));
  scenario.map_width = 8;
  scenario.map_height = 6;
  EXPECT_EQ(cell_of(map, scenario, {7, 5}, "a.scen"), (Cell{3, 0}));
  EXPECT_EQ(cell_of(map, scenario, {1, 1}, "a.scen"), (Cell{0, 2}));
  scenario.line = 9;
  EXPECT_THROW(cell_of(map, scenario, {8, 0}, "a.scen"), InputError);
}

TEST(Scenarios, RefusesWithFileAndLine) {
  const TemporaryDirectory directory;
  const std::pair<const char*, const char*> cases[] = {
      {"", "expected scenarios"},
      {"version 1\n", "expected scenarios"},
      {"version 2\n", ":1: expected `version 1` or `version 0` (found: version 2)"},
      {"version 1\n0\ta.map\t4\t3\t0\t0\t0\t0\n", ":2: expected bucket, map, its width and height"},
      {"0\ta.map\t4\t3\t0\t0\t0\t0\t0\n", ":1: expected bucket, map, start x y, goal x y, optimal length (version 0)"},
      {"version 1\nx\ta.map\t4\t3\t0\t0\t0\t0\t0\n", ":2: expected the bucket, a whole number"},
      {"version 1\n0\ta.map\t4\t3\t0\t-1\t0\t0\t0\n", ":2: expected a coordinate, a whole number that is not negative"},
      {"version 1\n0\ta.map\t4\t3\t0\t1\t0\t0\tnan\n", ":2: expected the optimal length, not negative"},
  };
  for (const auto& [text, expected] : cases) {
    SCOPED_TRACE(expected);
    const std::string file = directory.write("bad.scen", text);
    const std::string said = test::refusal<InputError>([&] { read_scenarios(InputFile(file, {}), {}); });
    EXPECT_NE(said.find(expected), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace warren
