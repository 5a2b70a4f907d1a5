// SPDX-License-Identifier: BSD-3-Clause
// How a verb runs: threads, budget, memory, progress, trace. The options that every working verb shares, and the
// Execution that they make.
//
// The bar draws how far the work is on standard error: stage, per cent, rate, time left of it and of the whole. Nothing
// is drawn for work that ends within a second; at most ten times a second after that; the line is cleared at the end.
// Plain mode writes a line of its own every two seconds and never erases.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/page_pool.hpp"
#include "core/run/execution.hpp"
#include "core/run/trace.hpp"
#include "scenes/text/human_units.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

/// --threads --budget --memory --quiet --progress --color --trace
std::span<const OptionSpec> run_option_specs();

/// How many threads one word of --threads asks for; throws UsageError.
unsigned threads_value(std::string_view option, std::string_view text);

/// What --budget is about: the whole command, or each of the runs that the verb makes (which then deals it out itself);
/// with each_run_and_threads --threads is dealt out, too.
enum class RunScope : std::uint8_t { whole_command, each_run, each_run_and_threads };

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

/// What erases so many columns that stand on a screen `width` columns wide: more rows than one where it has become
/// narrower meanwhile.
std::string erasing(std::size_t columns, std::size_t width);

/// "cost 12.34, bound 11.93, gap 3.4 %, turn 120"; without bound and gap where nothing is proved.
std::string improvement_text(const Improvement& best);

/// One line: "connect  [=====>    ]  43 %  12.3 M/s  3 s left of it", at most `width` columns: how long the stage will
/// take; behind it what is known of the whole run.
std::string progress_line(const RunMoment& moment, double items_per_s, std::string_view of_whole_run,
                          std::size_t width);

class ProgressBar;

/// One run of a verb: the clock starts with it. Not movable: Execution points into it.
class Run : NotCopied {
 public:
  /// stages: all to come, where they are known, so that the bar tells how long the whole run will take.
  explicit Run(const Arguments& arguments, RunScope scope = RunScope::whole_command, ExpectedStages stages = {});
  ~Run();

  const Execution& execution() const { return execution_; }
  bool quiet() const { return quiet_; }
  const Palette& palette() const { return palette_; }
  unsigned threads() const { return thread_count(execution_.threads); }
  /// What work() gives, as a stage of that name with so many items, 0: not known. Its time is added to *seconds, where
  /// somebody asks.
  template <class Work>
  auto in_stage(const char* name, double* seconds, const Work& work, std::uint64_t items = 0) const {
    const StageTimer timer(execution_, name, seconds, items);
    return work();
  }
  /// Says one line on standard error, above the bar; nothing with --quiet or --progress none.
  void note(std::string_view line) const;
  /// Ends the run and prints the summary; where --quiet or an output on standard output forbids that, says on standard
  /// error what stopped the verb, if anything did.
  void conclude(const std::function<std::string()>& summary, std::optional<StopReason> stopped = {});
  /// Where the answer is there in time and what came after it was stopped: for writing it, which a further signal or
  /// the memory alone ends; else execution().
  /// Or where the answer used its time by its nature.
  Execution execution_for_what_is_left(bool has_used_its_time = false);
  /// Gives back the pages that stages left: for a verb that stays. On the thread that made the run.
  void give_back_pages() { pages_.reset(); }
  /// Ends the progress bar and writes the trace, if one was asked for; further calls do nothing.
  void end();

 private:
  std::optional<PagePool> pages_{std::in_place};  // what one stage leaves is warm for the next
  Deadline deadline_;
  Deadline last_deadline_;  // without the budget
  Progress progress_;
  std::optional<Trace> trace_;
  std::string trace_file_;
  bool quiet_ = false;
  bool standard_output_taken_;
  ProgressMode mode_;
  Palette palette_{false};
  std::function<bool(const Improvement&)> on_improvement_;  // tells the bar
  Execution execution_;
  std::unique_ptr<ProgressBar> bar_;
};

/// 124 for a budget, 129, 130 and 143 for signals.
int exit_code_of(StopReason reason);

/// A Trace as Chrome trace events, for chrome://tracing and ui.perfetto.dev: complete events ("X"), microseconds.
std::string trace_json(const Trace& trace);

}  // namespace warren::tools
