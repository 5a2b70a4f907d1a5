// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/read_world_io.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>

#include "core/base/error.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

TEST(ReadWorld, GeneratesMazesFromTheirName) {
  const Scene scene = read_world("maze:5x7", {});
  EXPECT_EQ(scene.walls.size(), 28U);
  EXPECT_EQ(scene.source, "maze:5x7");
  EXPECT_EQ(*scene.maze, (MazeHint{5, 7}));
  const MazeOptions options = parse_maze_source("maze:3x4,loops=0.5,algorithm=wilson,seed=18446744073709551615");
  EXPECT_EQ(options.rows, 3U);
  EXPECT_EQ(options.cols, 4U);
  EXPECT_EQ(options.loops, 0.5);
  EXPECT_EQ(options.algorithm, MazeAlgorithm::wilson);
  EXPECT_EQ(options.seed, ~std::uint64_t{0});
  const MazeOptions plain = parse_maze_source("maze:3x4");
  EXPECT_EQ(plain.seed, 1U);
  EXPECT_EQ(plain.algorithm, MazeAlgorithm::backtracker);
  EXPECT_EQ(plain.loops, 0.0);
}

TEST(ReadWorld, RefusesBadMazeNamesAsUsage) {
  constexpr std::pair<const char*, const char*> cases[] = {
      {"maze:", "the size is missing"},
      {"maze:5", "the size is missing"},
      {"maze:x", "ROWS must be a whole number"},
      {"maze:5x", "COLS must be a whole number"},
      {"maze:5x5x5", "COLS must be a whole number"},
      {"maze:0x5", "ROWS must be at least 1"},
      {"maze:5x0", "COLS must be at least 1"},
      {"maze:-5x5", "ROWS must be a whole number that is not negative"},
      {"maze:5.5x5", "ROWS must be a whole number"},
      {"maze: 5x5", "ROWS must be a whole number"},
      {"maze:65536x65536", "ROWS x COLS must be below 2^32"},
      {"maze:99999999999999999999x1", "ROWS must be a whole number"},
      {"maze:4294967296x1", "ROWS must be at least 1 and below 2^32"},
      {"maze:5x5,", "nothing follows the last comma"},
      {"maze:5x5,seed", "seed must be a whole number"},
      {"maze:5x5,seed=-1", "seed must be a whole number"},
      {"maze:5x5,seed=1,seed=2", "`seed` stands twice"},
      {"maze:5x5,loops=2", "loops must be from 0 to 1"},
      {"maze:5x5,loops=nan", "loops must be from 0 to 1"},
      {"maze:5x5,loops=half", "loops must be a number"},
      {"maze:5x5,algorithm=magic", "must be one of backtracker, kruskal, prim, wilson, course, mst (found: magic)"},
      {"maze:5x5,colour=red", "unknown key `colour`"},
  };
  for (const auto& [source, expected] : cases) {
    SCOPED_TRACE(source);
    const std::string said = test::refusal<UsageError>([&, &source = source] { read_world(source, {}); });
    EXPECT_NE(said.find(expected), std::string::npos) << said;
    EXPECT_EQ(said.find(source), 0U) << said;
  }
}

TEST(ReadWorld, AnEmptyWorldIsItsBounds) {
  const Scene scene = read_world("empty:20x7.5", {});
  ASSERT_TRUE(scene.bounds);
  EXPECT_EQ(scene.bounds->max, (Vec2{20, 7.5}));
  EXPECT_EQ(scene.bounds->min, (Vec2{0, 0}));
  EXPECT_EQ(scene.walls.size() + scene.polygons.size(), 0U);
  EXPECT_EQ(scene.source, "empty:20x7.5");
  for (const char* source : {"empty:", "empty:5", "empty:5x", "empty:x5", "empty:0x5", "empty:5x-1", "empty:nanx5",
                             "empty:5x5x5", "empty:1e300x5", "empty:5x5,seed=1", "empty: 5x5"}) {
    EXPECT_THROW(read_world(source, {}), UsageError) << source;
  }
}

