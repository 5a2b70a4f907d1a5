// SPDX-License-Identifier: BSD-3-Clause
// The oracle is one process: the answer's bytes are the same for any number of ranks and threads, ranks without a tile
// among them; and whatever one rank can't do ends all.
#include "distributed/leader.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/base/error.hpp"
#include "distributed/agreement.hpp"
#include "distributed/follower.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/mazes/spanning_maze.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "solve/mazes/solve_streamed.hpp"
#include "tests/distributed/thread_ranks.hpp"
#include "verify/cells/verify_cells.hpp"

namespace warren {
namespace {

using test::ThreadRanks;

struct Asked {
  MazeOptions maze;
  Question question = {};
};

MazeOptions mst(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops) {
  return {.rows = rows, .cols = cols, .seed = seed, .algorithm = MazeAlgorithm::mst, .loops = loops};
}

std::string bytes_of(Answer answer) {
  answer.seconds = {};
  answer.solve_s = 0.0;
  answer.threads = 1;
  answer.peak_memory_bytes = 0;
  std::string text;
  write_answer_json(answer, {}, [&](std::string_view piece) { text += piece; });
  return text;
}

BandTask task_of(const Asked& asked) {
  const Scene scene = unmade_maze_scene(asked.maze);
  const WallProblem problem = keeping_off(scene, asked.question, "");
  return {asked.maze.rows,  asked.maze.cols, asked.maze.seed,
          asked.maze.loops, problem.reach(), {.radius = problem.robot.radius, .clearance = problem.clearance}};
}

Answer solved(const Asked& asked, const Execution& execution, StreamedTeam* team) {
  SolveOptions options;
  options.roadmap.pipeline = PipelineKind::streamed;
  return solve_streamed_within(unmade_maze_scene(asked.maze), asked.question, options, execution, {.team = team});
}

struct Found {
  Answer answer;
  std::uint64_t bytes_sent = 0;
};

Found solved_by(unsigned ranks, const Asked& asked, const Execution& execution = {.threads = 1},
                std::size_t followers_memory = std::size_t{1} << 40U) {
  ThreadRanks team(ranks);
  const BandTask task = task_of(asked);
  Found found;
  team.run([&](Transport& transport) {
    if (transport.rank() > 0) {
      follow(transport, task, {.threads = execution.threads, .memory_bytes = followers_memory});
      return;
    }
    const EndOfFollowers end(transport);
    Leader leader(transport, task, execution);
    found.answer = solved(asked, execution, &leader);
  });
  found.bytes_sent = team.bytes_sent();
  return found;
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
    SCOPED_TRACE(std::to_string(asked.maze.rows) + "x" + std::to_string(asked.maze.cols));
    const std::string expected = bytes_of(solved(asked, {.threads = 1}, nullptr));
    for (const unsigned ranks : {1U, 2U, 3U, 5U, 8U}) {
      SCOPED_TRACE(ranks);
      EXPECT_EQ(bytes_of(solved_by(ranks, asked, {.threads = 1 + ranks % 2}).answer), expected);
    }
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
    VerifyOptions options = task.judged;
    options.start = Vec2{0.5, 1.0};
    options.goal = Vec2{300.5, 760.0};
    for (const Path<Vec2>& path : bad_paths()) {
      const Verification expected = verify_among_cells(maze, path, options, {.threads = 1});
      for (const unsigned ranks : {2U, 3U, 5U}) {
        ThreadRanks team(ranks);
        team.run([&](Transport& transport) {
          if (transport.rank() > 0)
            return follow(transport, task, {.threads = 1, .memory_bytes = std::size_t{1} << 40U});
          const EndOfFollowers end(transport);
          Leader leader(transport, task, {.threads = 1});
          JudgeAmongCells judge(leader.make({.threads = 1}), options, {.threads = 1}, &leader.judges());
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
        const TileRows band = band_rows(rows, rank, ranks);
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
}  // namespace warren
