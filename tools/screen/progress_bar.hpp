// SPDX-License-Identifier: BSD-3-Clause
// Draws how far the work is on standard error: stage, per cent, rate, time left of it and of the whole. Nothing is
// drawn for work that ends within a second; at most ten times a second after that; the line is cleared at the end.
// Plain mode writes a line of its own every two seconds and never erases.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/solution.hpp"
#include "core/run/execution.hpp"
#include "parallel/once.hpp"
#include "parallel/ticker.hpp"
#include "tools/screen/exit_code.hpp"

namespace warren::tools {

/// A stage that a run will come to, and its share of the run's time, in any unit.
struct ExpectedStage {
  std::string_view stage;
  double share;
};
using ExpectedStages = std::span<const ExpectedStage>;

/// What is seen of a run at a moment.
struct RunMoment {
  std::string_view stage;
  std::uint64_t done = 0;
  std::uint64_t total = 0;  ///< 0: not known
  double seconds = 0.0;     ///< since the run began
};

/// How long a whole run will still take, where its stages and their shares of the time are known: the time that has
/// passed tells how fast this machine is. Nothing is said where a stage comes that was not expected, where one takes
/// half as long again as its share, and before a twentieth is done. Asked in the order of time. What comes before the
/// first of the stages is not counted.
class WholeRun {
 public:
  /// All stages to come, in their order; they outlive it. None: nobody knows.
  explicit WholeRun(ExpectedStages stages) : stages_(stages) {}

  /// The part of the run that is done, never less than it was before; none: nobody knows.
  std::optional<double> part_done(const RunMoment& moment);
  /// Of the wall clock.
  std::optional<double> seconds_left(const RunMoment& moment);

 private:
  bool enter(const RunMoment& moment);

  ExpectedStages stages_;
  bool has_begun_ = false;
  bool is_lost_ = false;  // a stage came that was not expected
  double began_s_ = 0.0;  // the first of the stages, or what is seen of the run
  std::size_t stage_ = 0;
  double stage_began_s_ = 0.0;
  double before_ = 0.0;  // shares of the stages that are over
  double part_ = 0.0;
};

class ProgressBar : NotCopied {
 public:
  /// Watches `progress` until destroyed. Mode none draws nothing and starts no thread. budget_s: of the run, from now
  /// on.
  ProgressBar(const Progress& progress, ProgressMode mode, std::optional<double> budget_s = {},
              ExpectedStages stages = {});
  ~ProgressBar();

  /// From now on the line says what the best path costs. Any thread.
  void tell(const Improvement& improvement);

 private:
  void draw();

  std::string whole_run_text(const RunMoment& moment, double items_per_s);

  const Progress& progress_;
  ProgressMode mode_;
  std::optional<double> budget_s_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  WholeRun whole_;
  const char* stage_ = nullptr;  // of the last drawing; rate and time left start anew with each stage
  std::chrono::steady_clock::time_point stage_begin_;
  std::uint64_t done_at_begin_ = 0;
  std::size_t columns_ = 0;  // of what stands on the screen
  Guarded<std::optional<Improvement>> best_;
  std::unique_ptr<Ticker> ticker_;
};

/// "cost 12.34, bound 11.93, gap 3.4 %, turn 120"; without bound and gap where nothing is proved.
std::string improvement_text(const Improvement& best);

/// What erases so many columns that stand on a screen `width` columns wide: more rows than one where it has become
/// narrower meanwhile.
std::string erasing(std::size_t columns, std::size_t width);

/// One line: "connect  [=====>    ]  43 %  12.3 M/s  3 s left of it", at most `width` columns: how long the stage will
/// take; behind it what is known of the whole run.
std::string progress_line(const RunMoment& moment, double items_per_s, std::string_view of_whole_run,
                          std::size_t width);

}  // namespace warren::tools