TEST(ReadWorld, TheSameWallsHaveTheSameHashWhereverTheyComeFrom) {
  const TemporaryDirectory directory;
  const std::string source = "maze:90x120,seed=4,algorithm=prim,loops=0.1";
  const Scene maze = read_world(source, {});
  const std::string hash = scene_hash(maze);
  EXPECT_EQ(hash.size(), 16U);
  for (const char* name : {"m.walls", "m.scene", "m.txt", "m.npy"}) {
    write_scene(maze, directory.file(name), {});
    const Scene back = read_world(directory.file(name), {});
    EXPECT_EQ(scene_hash(back), hash) << name;
    EXPECT_EQ(back.maze, maze.maze) << name;
    EXPECT_EQ(back.source, directory.file(name));
  }
  for (const unsigned threads : {1U, 2U, 3U, 8U}) EXPECT_EQ(scene_hash(maze, {.threads = threads}), hash);
  Scene wide;  // doubles instead of floats
  RawVector<DoubleWall> walls(maze.walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Segment s = maze.walls.segment(i);
    walls[i] = {s.a.x, s.a.y, s.b.x, s.b.y};
  }
  wide.walls = WallSet(std::move(walls));
  EXPECT_EQ(scene_hash(wide), hash);
}

TEST(SceneHash, SeesEveryObstacleAndNothingElse) {
  Scene scene = maze_scene({20, 20, 1}, false, {});
  const std::string hash = scene_hash(scene);
  Scene other = scene;
  other.start = {3, 3};
  other.clearance = 0.2;
  other.maze.reset();
  EXPECT_EQ(scene_hash(other), hash);
  std::vector<std::string> hashes{hash, scene_hash(maze_scene({20, 20, 2}, false, {})),
                                  scene_hash(maze_scene({20, 20, 1}, true, {})), scene_hash(Scene{})};
  scene.bounds = Box{{0, 0}, {1, 1}};
  hashes.push_back(scene_hash(scene));
  scene.polygons.push_back({{{0, 0}, {1, 0}, {0, 1}}, 0});
  hashes.push_back(scene_hash(scene));
  scene.polygons[0].corners[2].y = 1.5;
  hashes.push_back(scene_hash(scene));
  scene.spheres.push_back({0, 0, 0, 1});
  hashes.push_back(scene_hash(scene));
  scene.boxes.push_back({{0, 0, 0}, {1, 1, 1}});
  hashes.push_back(scene_hash(scene));
  for (std::size_t i = 0; i < hashes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(hashes[i], hashes[j]) << i << " " << j;
  }
}

TEST(ObstacleBox, HoldsWallsAndPolygonsButNotBounds) {
  Scene scene = maze_scene({300, 400, 1}, false, {});
  scene.bounds = Box{{-9, -9}, {999, 999}};
  Box box = obstacle_box(scene);
  EXPECT_EQ(box.min, (Vec2{0.5, 0.5}));
  EXPECT_EQ(box.max, (Vec2{400.5, 300.5}));
  scene.polygons.push_back({{{-3, 0}, {1, 0}, {0, 500}}, 0});
  box = obstacle_box(scene, {.threads = 3});
  EXPECT_EQ(box.min, (Vec2{-3, 0}));
  EXPECT_EQ(box.max, (Vec2{400.5, 500}));
  EXPECT_TRUE(obstacle_box(Scene{}).empty());
}

TEST(ReadWorld, ContentDecidesBeforeTheEnding) {
  const TemporaryDirectory directory;
  write_scene(maze_scene({3, 3}, false, {}), directory.file("m.npy"), {});
  EXPECT_EQ(read_world(directory.write("m.walls", directory.read("m.npy")), {}).walls.size(), 8U);
  const auto format = [&](const char* name, const char* content) {
    return format_of(InputFile(directory.write(name, content), {}));
  };
  EXPECT_EQ(format("a.scene", "\x89PNG\r\n"), WorldFormat::image);
  EXPECT_EQ(format("a.scene", "P5\n3 3\n255\n"), WorldFormat::image);
  EXPECT_EQ(format("a.scene", "type octile\nheight 3\n"), WorldFormat::moving_ai);
  EXPECT_EQ(format("a.scene", "# map\nimage: a.pgm\n"), WorldFormat::ros_map);
  EXPECT_EQ(format("a.scene", "polygon 0 0 1 1 1 0\n"), WorldFormat::scene);
  EXPECT_EQ(format("a", "0 0 1 1\n"), WorldFormat::scene);
  EXPECT_EQ(format("a.npy", "0 0 1 1\n"), WorldFormat::npy);
  EXPECT_EQ(format("a.map", "0 0 1 1\n"), WorldFormat::moving_ai);
  EXPECT_EQ(format("a.yaml", ""), WorldFormat::ros_map);
  EXPECT_THROW(read_world(directory.write("b.png", "\x89PNG\r\n"), {}), InputError);
}

