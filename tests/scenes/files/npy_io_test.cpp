// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/npy_io.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/memory_limit.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

/// A .npy file as numpy writes it.
std::string npy(const std::string& dictionary, const std::string& data, char version = 1) {
  std::string text = dictionary;
  const std::size_t front = version == 1 ? 10 : 12;
  while ((front + text.size() + 1) % 64 != 0) text += ' ';
  text += '\n';
  std::string file("\x93NUMPY");
  file += version;
  file += '\0';
  file += static_cast<char>(text.size() % 256);
  file += static_cast<char>(text.size() / 256);
  if (version > 1) file += std::string(2, '\0');
  return file + text + data;
}

template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  std::string bytes(numbers.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

std::string dictionary(const std::string& type, const std::string& shape, const std::string& fortran = "False") {
  return "{'descr': '" + type + "', 'fortran_order': " + fortran + ", 'shape': " + shape + ", }";
}

Scene read_array(const TemporaryDirectory& directory, const std::string& content) {
  return read_npy(InputFile(directory.write("a.npy", content), {}), {});
}

TEST(Npy, ReadsFloatsAndDoublesOfEveryVersion) {
  const TemporaryDirectory directory;
  for (const char version : {'\1', '\2', '\3'}) {
    const Scene f =
        read_array(directory, npy(dictionary("<f4", "(2, 4)"), bytes_of<float>({1, 2, 3, 4, 5, 6, 7, 8.5}), version));
    ASSERT_EQ(f.walls.size(), 2U);
    EXPECT_TRUE(f.walls.holds_floats());
    EXPECT_EQ(f.walls.segment(1), (Segment{{5, 6}, {7, 8.5}}));
    EXPECT_FALSE(f.maze.has_value());
    const Scene d = read_array(directory, npy(dictionary("<f8", "(1, 4)"), bytes_of<double>({1, 2, 3, 0.1}), version));
    EXPECT_FALSE(d.walls.holds_floats());
    EXPECT_EQ(d.walls.segment(0), (Segment{{1, 2}, {3, 0.1}}));
  }
}

TEST(Npy, DoublesThatFloatsHoldAreKeptAsFloats) {
  const TemporaryDirectory directory;
  const std::string two = dictionary("<f8", "(2, 4)");
  EXPECT_FALSE(
      read_array(directory, npy(two, bytes_of<double>({1, 2, 3, 4, 0.5, -0.25, 1e30, 0}))).walls.holds_floats());
  EXPECT_TRUE(
      read_array(directory, npy(two, bytes_of<double>({1, 2, 3, 4, 0.5, -0.25, 0x1p60, 0}))).walls.holds_floats());
  EXPECT_EQ(read_array(directory, npy(two, bytes_of<double>({1, 2, 3, 4, 0.1, 1e-101, 1, 0}))).walls.segment(1).a.y,
            0.0);
}

TEST(Npy, ReadsHeadersInOtherOrderAndQuotes) {
  const TemporaryDirectory directory;
  const std::string data = bytes_of<float>({1, 2, 3, 4});
  EXPECT_EQ(
      read_array(directory, npy("{\"shape\":(1,4),\"fortran_order\":False,\"descr\":\"<f4\"}", data)).walls.size(), 1U);
}

struct BadArray {
  const char* name;
  std::string content;
  const char* expected;
};

TEST(Npy, RefusesBadInputInOneLineThatNamesTheFile) {
  const std::string four = bytes_of<float>({1, 2, 3, 4});
  const std::string good = npy(dictionary("<f4", "(1, 4)"), four);
  const BadArray cases[] = {
      {"empty", "", ": expected a .npy file, which begins with \\x93NUMPY"},
      {"text", "0 0 1 1\n", ": expected a .npy file, which begins with \\x93NUMPY (found: 0 0 1 1"},
      {"magic alone", "\x93NUMPY", ": expected .npy version 1, 2 or 3 (found: version 0)"},
      {"version 9", "\x93NUMPY\x09", ": expected .npy version 1, 2 or 3 (found: version 9)"},
      {"ends before its header", good.substr(0, 9), ": the file ends within its header"},
      {"ends within its header", good.substr(0, 40), ": the file ends within its header"},
      {"ends within its numbers", good.substr(0, good.size() - 1),
       ": expected 16 bytes for each of 1 rows behind the header (found: 15 bytes)"},
      {"no numbers", good.substr(0, good.size() - 16), ": expected 16 bytes for each of 1 rows behind the header"},
      {"more than it says", good + "x", ": expected 16 bytes for each of 1 rows behind the header (found: 17 bytes)"},
      {"another array behind", good + good, ": expected 16 bytes for each of 1 rows behind the header"},
      {"integers", npy(dictionary("<i8", "(1, 4)"), four + four), ": expected numbers of type <f4 or <f8 (found: <i8)"},
      {"big-endian", npy(dictionary(">f4", "(1, 4)"), four), ": expected numbers of type <f4 or <f8 (found: >f4)"},
      {"half floats", npy(dictionary("<f2", "(1, 4)"), four), ": expected numbers of type <f4 or <f8 (found: <f2)"},
      {"objects", npy(dictionary("|O", "(1, 4)"), four), ": expected numbers of type <f4 or <f8 (found: |O)"},
      {"records", npy("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (1, 4), }", four),
       ": expected numbers of type <f4 or <f8 (found: [('x', '<f4')]"},
      {"Fortran order", npy(dictionary("<f4", "(1, 4)", "True"), four), ": expected C order, not Fortran order"},
      {"order is no word", npy(dictionary("<f4", "(1, 4)", "0"), four), ": expected fortran_order False"},
      {"one dimension", npy(dictionary("<f4", "(4,)"), four),
       ": expected shape (n, 4), a wall x1 y1 x2 y2 a row (found: (4,))"},
      {"no dimension", npy(dictionary("<f4", "()"), four),
       ": expected shape (n, 4), a wall x1 y1 x2 y2 a row (found: ())"},
      {"three columns", npy(dictionary("<f4", "(1, 3)"), four),
       ": expected shape (n, 4), a wall x1 y1 x2 y2 a row (found: (1, 3))"},
      {"three dimensions", npy(dictionary("<f4", "(1, 2, 2)"), four), ": expected shape (n, 4)"},
      {"negative shape", npy(dictionary("<f4", "(-1, 4)"), four), ": expected a whole number in the shape"},
      {"shape beyond 64 bits", npy(dictionary("<f4", "(99999999999999999999, 4)"), four), ": expected a whole number"},
      {"shape that overflows", npy(dictionary("<f4", "(1152921504606846977, 4)"), four),
       ": expected 16 bytes for each of"},
      {"no rows", npy(dictionary("<f4", "(0, 4)"), ""), ": the array has no rows; expected at least one wall"},
      {"no dictionary", npy("walls", four), ": expected `{` in the header (found: walls"},
      {"broken dictionary", npy("{'descr': '<f4'", four), ": expected `,` or `}` in the header"},
      {"word without end", npy("{'descr", four), ": expected a quoted word in the header"},
      {"missing shape", npy("{'descr': '<f4', 'fortran_order': False}", four),
       ": the header must have descr, fortran_order and shape"},
      {"unknown entry", npy("{'type': '<f4', }", four), ": unknown entry in the header (found: type)"},
      {"nan", npy(dictionary("<f4", "(2, 4)"), four + bytes_of<float>({1, NAN, 0, 0})),
       ": row 1: numbers must be finite and at most 1e60 in magnitude (found: 1 nan 0 0)"},
      {"infinity", npy(dictionary("<f8", "(1, 4)"), bytes_of<double>({1, 0, -HUGE_VAL, 0})),
       ": row 0: numbers must be finite"},
      {"huge", npy(dictionary("<f8", "(1, 4)"), bytes_of<double>({1, 0, 0, 1e61})),
       ": row 0: numbers must be finite and at most 1e60"},
  };
  const TemporaryDirectory directory;
  for (const BadArray& bad : cases) {
    SCOPED_TRACE(bad.name);
    const std::string said = test::refusal<InputError>([&] { read_array(directory, bad.content); });
    const std::string expected = directory.file("a.npy") + bad.expected;
    EXPECT_EQ(said.substr(0, expected.size()), expected);
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
}

TEST(Npy, TheFirstBadRowIsNamedForAnyThreadCount) {
  const TemporaryDirectory directory;
  std::vector<float> numbers(std::size_t{4} * 200'000, 1.0F);
  numbers[4 * 70'001] = NAN;
  numbers[4 * 190'000 + 3] = HUGE_VALF;
  const InputFile file(directory.write("a.npy", npy(dictionary("<f4", "(200000, 4)"), bytes_of(numbers))), {});
  for (const unsigned threads : {1U, 2U, 8U}) {
    const std::string said = test::refusal<InputError>([&] { read_npy(file, {.threads = threads}); });
    EXPECT_NE(said.find(": row 70001: "), std::string::npos);
  }
}

TEST(Npy, MazesComeBackWithHintStartAndGoal) {
  const TemporaryDirectory directory;
  for (const bool merged : {false, true}) {
    for (const auto& [rows, cols] : {std::pair{1U, 1U}, std::pair{1U, 9U}, std::pair{9U, 1U}, std::pair{250U, 300U}}) {
      const Scene maze = maze_scene({rows, cols, 3}, merged, {});
      write_npy(maze, directory.file("m.npy"), {});
      const Scene back = read_npy(InputFile(directory.file("m.npy"), {}), {.threads = 3});
      ASSERT_TRUE(back.maze.has_value());
      EXPECT_EQ(*back.maze, *maze.maze);
      EXPECT_EQ(back.start, maze.start);
      EXPECT_EQ(back.goal, maze.goal);
      EXPECT_EQ(scene_hash(back), scene_hash(maze));
    }
  }
}

TEST(Npy, MazesAreToldWhateverTheOrderOfTheirWalls) {
  const TemporaryDirectory directory;
  for (const bool merged : {false, true}) {
    const Scene maze = maze_scene({70, 90, 5}, merged, {});
    std::vector<Segment> walls;
    for (std::size_t i = 0; i < maze.walls.size(); ++i) {
      const Segment wall = maze.walls.segment(i);
      walls.push_back(i % 2 == 0 ? wall : Segment{wall.b, wall.a});
    }
    std::reverse(walls.begin(), walls.end());
    std::rotate(walls.begin(), walls.begin() + 1000, walls.end());
    Scene shuffled;
    shuffled.walls = WallSet::narrowest(walls);
    write_npy(shuffled, directory.file("m.npy"), {});
    const Scene back = read_npy(InputFile(directory.file("m.npy"), {}), {});
    ASSERT_TRUE(back.maze.has_value()) << merged;
    EXPECT_EQ(*back.maze, *maze.maze);
    EXPECT_EQ(back.goal, maze.goal);
  }
}

TEST(Npy, WallsOfTheGridWithoutTheTwoDoorsAreNoMaze) {
  const TemporaryDirectory directory;
  const Scene maze = maze_scene({20, 30, 5}, false, {});
  for (const Segment& door : {Segment{{0.5, 0.5}, {0.5, 1.5}}, Segment{{30.5, 20.5}, {30.5, 19.5}}}) {
    std::vector<Segment> walls{door};
    for (std::size_t i = 0; i < maze.walls.size(); ++i) walls.push_back(maze.walls.segment(i));
    Scene closed;
    closed.walls = WallSet::narrowest(walls);
    write_npy(closed, directory.file("m.npy"), {});
    EXPECT_FALSE(read_npy(InputFile(directory.file("m.npy"), {}), {}).maze.has_value());
  }
}

TEST(Npy, AnOutlineWithAGapIsNoMazeHoweverLongItIs) {
  const TemporaryDirectory directory;
  const Scene maze = maze_scene({20, 30, 5}, false, {});
  std::vector<Segment> walls{{{0.5, 0.5}, {10.5, 0.5}}, {{11.5, 0.5}, {30.5, 0.5}}, {{11.5, 0.5}, {12.5, 0.5}}};
  for (std::size_t i = 1; i < maze.walls.size(); ++i) walls.push_back(maze.walls.segment(i));  // 0 is the bottom
  Scene open;
  open.walls = WallSet::narrowest(walls);
  write_npy(open, directory.file("m.npy"), {});
  EXPECT_FALSE(read_npy(InputFile(directory.file("m.npy"), {}), {}).maze.has_value());
  walls.push_back({{10.5, 0.5}, {11.5, 0.5}});
  open.walls = WallSet::narrowest(walls);
  write_npy(open, directory.file("m.npy"), {});
  EXPECT_TRUE(read_npy(InputFile(directory.file("m.npy"), {}), {}).maze.has_value());
}

TEST(Npy, OneWallOffTheGridAndItIsNoMaze) {
  const TemporaryDirectory directory;
  const Scene maze = maze_scene({200, 200, 3}, false, {});
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < maze.walls.size(); ++i) walls.push_back(maze.walls.segment(i));
  for (const std::size_t changed : {std::size_t{0}, std::size_t{3}, walls.size() - 1}) {
    Scene other;
    std::vector<Segment> moved = walls;
    moved[changed].a.x += 0.25;
    other.walls = WallSet::narrowest(moved);
    write_npy(other, directory.file("m.npy"), {});
    const Scene back = read_npy(InputFile(directory.file("m.npy"), {}), {});
    EXPECT_FALSE(back.maze.has_value()) << changed;
    EXPECT_TRUE(back.start.empty());
    EXPECT_EQ(back.walls.segment(changed), moved[changed]);
  }
}

TEST(Npy, FilesAreAsNumpyWritesThem) {
  const TemporaryDirectory directory;
  Scene scene;
  const std::vector<Segment> walls{{{1, 2}, {3, 0.5}}};
  scene.walls = WallSet::narrowest(walls);
  write_npy(scene, directory.file("w.npy"), {});
  EXPECT_EQ(directory.read("w.npy"), npy(dictionary("<f4", "(1, 4)"), bytes_of<float>({1, 2, 3, 0.5})));
  const std::vector<Segment> fine{{{0.1, 2}, {3, 0.5}}};
  scene.walls = WallSet::narrowest(fine);
  write_npy(scene, directory.file("w.npy"), {});
  EXPECT_EQ(directory.read("w.npy"), npy(dictionary("<f8", "(1, 4)"), bytes_of<double>({0.1, 2, 3, 0.5})));
}

TEST(Npy, RefusesToWriteWhatItCannotHold) {
  const TemporaryDirectory directory;
  Scene scene = maze_scene({3, 3}, false, {});
  scene.spheres.push_back({0, 0, 0, 1});
  EXPECT_THROW(write_npy(scene, directory.file("w.npy"), {}), InputError);
  EXPECT_EQ(directory.entries(), 0U);
}

TEST(Npy, ReadingAndWritingStopAtTheDeadlineAndAskForMemoryFirst) {
  const TemporaryDirectory directory;
  const Scene maze = maze_scene({100, 100}, false, {});
  write_npy(maze, directory.file("m.npy"), {});
  const InputFile file(directory.file("m.npy"), {});
  const Deadline over(0.0);
  const Deadline small = test::limit_from_here(1000);
  EXPECT_THROW(read_npy(file, {.deadline = &over}), Stopped);
  EXPECT_THROW(read_npy(file, {.deadline = &small}), Stopped);
  EXPECT_THROW(write_npy(maze, directory.file("n.npy"), {.deadline = &over}), Stopped);
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(Npy, HoldsPotentials) {
  const TemporaryDirectory directory;
  CellPotential potential{2, 1, {}};
  for (std::size_t i = 0; i < potential.size(); ++i) potential.values.push_back(0.1 * static_cast<double>(i));
  write_npy(potential, directory.file("u.npy"), {});
  EXPECT_EQ(directory.read("u.npy"), npy(dictionary("<f8", "(2, 2, 3)"), bytes_of<double>(potential.values)));
  const CellPotential back = read_potential_npy(InputFile(directory.file("u.npy"), {}), {});
  EXPECT_EQ(back.width, 2U);
  EXPECT_EQ(back.height, 1U);
  EXPECT_EQ(back.values, potential.values);
  const auto refuses = [&](const std::string& content) {
    EXPECT_THROW(read_potential_npy(InputFile(directory.write("b.npy", content), {}), {}), InputError);
  };
  const std::string numbers = bytes_of<double>(potential.values);
  refuses(npy(dictionary("<f8", "(2, 2, 3)"), numbers.substr(8)));
  refuses(npy(dictionary("<f8", "(2, 2, 3)"), numbers + std::string(8, ' ')));
  refuses(npy(dictionary("<f8", "(3, 2, 2)"), numbers));
  refuses(npy(dictionary("<f8", "(12, 1)"), numbers));
  refuses(npy(dictionary("<f4", "(2, 2, 3)"), numbers));
  refuses(npy(dictionary("<f8", "(2, 4294967297, 4294967297)"), numbers));
  refuses("no array");
}

}  // namespace
}  // namespace warren
