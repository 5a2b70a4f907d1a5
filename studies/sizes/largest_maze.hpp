// SPDX-License-Identifier: BSD-3-Clause
// The search behind `warren largest`: which mazes are tried, what came out, and what stands when it ends or is broken
// off. largest_report.hpp writes it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "studies/measure/machine_memory.hpp"
#include "studies/sizes/largest_size.hpp"
#include "studies/sizes/maze_trial.hpp"

namespace warren::studies {

/// A side n stands for n * n cells in the shape rows : cols.
struct LargestOptions {
  double budget_s = 20.0;  ///< of each run's solve_s
  SizeSearch sizes;
  double shape_rows = 1.0;  ///< > 0
  double shape_cols = 1.0;  ///< > 0
  MazeOptions maze;         ///< algorithm, loops, and the first seed
  std::uint64_t seeds = 3;  ///< mazes at the last size; >= 1
  Question question;        ///< start and goal are the mazes'
  SolveOptions planner;     ///< prm or lazy-prm; the seed is the maze's
};

struct UnbegunSize {
  std::uint32_t rows, cols;
  std::size_t expected_bytes;
};

/// BFS and funnel on the last maze.
struct HonestBar {
  double seconds = 0.0;
  double length = 0.0;
};

struct LargestResult {
  std::vector<MazeTrial> trials;     ///< in the order in which they ran
  std::vector<UnbegunSize> unbegun;  ///< would not have fitted in memory
  std::vector<MazeTrial> best;       ///< the runs at the largest size, a seed each; empty: none fitted
  bool confirmed = false;            ///< all seeds of `best` ran and fitted
  std::optional<HonestBar> bar;
  MemoryTouch touch;
  std::optional<StopReason> signal;  ///< the search was broken off
};

/// The run of median solve_s (the upper one of two). best is not empty.
const MazeTrial& median_trial(const LargestResult& result);

/// Searches, and tells `note` a line a trial. The execution has a deadline, whose memory is the limit; its signal ends
/// the search with what there is. Never throws Stopped; throws UsageError for what can't be asked of mazes.
LargestResult find_largest(const LargestOptions& options, const Execution& execution,
                           const std::function<void(std::string_view)>& note);

}  // namespace warren::studies
