// SPDX-License-Identifier: BSD-3-Clause
// Sizes x seeds x planners x threads, each solved several times: the runs behind `warren scale`, what they say, and how
// it is told.
//
// A maze is generated once; its runs are interleaved (all planners and thread counts, then all of them again), so that
// whatever else the machine does meanwhile meets every one of them alike. The first round of a size is also the one
// that finds memory cold: the minimum leaves it out, the spread shows it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/studies/machine.hpp"
#include "apps/studies/maze_trial.hpp"
#include "apps/studies/statistics.hpp"
#include "scenes/text/human_units.hpp"

namespace warren::studies {

struct ScalingOptions {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes;  ///< rows, cols; ascending cells
  std::vector<unsigned> threads;                               ///< ascending
  Question question;                                           ///< start and goal are the mazes'
  std::vector<SolveOptions> planners;                          ///< prm or lazy-prm; seeds are the mazes'
  std::vector<std::uint64_t> seeds;                            ///< of maze and sampling
  unsigned repeats = 3;                                        ///< >= 1
  double budget_s = 0.0;                                       ///< of each run's solve_s; infinity: none
  MazeOptions maze;                                            ///< algorithm and loops
};

struct ScalingRun {
  MazeTrial trial;
  unsigned repeat = 0;  ///< 0 is the first
  RunCounts counts = {};
  double arithmetic_per_s = 0.0;  ///< what the machine gave its threads, before and after; 0: broken off
};

struct ScalingResult {
  std::vector<ScalingRun> runs;                                      ///< in the order in which they ran
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ungenerated;  ///< too large for the memory
  std::optional<StopReason> signal;                                  ///< the study was broken off
  std::string no_hardware_counts;  ///< why the processor's counts are absent; empty: they are there
};

/// Runs the study, and tells `note` a line a maze. The execution has a deadline, whose memory is the limit; its signal
/// ends the study with what there is. Never throws Stopped; throws UsageError for what can't be asked of mazes.
ScalingResult run_scaling_study(const ScalingOptions& options, const Execution& execution,
                                const std::function<void(std::string_view)>& note);

/// All runs of one size, planner and thread count that were solved.
struct ScalingRow {
  MazeTrial fastest;  ///< the run of least solve_s; its `seconds` are each stage's least of all runs
  std::size_t runs = 0;
  double median_s = 0.0;
  double spread = 0.0;                ///< slowest over fastest repeat of one maze, minus 1; the largest of the seeds
  double speed_up = 0.0;              ///< against the row of fewest threads, times its threads
  std::size_t peak_memory_bytes = 0;  ///< the most of all runs
  RunCounts counts = {};              ///< of the fastest run
};

/// Rows by planner, then size, then threads, as they first ran.
std::vector<ScalingRow> scaling_rows(const ScalingResult& result);

/// Exponents of time against cells, by stage, "solve" last: of each stage's least times in these rows, one level a
/// planner and thread count. Stages below 20 us are left out: there the clock and the start of threads are measured.
std::vector<std::pair<std::string, double>> stage_exponents(std::span<const ScalingRow> rows);

/// What more threads gain, run against run: each run is held against the one of fewest threads of the same repeat, and
/// beside it stands what arithmetic in registers gained in the same moment (apps/studies/machine.hpp). Medians over the
/// pairs of one size, planner, sampler, pipeline and number of threads. Gains are times, scaled so that the fewest
/// threads gain their own number.
struct ThreadGain {
  MazeTrial first;          ///< of the pairs' runs with more threads
  std::size_t pairs = 0;    ///< >= 1
  double gain = 0.0;        ///< of solve_s
  double arithmetic = 0.0;  ///< the machine's own
  /// Pairs in which arithmetic gained as many times as there are threads, or cores, if these are fewer; within 5 %.
  std::size_t quiet_pairs = 0;
  std::optional<double> quiet_gain = {};                          ///< their median
  std::vector<std::pair<std::string, double>> quiet_stages = {};  ///< the same of each stage of at least 0.2 ms
};

/// In the order in which they first ran; solved runs only. cores: those of the machine.
std::vector<ThreadGain> thread_gains(const ScalingResult& result, unsigned cores);

/// "1000 x 1000, prm, tiled, lattice sampler, 2 threads: 1.85 times as fast as one (median of 15 pairs of runs),
/// arithmetic alone 1.97 times; ..."
std::string text_of(const ThreadGain& gain);

/// A table, warren.scale/1, and CSV with a run a line.
std::string scaling_summary(const ScalingResult& result, const Palette& palette);
std::string scaling_json(const ScalingOptions& options, const ScalingResult& result);
std::string scaling_csv(const ScalingResult& result);
/// A self-contained HTML page: plots drawn in it, no script, nothing loaded from anywhere.
std::string scaling_page(const ScalingResult& result, const std::string& command_line);

}  // namespace warren::studies
