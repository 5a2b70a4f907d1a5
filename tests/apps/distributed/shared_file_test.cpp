// SPDX-License-Identifier: BSD-3-Clause
// Walls of files that ranks read by bands. The oracle is one process that reads all of the file.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "apps/distributed/shared_solve.hpp"
#include "core/base/error.hpp"
#include "planners/mazes/tile_plane.hpp"
#include "scenes/files/maze_file_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/apps/distributed/solved_by_ranks.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/answer_bytes.hpp"

namespace warren::distributed {
namespace {

using test::Asked;
using test::bytes_of;
using test::much_memory;
using test::solved;
using test::solved_by;
using test::task_of;

Scene unmade(const std::string& path) { return unmade_maze(InputFile(path, {})).value(); }

struct Walls {
  MazeOptions maze;
  std::vector<Segment> more = {};  ///< that the generator does not have
  Question question = {};
};

/// Level, from side to side, above these rows.
Segment barrier(const MazeOptions& maze, std::uint32_t rows) {
  return {{0.5, rows + 0.5}, {maze.cols + 0.5, rows + 0.5}};
}

Scene made(const Walls& walls, bool merged) {
  Scene scene = maze_scene(walls.maze, merged, {});
  std::vector<Segment> all;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) all.push_back(scene.walls.segment(i));
  all.insert(all.end(), walls.more.begin(), walls.more.end());
  scene.walls = WallSet::narrowest(all);
  return scene;
}

std::vector<std::string> files_of(const Walls& walls, const TemporaryDirectory& directory) {
  write_scene(made(walls, false), directory.file("a.maze"));
  write_scene(made(walls, false), directory.file("units.npy"));
  write_scene(made(walls, true), directory.file("merged.npy"));
  return {directory.file("a.maze"), directory.file("units.npy"), directory.file("merged.npy")};
}

void expect_the_bytes_of_one_process(const Walls& walls) {
  const TemporaryDirectory directory;
  for (const std::string& file : files_of(walls, directory)) {
    const Asked asked{unmade(file), walls.question};
    const std::string expected = bytes_of(solved(asked));
    for (const unsigned ranks : test::ranks_tried()) {
      for (const std::uint64_t most_keys : {test::all_keys, std::uint64_t{0}}) {
        SCOPED_TRACE(
            fmt::format("{} x {}, {}, {} ranks, {} keys", walls.maze.rows, walls.maze.cols, file, ranks, most_keys));
        const test::Found found = solved_by(ranks, asked, {.threads = 1 + ranks % 2}, much_memory, most_keys);
        EXPECT_EQ(bytes_of(found.answer), expected);
        if (found.answer.roadmap.milestones > 256 * 300 && most_keys == 0) {
          EXPECT_EQ(found.bytes_of_rounds > 0, ranks > 1);
        }
      }
    }
  }
}

TEST(SharedFile, AnyNumberOfRanksGivesTheBytesOfOneProcess) {
  const Walls cases[] = {{{2, 2, 1}},
                         {{257, 260, 3, MazeAlgorithm::kruskal, 0.05}},
                         {{1300, 300, 4, MazeAlgorithm::wilson, 0.0}},
                         {{1000, 520, 5, MazeAlgorithm::backtracker, 0.1}},
                         {{520, 300, 6, MazeAlgorithm::kruskal, 0.0}, {}, {.start = {4.0, 256.5}}},
                         {{520, 300, 7, MazeAlgorithm::kruskal, 0.1}, {}, {.goal = {300.0, 520.5}}},
                         {{700, 270, 8, MazeAlgorithm::kruskal, 1.0},
                          {},
                          {.start = {4.2, 300.3}, .goal = {200.0, 513.0}, .clearance = 0.2}}};
  for (const std::uint64_t i : test::seeds(std::size(cases), 1, 0)) expect_the_bytes_of_one_process(cases[i]);
}

/// Start and goal in the same band, in neighbours, far apart, and one of them alone in a tile.
TEST(SharedFile, EndsThatAreNotJoinedAreAsFarApartAsOneProcessSays) {
  for (const std::uint64_t looped : test::seeds(2, 1, 0)) {
    const double loops = looped == 0 ? 0.0 : 0.1;
    const MazeOptions maze{800, 300, 2, MazeAlgorithm::kruskal, loops};
    const std::vector<Segment> cell = {{{99.5, 599.5}, {100.5, 599.5}},
                                       {{99.5, 600.5}, {100.5, 600.5}},
                                       {{99.5, 599.5}, {99.5, 600.5}},
                                       {{100.5, 599.5}, {100.5, 600.5}}};
    const Walls cases[] = {{maze, {barrier(maze, 100)}},
                           {maze, {barrier(maze, 256)}},
                           {maze, {barrier(maze, 511), barrier(maze, 512)}},
                           {maze, {barrier(maze, 300)}, {.start = {7.0, 260.0}, .goal = {280.0, 310.0}}},
                           {maze, cell, {.goal = {100.0, 600.0}}}};
    for (const std::uint64_t i : test::seeds(std::size(cases), 1, 0)) expect_the_bytes_of_one_process(cases[i]);
  }
}

/// Rank 0's end of a transport, which stops when all are asked to reduce their tiles a second time: for the gap.
class StopAtTheGap : public Transport {
 public:
  StopAtTheGap(Transport& whole, StopReason reason) : whole_(whole), left_(whole.ranks()), reason_(reason) {}
  unsigned rank() const override { return whole_.rank(); }
  unsigned ranks() const override { return whole_.ranks(); }
  void send(unsigned to, std::span<const std::byte> bytes, const Execution& execution) override {
    if (ValueUnpacker(bytes, "test").take<Request>() == Request::reduce && --left_ == 0) throw Stopped(reason_);
    whole_.send(to, bytes, execution);
  }
  Bytes receive(unsigned from, const Execution& execution) override { return whole_.receive(from, execution); }
  bool has_message(unsigned from) override { return whole_.has_message(from); }

