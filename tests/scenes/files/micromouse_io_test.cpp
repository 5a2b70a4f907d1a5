// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/plane_formats_io.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

constexpr const char* small =
    "o---o---o---o\n"
    "|     G |   |\n"
    "o   o---o   o\n"
    "| S         |\n"
    "o---o---o---o\n";

TEST(Micromouse, WallsLieOnTheUnitGridNorthUp) {
  const TemporaryDirectory directory;
  const std::string crlf = [] {
    std::string text = small;
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
    return text;
  }();
  for (const std::string& text : {std::string(small), crlf}) {
    const Scene scene = read_world(directory.write("m.txt", text), {});
    std::vector<Segment> walls;
    for (std::size_t i = 0; i < scene.walls.size(); ++i) walls.push_back(scene.walls.segment(i));
    const std::vector<Segment> expected{{{0.5, 2.5}, {3.5, 2.5}}, {{1.5, 1.5}, {2.5, 1.5}}, {{0.5, 0.5}, {3.5, 0.5}},
                                        {{0.5, 0.5}, {0.5, 2.5}}, {{2.5, 1.5}, {2.5, 2.5}}, {{3.5, 0.5}, {3.5, 2.5}}};
    EXPECT_EQ(walls.size(), expected.size());
    EXPECT_TRUE(std::is_permutation(walls.begin(), walls.end(), expected.begin(), expected.end()));
    EXPECT_EQ(scene.maze, (MazeHint{2, 3}));
    EXPECT_EQ(scene.start, (std::vector<double>{1, 1}));
    EXPECT_EQ(scene.goal, (std::vector<double>{2, 2}));
  }
}

TEST(Micromouse, OfSeveralGoalsTheOneThatTakesTheFewestCellsIsTaken) {
  const TemporaryDirectory directory;
  const auto goal_of = [&](const char* text) { return read_world(directory.write("g.txt", text), {}).goal; };
  EXPECT_EQ(goal_of("o---o---o---o---o\n"
                    "| G   G | S | G |\n"
                    "o   o   o   o   o\n"
                    "|         G | G |\n"
                    "o---o---o---o---o\n"),
            (std::vector<double>{3, 1}))
      << "below the start, though others come first or lie behind one wall";
  EXPECT_EQ(goal_of("o---o---o---o\n"
                    "| G   S   G |\n"
                    "o---o---o---o\n"),
            (std::vector<double>{1, 1}))
      << "of two as near the first in reading order";
  EXPECT_EQ(goal_of("o---o---o---o\n"
                    "| G | S | G |\n"
                    "o---o---o---o\n"),
            (std::vector<double>{1, 1}))
      << "out of reach";
}

TEST(Micromouse, TrailingBlanksMayBeMissing) {
  const TemporaryDirectory directory;
  const Scene scene = read_world(directory.write("m.txt", "o---o---o\n|\no---o   o\n|\no---o---o\n"), {});
  EXPECT_EQ(scene.walls.size(), 4U);  // top, middle, bottom, left; the right side is open
  EXPECT_TRUE(scene.start.empty());
}

TEST(Micromouse, CellsMayHaveLettersAndNumbers) {
  const TemporaryDirectory directory;
  const Scene scene =
      read_world(directory.write("m.txt", "o---o---o\n| S  -1 |\no---o---o\n|+o |12 |\no---o---o\n"), {});
  EXPECT_EQ(scene.start, (std::vector<double>{1, 2}));
}

