// SPDX-License-Identifier: BSD-3-Clause
// The oracle is one process: the answer's bytes are the same for any number of ranks and threads, ranks without a tile
// among them; and whatever one rank can't do ends all.
#include "apps/distributed/leader_follower.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <csignal>
#include <limits>
#include <string>
#include <vector>

#include "apps/distributed/rank_protocol.hpp"
#include "core/base/error.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/mazes/spanning_maze.hpp"
#include "tests/apps/distributed/solved_by_ranks.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/answer_bytes.hpp"
#include "verify/streamed/verify_cells.hpp"

namespace warren::distributed {
namespace {

using test::Asked;
using test::bytes_of;
using test::Found;
using test::much_memory;
using test::solved;
using test::solved_by;
using test::task_of;
using test::ThreadRanks;

Scene mst(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops) {
  return unmade_maze_scene({.rows = rows, .cols = cols, .seed = seed, .algorithm = MazeAlgorithm::mst, .loops = loops});
}

TEST(Leader, AnyNumberOfRanksGivesTheBytesOfOneProcess) {
  const Asked cases[] = {{mst(1, 1, 1, 0.0)},
                         {mst(63, 64, 2, 0.0)},
                         {mst(257, 256, 3, 0.05)},
                         {mst(1000, 900, 4, 0.0)},
                         {mst(1300, 600, 5, 0.1)},
                         {mst(600, 300, 6, 1.0)},
                         {mst(900, 520, 7, 0.02), {.start = {4.2, 300.3}, .goal = {500.0, 257.0}, .clearance = 0.2}},
                         {mst(700, 300, 8, 0.0), {.start = {3.0, 256.5}}},
                         {mst(520, 300, 9, 0.0), {.goal = {400.0, 2.0}}}};
  for (const Asked& asked : cases) {
    SCOPED_TRACE(fmt::format("{} x {}", asked.scene.maze->rows, asked.scene.maze->cols));
    const std::string expected = bytes_of(solved(asked));
    for (const unsigned ranks : test::ranks_tried()) {
      SCOPED_TRACE(ranks);
      EXPECT_EQ(bytes_of(solved_by(ranks, asked, {.threads = 1 + ranks % 2}).answer), expected);
    }
  }
}

TEST(Leader, ASearchOverAllRanksGivesTheBytesOfOneProcess) {
  std::vector<Asked> cases = {
      {mst(1, 1, 1, 0.0)},
      {mst(257, 256, 3, 0.05)},
      {mst(600, 300, 6, 1.0)},
      {mst(900, 520, 7, 0.02), {.start = {4.2, 300.3}, .goal = {500.0, 257.0}, .clearance = 0.2}},
      {mst(900, 520, 7, 0.02), {.start = {100.3, 256.6}, .goal = {100.6, 256.9}}},
      {mst(900, 300, 9, 0.1), {.start = {7.0, 512.5}, .goal = {7.0, 512.5}}},
      {mst(700, 300, 8, 0.0), {.start = {3.0, 256.5}}},
      {mst(520, 300, 9, 0.0), {.goal = {400.0, 2.0}}}};
  for (const std::uint64_t seed : test::seeds(6)) {
    for (const double loops : {0.0, 0.01, 0.1}) {
      cases.push_back({mst(static_cast<std::uint32_t>(500 + 130 * seed), 300, seed, loops)});
    }
  }
  for (const Asked& asked : cases) {
    SCOPED_TRACE(fmt::format("{} x {}, seed {}, loops {}", asked.scene.maze->rows, asked.scene.maze->cols,
                             asked.scene.formula->seed, asked.scene.formula->loops));
    const std::string expected = bytes_of(solved(asked));
    for (const unsigned ranks : test::ranks_tried()) {
      SCOPED_TRACE(ranks);
      const Found found = solved_by(ranks, asked, {.threads = 1 + ranks % 2}, much_memory, 0);
      EXPECT_EQ(bytes_of(found.answer), expected);
      if (found.answer.path.size() > 10) {
        EXPECT_EQ(found.bytes_of_rounds > 0, ranks > 1);
      }
    }
  }
}

TEST(Leader, ASearchOverAllRanksIsForWhatOneDoesNotHold) {
  const Asked asked{mst(700, 300, 1, 0.1)};
  EXPECT_EQ(solved_by(2, asked).bytes_of_rounds, 0);
  EXPECT_GT(solved_by(2, asked, {.threads = 1}, much_memory, 100).bytes_of_rounds, 0);
}

TEST(BandRounds, ABandThatLacksMemorySaysHowMuch) {
  const Deadline tight(std::numeric_limits<double>::infinity(), 1);
  const TileGrid grid = TileGrid::of({512, 256}, 8);
  const auto asked = static_cast<std::uint32_t>(RoundStep::hold);
  TileSummary tile;
  tile.keys = {3, 7};
  const auto rounds = band_rounds(grid, {0, 1}, {}, {tile}, {.threads = 1});
  const auto poor = band_rounds(grid, {0, 1}, {}, {tile}, {.threads = 1, .deadline = &tight});
  const auto lacking = [&](BandRounds& band) {
    ValueUnpacker from(std::as_bytes(std::span(&asked, 1)), "test");
    ValuePacker to;
    band.serve(from, to);
    ValueUnpacker answer(to.bytes(), "test");
    const auto bytes = answer.take<std::uint64_t>();
    answer.take<std::uint64_t>();  // components, and their numbers
    answer.take<std::uint32_t>();
    for (int list = 0; list < 6; ++list) answer.take_list<std::uint32_t>();  // crossings, their keys, what ends join
    EXPECT_TRUE(answer.is_done());
    return bytes;
  };
  EXPECT_EQ(lacking(*rounds), 0);
  EXPECT_GE(lacking(*poor), 2 * 53U);
}

/// Rank 0's end of a transport, which lets a signal come after so many messages of the rounds.
class SignalInRounds : public Transport {
 public:
  SignalInRounds(Transport& whole, unsigned messages, SignalFlag& signal)
      : whole_(whole), left_(messages), signal_(signal) {}
  unsigned rank() const override { return whole_.rank(); }
  unsigned ranks() const override { return whole_.ranks(); }
  void send(unsigned to, std::span<const std::byte> bytes, const Execution& execution) override {
    if (ValueUnpacker(bytes, "test").take<Request>() == Request::rounds && --left_ == 0) signal_ = SIGTERM;
    whole_.send(to, bytes, execution);
  }
  Bytes receive(unsigned from, const Execution& execution) override { return whole_.receive(from, execution); }
  bool has_message(unsigned from) override { return whole_.has_message(from); }