TEST(ReadWorld, WhatCannotBeReadIsAReadErrorThatNamesIt) {
  const TemporaryDirectory directory;
  for (const std::string& path : {directory.path(), directory.file("nothing.scene"), std::string("/dev/null/x")}) {
    const std::string said = test::refusal<ReadError>([&] { read_world(path, {}); });
    EXPECT_EQ(said.find(path + ": can't be read: "), 0U) << path << ' ' << said;
  }
  EXPECT_THROW(read_world("/dev/null", {}), InputError);  // can be read, but is empty
}

TEST(ReadWorld, ReadsPipesToTheirEnd) {
  const TemporaryDirectory directory;
  const std::string pipe = directory.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string text;
  for (int i = 0; i < 20'000; ++i) text += std::to_string(i) + " 0 1 1\n";  // more than a pipe holds
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const int file = ::open(pipe.c_str(), O_WRONLY);
    std::size_t done = 0;
    while (done < text.size()) {
      const ssize_t written = ::write(file, text.data() + done, text.size() - done);
      if (written <= 0) break;
      done += static_cast<std::size_t>(written);
    }
    ::_exit(0);
  }
  const Scene scene = read_world(pipe, {});
  EXPECT_EQ(scene.walls.size(), 20'000U);
  EXPECT_EQ(scene.walls.segment(19'999).a.x, 19'999.0);
}

/// Puts a file in the place of a standard stream while it lives.
class Redirection : NotCopied {
 public:
  Redirection(int stream, const std::string& path, int flags) : stream_(stream), kept_(::dup(stream)) {
    const int file = ::open(path.c_str(), flags, 0600);
    ::dup2(file, stream_);
    ::close(file);
  }
  ~Redirection() {
    ::dup2(kept_, stream_);
    ::close(kept_);
  }

 private:
  int stream_;
  int kept_;
};

TEST(ReadWorld, DashIsStandardInputAndForWritingStandardOutput) {
  const TemporaryDirectory directory;
  const Scene maze = read_world("maze:40x30", {});
  {
    const Redirection output(STDOUT_FILENO, directory.file("out.walls"), O_WRONLY | O_CREAT);
    write_scene(maze, "-", {});
  }
  const Redirection input(STDIN_FILENO, directory.file("out.walls"), O_RDONLY);
  const Scene back = read_world("-", {});
  EXPECT_EQ(back.source, "standard input");
  EXPECT_EQ(scene_hash(back), scene_hash(maze));
  std::string line(10, ' ');
  ASSERT_EQ(::read(STDIN_FILENO, line.data(), line.size()), 10);  // not at its beginning: the rest is read
  EXPECT_EQ(line, "maze 40 30");
  EXPECT_EQ(read_world("-", {}).walls.size(), maze.walls.size());
}

TEST(ReadWorld, WaitingForAPipePollsTheDeadline) {
  const TemporaryDirectory directory;
  ASSERT_EQ(::mkfifo(directory.file("pipe").c_str(), 0600), 0);
  const Deadline soon(0.02);
  EXPECT_THROW(read_world(directory.file("pipe"), {.deadline = &soon}), Stopped);
}

TEST(WriteScene, EndingsDecideAndOthersAreUsageErrors) {
  const TemporaryDirectory directory;
  const Scene maze = maze_scene({3, 3}, false, {});
  for (const char* name : {"m.json", "m", "m.scene.bak", "m.png"}) {
    EXPECT_THROW(write_scene(maze, directory.file(name), {}), UsageError) << name;
  }
  EXPECT_EQ(directory.entries(), 0U);
}

}  // namespace
}  // namespace warren