TEST(Micromouse, RefusesWithFileAndLine) {
  const TemporaryDirectory directory;
  const std::pair<const char*, const char*> cases[] = {
      {"o---o\n|   |\n", "expected 2 H + 1 lines"},
      {"o---o\n|   |\n|   |\n", ":3: expected a row of posts"},
      {"o---o\n|   |\no-- o\n", ":3: expected `---` or three blanks at column 2"},
      {"o---o\nx   |\no---o\n", ":2: expected `|` or a blank at column 1 (found: x)"},
      {"o---o\n|   | |\no---o\n", ":2: expected at most 5 characters"},
      {"o---o---o\n|\t|   |\no---o---o\n", ":2: expected blanks, not a tab, at column 2"},
      {"o---o---o\n| S  |G |\no---o---o\n", ":2: expected no wall within a cell, at column 6 (found: |)"},
      {"o---o---o\n|   |-- |\no---o---o\n", ":2: expected no wall within a cell, at column 6 (found: -)"},
      {"o---o---o\n| S | S |\no---o---o\n", ":2: a second `S`"},
      {"o---o\n|   |\no---x\n", ":3: expected a post `o` at column 5 (found: x)"},
  };
  for (const auto& [text, expected] : cases) {
    SCOPED_TRACE(expected);
    const std::string file = directory.write("bad.txt", text);
    const std::string said = test::refusal<InputError>([&] { read_world(file, {}); });
    EXPECT_EQ(said.find(file), 0U) << said;
    EXPECT_NE(said.find(expected), std::string::npos) << said;
  }
}

/// The cells of `small`, the lower row first; 1 is a wall in the north, east, south, west.
constexpr const char* small_in_numbers =
    "0 0 0 0 1 1\n1 0 1 0 1 0\n2 0 0 1 1 0\n"
    "0 1 1 0 0 1\n1 1 1 1 1 0\n2 1 1 1 0 1\n";

TEST(Micromouse, FilesOfNumbersAreTheMazesThatTheyAre) {
  const TemporaryDirectory directory;
  const Scene drawn = read_world(directory.write("m.txt", small), {});
  std::string crlf = small_in_numbers;
  for (std::size_t at = 0; (at = crlf.find('\n', at)) != std::string::npos; at += 2) crlf.insert(at, "\r");
  const std::string columns =  // one after the other, as some write them
      "0 0 0 0 1 1\n0 1 1 0 0 1\n1 0 1 0 1 0\n1 1 1 1 1 0\n2 0 0 1 1 0\n2 1 1 1 0 1";
  for (const std::string& text : {std::string(small_in_numbers), crlf, columns}) {
    const Scene scene = read_world(directory.write("m.num", text), {});
    EXPECT_EQ(scene_hash(scene), scene_hash(drawn));
    EXPECT_EQ(scene.maze, drawn.maze);
    EXPECT_EQ(scene.start, (std::vector<double>{1, 1}));
    EXPECT_EQ(scene.goal, (std::vector<double>{2, 1})) << "of the middle cells the one that is nearer";
  }
}

TEST(Micromouse, NumbersThatAreNoMazeAreRefusedAsSuch) {
  const TemporaryDirectory directory;
  const std::string good = small_in_numbers;
  const auto with = [&](const char* from, const char* to) {
    std::string text = good;
    return text.replace(text.find(from), std::string(from).size(), to);
  };
  const std::pair<std::string, std::string> cases[] = {
      {with("2 1 1 1 0 1\n", ""), "expected a line X Y N E S W for each of 2 x 3 cells (found: 5 lines)"},
      {with("2 1 1 1 0 1\n", "0 0 0 0 1 1\n"), "the cell 0 0 is there twice"},
      {with("2 0 0 1", "2 0 1 1"), ":6: a neighbour says otherwise of the wall in the west or south"},
      {with("1 1 1 1 1 0", "1 1 1 0 1 0"), ":6: a neighbour says otherwise of the wall in the west or south"},
      {with("2 0 0 1", "2 0 0 2"), ":3: expected X Y N E S W"},
      {with("2 0 0 1 1 0", "2 0 0 1 1"), ":3: expected X Y N E S W"},
      {with("2 0 0 1 1 0", "2 0 0 1 1 0 0"), ":3: expected X Y N E S W and no more"},
      {with("2 0 0 1", "9999999999 0 0 1"), ":3: expected X Y N E S W"},
      {with("2 0 0 1", "2147483646 0 0 1"), "for each of 2 x 2147483647 cells"},
      {"nothing\n", ":1: expected X Y N E S W"}};
  for (const auto& [text, expected] : cases) {
    SCOPED_TRACE(expected);
    const std::string file = directory.write("m.num", text);
    const std::string said = test::refusal<InputError>([&] { read_world(file, {}); });
    EXPECT_NE(said.find(expected), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace warren