 private:
  Transport& whole_;
  unsigned left_;
  SignalFlag& signal_;
};

TEST(Leader, ASignalInTheRoundsStopsAll) {
  const Asked asked{mst(700, 300, 1, 0.1)};
  for (const unsigned messages : {1U, 3U, 6U, 9U, 40U, 300U}) {
    SCOPED_TRACE(messages);
    SignalFlag signal{0};
    const Deadline deadline(std::numeric_limits<double>::infinity(), much_memory, &signal);
    ThreadRanks team(3);
    Answer answer;
    team.run([&](Transport& transport) {
      if (transport.rank() > 0) return follow(transport, task_of(asked), {.threads = 1, .memory_bytes = much_memory});
      const Execution execution{.threads = 1, .deadline = &deadline};
      SignalInRounds signalled(transport, messages, signal);
      const EndOfFollowers end(transport);
      const auto leader = leader_of(signalled, task_of(asked), execution, 0);
      answer = solved(asked, execution, leader.get());
    });
    EXPECT_EQ(answer.outcome, Outcome::stopped);
    EXPECT_EQ(answer.stop_reason, StopReason::terminate);
  }
}

/// Straight across walls, along borders of tiles, out of the maze, and one that meets none for long.
std::vector<Path<Vec2>> bad_paths() {
  return {{{0.5, 1.0}, {300.0, 700.0}, {299.0, 3.0}, {10.0, 511.0}},
          {{0.5, 1.0}, {20.0, 256.5}, {290.0, 256.4}, {290.0, 512.6}, {5.0, 512.5}},
          {{0.5, 1.0}, {40.0, -30.0}, {400.0, 900.0}},
          {{0.5, 1.0}}};
}

TEST(Leader, JudgesOfAllRanksSayWhatOneSays) {
  for (const double loops : {0.0, 1.0}) {
    const Asked asked{mst(760, 300, 2, loops)};
    const BandTask task = task_of(asked);
    const SpanningMaze maze(760, 300, 2, loops, {.threads = 1});
    VerifyOptions options = task.judged();
    options.start = Vec2{0.5, 1.0};
    options.goal = Vec2{300.5, 760.0};
    for (const Path<Vec2>& path : bad_paths()) {
      const Verification expected = verify_among_cells(maze, path, options, {.threads = 1});
      for (const unsigned ranks : {2U, 3U, 5U}) {
        ThreadRanks team(ranks);
        team.run([&](Transport& transport) {
          if (transport.rank() > 0) return follow(transport, task, {.threads = 1, .memory_bytes = much_memory});
          const EndOfFollowers end(transport);
          const auto leader = leader_of(transport, task, {.threads = 1});
          const auto walls = leader->make({.threads = 1});
          JudgeAmongCells judge(walls->judged(), options, {.threads = 1}, &leader->judges());
          judge.add(path);
          const Verification found = judge.verdict();
          EXPECT_EQ(found.verified, expected.verified);
          EXPECT_EQ(found.min_clearance, expected.min_clearance);
          EXPECT_EQ(found.length, expected.length);
          ASSERT_EQ(found.first_violation.has_value(), expected.first_violation.has_value());
          if (!expected.first_violation) return;
          EXPECT_EQ(found.first_violation->leg, expected.first_violation->leg);
          EXPECT_EQ(found.first_violation->obstacle, expected.first_violation->obstacle);
        });
      }
    }
  }
}

TEST(Leader, BandsCoverAllRowsOnce) {
  for (std::size_t rows = 1; rows < 40; ++rows) {
    for (unsigned ranks = 1; ranks < 12; ++ranks) {
      std::size_t next = 0;
      for (unsigned rank = 0; rank < ranks; ++rank) {
        const Range band = band_rows(rows, rank, ranks);
        EXPECT_EQ(band.first, next);
        next = band.last;
        for (std::size_t row = band.first; row < band.last; ++row) EXPECT_EQ(rank_of_row(row, rows, ranks), rank);
      }
      EXPECT_EQ(next, rows);
    }
  }
}

TEST(Leader, ARankThatLacksMemoryStopsAll) {
  const Found found = solved_by(3, {mst(2100, 1000, 1, 0.0)}, {.threads = 1}, 1);
  EXPECT_EQ(found.answer.outcome, Outcome::stopped);
  EXPECT_EQ(found.answer.stop_reason, StopReason::memory);
}

TEST(Leader, TheEndOfItsTimeStopsAll) {
  const Deadline deadline(0.02);
  const Found found = solved_by(3, {mst(3000, 1500, 1, 0.0)}, {.threads = 1, .deadline = &deadline});
  EXPECT_EQ(found.answer.outcome, Outcome::stopped);
  EXPECT_EQ(found.answer.stop_reason, StopReason::time);
}

TEST(Agreement, ARankWithOtherWordsIsRefusedByAll) {
  for (const unsigned other : {0U, 2U, 5U}) {
    ThreadRanks team(4);
    std::vector<int> agreed(4, -1);
    const auto greet = [&](Transport& transport) {
      agreed[transport.rank()] = agree(transport, transport.rank() == other ? "those" : "these", {}) ? 1 : 0;
    };
    if (other == 5) {
      team.run(greet);
      EXPECT_EQ(agreed, std::vector<int>({1, 1, 1, 1}));
      continue;
    }
    EXPECT_THROW(team.run(greet), InputError);
    EXPECT_EQ(agreed, std::vector<int>({-1, 0, 0, 0}));
  }
}

}  // namespace
}  // namespace warren::distributed
