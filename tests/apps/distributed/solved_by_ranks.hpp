// SPDX-License-Identifier: BSD-3-Clause
// One question to a maze that nobody holds, asked of one process and of ranks that are threads.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "apps/distributed/leader_follower.hpp"
#include "apps/distributed/rank_protocol.hpp"
#include "solve/streamed/solve_streamed.hpp"
#include "tests/apps/distributed/thread_ranks.hpp"
#include "tests/seeds.hpp"

namespace warren::test {

constexpr std::size_t much_memory = std::size_t{1} << 40U;
constexpr std::uint64_t all_keys = std::numeric_limits<std::uint64_t>::max();

/// One, even and odd, as many as bands and more; by day one rank without a tile is enough.
inline std::vector<unsigned> ranks_tried() {
  return asks_all() ? std::vector{1U, 2U, 3U, 5U, 8U} : std::vector{2U, 5U};
}

struct Asked {
  Scene scene;  // is_unmade
  Question question = {};
};

inline distributed::BandTask task_of(const Asked& asked) {
  return distributed::BandTask{asked.scene, keeping_off(asked.scene, asked.question, "")};
}

inline Answer solved(const Asked& asked, const Execution& execution = {.threads = 1}, StreamedTeam* team = nullptr) {
  SolveOptions options;
  options.roadmap.pipeline = PipelineKind::streamed;
  return solve_streamed_within(asked.scene, asked.question, options, execution, {.team = team});
}

struct Found {
  Answer answer;
  std::uint64_t bytes_of_rounds = 0;
  std::optional<distributed::SearchLack> lack = {};
};

/// tasks: of each rank, as it sees the world. most_keys: of the overlay, at rank 0.
inline Found solved_by(const std::vector<distributed::BandTask>& tasks, const Asked& asked, const Execution& execution,
                       std::size_t followers_memory, std::uint64_t most_keys) {
  ThreadRanks team(static_cast<unsigned>(tasks.size()));
  Found found;
  team.run([&](distributed::Transport& transport) {
    const distributed::BandTask& task = tasks[transport.rank()];
    if (transport.rank() > 0) {
      return distributed::follow(transport, task, {.threads = execution.threads, .memory_bytes = followers_memory});
    }
    const distributed::EndOfFollowers end(transport);
    const auto leader = distributed::leader_of(transport, task, execution, most_keys);
    found.answer = solved(asked, execution, leader.get());
    found.bytes_of_rounds = leader->traffic()[static_cast<std::size_t>(distributed::Request::rounds)];
    found.lack = leader->lack();
  });
  return found;
}

inline Found solved_by(unsigned ranks, const Asked& asked, const Execution& execution = {.threads = 1},
                       std::size_t followers_memory = much_memory, std::uint64_t most_keys = all_keys) {
  return solved_by(std::vector<distributed::BandTask>(ranks, task_of(asked)), asked, execution, followers_memory,
                   most_keys);
}

}  // namespace warren::test