 private:
  Transport& whole_;
  unsigned left_;
  const StopReason reason_;
};

Answer stopped_at_the_gap(const Asked& asked, StopReason reason, std::uint64_t most_keys) {
  test::ThreadRanks team(3);
  Answer answer;
  team.run([&](Transport& transport) {
    if (transport.rank() > 0) return follow(transport, task_of(asked), {.threads = 1, .memory_bytes = much_memory});
    StopAtTheGap stopping(transport, reason);
    const EndOfFollowers end(transport);
    const auto leader = leader_of(stopping, task_of(asked), {.threads = 1}, most_keys);
    answer = solved(asked, {.threads = 1}, leader.get());
  });
  return answer;
}

TEST(SharedFile, NoWayStaysTheAnswerWhereNobodyHoldsTheGap) {
  const TemporaryDirectory directory;
  const MazeOptions maze{700, 300, 1, MazeAlgorithm::kruskal, 0.1};
  const Asked asked{unmade(files_of({maze, {barrier(maze, 300)}}, directory).front())};
  for (const std::uint64_t most_keys : {test::all_keys, std::uint64_t{0}}) {
    for (const StopReason reason : {StopReason::memory, StopReason::time}) {
      const Answer answer = stopped_at_the_gap(asked, reason, most_keys);
      EXPECT_EQ(answer.outcome, Outcome::not_connected);
      EXPECT_FALSE(answer.separation.is_known());
      EXPECT_NE(bytes_of(answer).find("\"components\": null"), std::string::npos) << bytes_of(answer);
    }
    EXPECT_EQ(stopped_at_the_gap(asked, StopReason::terminate, most_keys).stop_reason, StopReason::terminate);
  }
}

/// The second rank's end of a transport, by which the tiles that it hands over lack a crossing to those of the first.
class OtherCrossings : public Transport {
 public:
  OtherCrossings(Transport& whole, std::uint32_t side) : whole_(whole), side_(side) {}
  unsigned rank() const override { return whole_.rank(); }
  unsigned ranks() const override { return whole_.ranks(); }
  void send(unsigned to, std::span<const std::byte> bytes, const Execution& execution) override {
    if (asked_ != Request::hand_over) return whole_.send(to, bytes, execution);
    ValueUnpacker from(bytes, "test");
    ValuePacker changed;
    changed.add(from.take<Reply>());
    bool is_first = true;
    while (!from.is_done()) {
      TileSummary tile = unpack_summary(from, side_);
      if (is_first) tile.crossings[3].pop_back();
      is_first = false;
      pack_summary(tile, changed);
    }
    whole_.send(to, changed.bytes(), execution);
  }
  Bytes receive(unsigned from, const Execution& execution) override {
    Bytes bytes = whole_.receive(from, execution);
    asked_ = ValueUnpacker(bytes, "test").take<Request>();
    return bytes;
  }
  bool has_message(unsigned from) override { return whole_.has_message(from); }

 private:
  Transport& whole_;
  const std::uint32_t side_;
  Request asked_ = Request::make;
};

TEST(SharedFile, TilesForTheGapThatDisagreeAreRefused) {
  const TemporaryDirectory directory;
  const MazeOptions maze{700, 300, 1, MazeAlgorithm::kruskal, 0.1};
  const Asked asked{unmade(files_of({maze, {barrier(maze, 300)}}, directory).front())};
  test::ThreadRanks team(2);
  const auto run = [&](Transport& transport) {
    if (transport.rank() > 0) {
      OtherCrossings other(transport, task_of(asked).grid().side());
      return follow(other, task_of(asked), {.threads = 1, .memory_bytes = much_memory});
    }
    const EndOfFollowers end(transport);
    const auto leader = leader_of(transport, task_of(asked), {.threads = 1}, 0);  // hands over for the gap alone
    solved(asked, {.threads = 1}, leader.get());
  };
  EXPECT_THROW(team.run(run), InputError);
}

/// With the bits of some cell turned.
std::string damaged(std::string bytes, std::size_t row, std::size_t cols) {
  char& byte = bytes[64 + row * ((cols + 3) / 4) + 10];
  byte = static_cast<char>(byte ^ 0x11);
  return bytes;
}

std::string error_of(const std::vector<BandTask>& tasks, const Asked& asked) {
  return test::refusal<InputError>([&] { solved_by(tasks, asked, {.threads = 1}, much_memory, test::all_keys); });
}

TEST(SharedFile, DamagedRowsAreToldByTheRankThatReadsThem) {
  const TemporaryDirectory directory;
  const Walls walls{{1300, 300, 4, MazeAlgorithm::kruskal, 0.0}};
  write_scene(made(walls, false), directory.file("a.maze"));
  const std::string bytes = directory.read("a.maze");
  for (const auto& [row, said] : {std::pair{0U, "rows 0 to 255: are damaged"},
                                  {512U, "rank 1: {}: rows 512 to 767: are damaged"},
                                  {1299U, "rank 2: {}: rows 1280 to 1299: are damaged"}}) {
    const Asked asked{unmade(directory.write("b.maze", damaged(bytes, row, 300)))};
    const std::string found = error_of(std::vector<BandTask>(3, task_of(asked)), asked);
    EXPECT_NE(found.find(fmt::format(fmt::runtime(said), directory.file("b.maze"))), std::string::npos) << found;
  }
}

TEST(SharedFile, DamageBelowTheRowsOfARankIsToldByItWhereTheCopyIsItsOwn) {
  const TemporaryDirectory directory;
  const Walls walls{{1300, 300, 4, MazeAlgorithm::kruskal, 0.0}};
  write_scene(made(walls, false), directory.file("a.maze"));
  const Asked asked{unmade(directory.file("a.maze"))};
  std::vector<BandTask> tasks(3, task_of(asked));
  tasks[1].unmade.packed->file = directory.write("b.maze", damaged(directory.read("a.maze"), 511, 300));
  const std::string found = error_of(tasks, asked);
  EXPECT_NE(found.find(fmt::format("rank 1: {}: rows 256 to 511: are damaged", tasks[1].unmade.packed->file)),
            std::string::npos)
      << found;
}

TEST(SharedFile, ARankThatReadsOtherWallsIsRefused) {
  const TemporaryDirectory directory;
  for (const std::string_view kind : {"maze", "npy"}) {
    std::vector<Asked> asked;
    for (const std::uint64_t seed : {1U, 2U}) {
      const std::string file = directory.file(fmt::format("{}.{}", seed, kind));
      write_scene(made({{600, 300, seed, MazeAlgorithm::kruskal, 0.0}}, false), file);
      asked.push_back({unmade(file)});
    }
    std::vector<BandTask> tasks(3, task_of(asked[0]));
    EXPECT_EQ(error_of(tasks, asked[0]), "");
    if (kind == "npy") {
      tasks[2] = task_of(asked[1]);  // of as many rows
    } else {
      tasks[2].unmade.packed->file = asked[1].scene.packed->file;  // changed since all looked at it
    }
    const std::string found = error_of(tasks, asked[0]);
    EXPECT_TRUE(found.starts_with("rank 2: ")) << found;
    EXPECT_NE(found.find(kind == "npy" ? "another hash" : "has changed since"), std::string::npos) << found;
  }
}

TEST(SharedWorld, FilesThatDifferHaveOtherFacts) {
  const TemporaryDirectory directory;
  const auto facts = [&](const char* file) { return shared_world(directory.file(file), {}).second; };
  const MazeOptions maze{300, 270, 1, MazeAlgorithm::kruskal};
  files_of({maze}, directory);
  const std::string bytes = directory.read("a.maze");
  directory.write("same.maze", bytes);
  EXPECT_EQ(facts("a.maze"), facts("same.maze"));
  write_scene(maze_scene({300, 270, 2, MazeAlgorithm::kruskal}, false, {}), directory.file("other.maze"));
  EXPECT_NE(facts("a.maze"), facts("other.maze"));
  EXPECT_NE(facts("units.npy"), facts("merged.npy"));
  EXPECT_NE(facts("a.maze"), facts("units.npy"));
}

TEST(SharedWorld, WhatRanksDoNotShareIsRefused) {
  const TemporaryDirectory directory;
  EXPECT_THROW(shared_world("maze:30x30", {}), UsageError);
  EXPECT_THROW(shared_world("-", {}), UsageError);
  EXPECT_THROW(shared_world("/dev/null", {}), UsageError);
  EXPECT_THROW(shared_world(directory.write("a.walls", "0 0 1 1\n"), {}), UsageError);
  EXPECT_THROW(shared_world(directory.file("none.maze"), {}), ReadError);
  files_of({{30, 30, 1}}, directory);
  const std::string bytes = directory.read("a.maze");
  EXPECT_THROW(shared_world(directory.write("b.maze", bytes.substr(0, bytes.size() - 1)), {}), InputError);
  Scene scene;
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{0.0, 0.0}, {1.0, 2.0}}});
  write_scene(scene, directory.file("b.npy"));
  EXPECT_THROW(shared_world(directory.file("b.npy"), {}), InputError);
}

}  // namespace
}  // namespace warren::distributed
