// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/run_of_verb.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>

#include "core/base/printable.hpp"
#include "parallel/once.hpp"
#include "parallel/ticker.hpp"
#include "pictures/answer_summary.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/question/limits.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec run_specs[] = {
    {"--threads", "N",
     "how many threads to compute on; changes the time, never the result (default: one for each core)"},
    {"--budget", "TIME", "stop after this time, such as 20s or 500ms: exit code 124 (default: none)"},
    {"--memory", "BYTES", "hold at most so much memory, such as 20GiB (default: what the machine has)"},
    {"--quiet", "", "print nothing but what was asked for"},
    {"--progress", "MODE", "how to show progress on standard error (default: auto)", "auto bar plain none"},
    {"--color", "WHEN", "colour the output (default: auto)", "auto always never"},
    {"--trace", "FILE", "write what ran when on which thread, as a trace for Chrome or Perfetto"},
};

std::optional<double> budget_of(const Arguments& arguments, RunScope scope) {
  return scope == RunScope::whole_command ? given_value(arguments, "--budget", duration_value) : std::nullopt;
}

Deadline deadline_of(const Arguments& arguments, RunScope scope) {
  const std::optional<double> budget = budget_of(arguments, scope);
  const auto memory = given_value(arguments, "--memory", memory_value);
  return Deadline(budget.value_or(std::numeric_limits<double>::infinity()), memory ? *memory : available_bytes(),
                  &signal_flag());
}

using namespace std::chrono_literals;

std::string bar(double fraction, std::size_t width) {
  const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(width));
  std::string text(width, ' ');
  std::fill_n(text.begin(), filled, '=');
  if (filled < width) text[filled] = '>';
  return "[" + text + "]";
}

}  // namespace

std::string improvement_text(const Improvement& best) {
  std::string text = fmt::format("cost {}", human_number(best.cost));
  if (best.lower_bound > 0.0) {
    const double gap = std::max(0.0, best.cost / best.lower_bound - 1.0);
    text += fmt::format(", bound {}, gap {}", human_number(best.lower_bound), share_text(gap));
  }
  return text + fmt::format(", turn {}", best.iterations);
}

std::string progress_line(const RunMoment& moment, double items_per_s, std::string_view of_whole_run,
                          std::size_t width) {
  std::string line = fmt::format("{:<10}", moment.stage);
  std::string figures;
  double fraction = 0.0;
  if (moment.total > 0) {
    fraction = std::min(1.0, static_cast<double>(moment.done) / static_cast<double>(moment.total));
    figures += fmt::format(" {:3.0f} %", 100.0 * fraction);
    if (items_per_s > 0.0 && moment.done < moment.total) {
      const auto left = static_cast<double>(moment.total - moment.done);
      figures += fmt::format("  {}/s  {} left of it", human_count(items_per_s), human_seconds(left / items_per_s));
    }
  } else if (items_per_s > 0.0) {
    figures = fmt::format(" {}  {}/s", human_count(static_cast<double>(moment.done)), human_count(items_per_s));
  }
  if (!of_whole_run.empty()) figures += fmt::format("{}{}", figures.empty() ? " " : ", ", of_whole_run);
  constexpr std::size_t widest_bar = 40;
  const std::size_t used = line.size() + figures.size() + 3;
  if (moment.total > 0 && used + 8 < width) line += bar(fraction, std::min(widest_bar, width - used));
  line += figures;
  if (line.size() >= width) line.resize(width - 1);
  return line;
}

class ProgressBar : NotCopied {
 public:
  /// Watches `progress` until destroyed. Mode none draws nothing and starts no thread. budget_s: of the run, from now
  /// on.
  ProgressBar(const Progress& progress, ProgressMode mode, std::optional<double> budget_s, ExpectedStages stages)
      : progress_(progress), mode_(resolved(mode)), budget_s_(budget_s), whole_(stages), stage_begin_(begin_) {
    if (mode_ == ProgressMode::none) return;
    const auto period = mode_ == ProgressMode::bar ? 100ms : 2000ms;
    ticker_ = std::make_unique<Ticker>(1000ms, period, [this] { draw(); });
  }
  ~ProgressBar() {
    ticker_.reset();
    if (columns_ > 0 && mode_ == ProgressMode::bar) std::fputs(erasing(columns_, terminal_width()).c_str(), stderr);
  }

  /// From now on the line says what the best path costs. Any thread.
  void tell(const Improvement& improvement) {
    best_.use([&](auto& best) { best = improvement; });
  }

 private:
  void draw() {
    const char* stage = progress_.stage();
    if (stage == nullptr) return;
    const auto now = std::chrono::steady_clock::now();
    const std::uint64_t done = progress_.done();
    if (stage != stage_ || done < done_at_begin_) {
      stage_ = stage;
      stage_begin_ = now;
      done_at_begin_ = done;
    }
    const double seconds = std::chrono::duration<double>(now - stage_begin_).count();
    const double rate = seconds > 0.0 ? static_cast<double>(done - done_at_begin_) / seconds : 0.0;
    const std::size_t width = terminal_width();
    RunMoment moment{stage, done, progress_.total(), std::chrono::duration<double>(now - begin_).count()};
    std::string whole_run = whole_run_text(moment, rate);
    const std::optional<Improvement> best = best_.use([](auto& now) { return now; });
    if (best && moment.stage == "search") {
      whole_run = improvement_text(*best) + (whole_run.empty() ? "" : ", " + whole_run);
    }
    const std::string line = progress_line(moment, rate, whole_run, width);
    std::fputs((mode_ == ProgressMode::bar ? erasing(columns_, width) + line : line + "\n").c_str(), stderr);
    std::fflush(stderr);
    columns_ = line.size();
  }
  std::string whole_run_text(const RunMoment& moment, double items_per_s) {
    auto left = whole_.seconds_left(moment);
    if (left && items_per_s > 0.0 && moment.done < moment.total) {
      left = std::max(*left, static_cast<double>(moment.total - moment.done) / items_per_s);  // no less than the stage
    }
    if (left && !(budget_s_ && *budget_s_ - moment.seconds < *left)) {
      return fmt::format("about {} left in all", human_seconds(*left));
    }
    if (!budget_s_) return {};
    return fmt::format("--budget ends in {}", human_seconds(std::max(0.0, *budget_s_ - moment.seconds)));
  }

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

/// The stage of the moment, or a later one that has begun.
bool WholeRun::enter(const RunMoment& moment) {
  const auto is_it = [&](const ExpectedStage& one) { return one.stage == moment.stage; };
  const auto here = stages_.begin() + static_cast<std::ptrdiff_t>(stage_);
  const auto found = std::find_if(here, stages_.end(), is_it);
  if (found == stages_.end()) {
    is_lost_ = has_begun_;
    began_s_ = moment.seconds;
    return false;
  }
  has_begun_ = true;
  if (found == here) return true;
  for (auto over = here; over != found; ++over) before_ += over->share;
  stage_ = static_cast<std::size_t>(found - stages_.begin());
  stage_began_s_ = moment.seconds;
  return true;
}

std::optional<double> WholeRun::part_done(const RunMoment& moment) {
  if (is_lost_ || !enter(moment)) return std::nullopt;
  double all = 0.0;
  for (const ExpectedStage& stage : stages_) all += stage.share;
  const double share = stages_[stage_].share;
  double part = 0.0;
  if (moment.total > 0) {
    part = std::min(1.0, static_cast<double>(moment.done) / static_cast<double>(moment.total));
  } else if (before_ > 0.0) {
    constexpr double too_long = 1.5;
    const double takes_s = (stage_began_s_ - began_s_) / before_ * share;
    part = (moment.seconds - stage_began_s_) / takes_s;
    if (!(part <= too_long)) return std::nullopt;
    part = std::min(1.0, part);
  }
  part_ = std::max(part_, (before_ + part * share) / all);
  return part_;
}

std::optional<double> WholeRun::seconds_left(const RunMoment& moment) {
  constexpr double tells_enough = 0.05;
  const auto part = part_done(moment);
  if (!part || *part < tells_enough) return std::nullopt;
  return (moment.seconds - began_s_) * (1.0 - *part) / *part;
}

std::string erasing(std::size_t columns, std::size_t width) {
  const std::size_t rows_above = columns == 0 ? 0 : (columns - 1) / std::max<std::size_t>(width, 1);
  return rows_above == 0 ? "\r\x1b[K" : fmt::format("\r\x1b[{}A\x1b[J", rows_above);
}

std::span<const OptionSpec> run_option_specs() { return run_specs; }

unsigned threads_value(std::string_view option, std::string_view text) {
  return static_cast<unsigned>(count_value(option, text, 1, most_threads));
}

Run::Run(const Arguments& arguments, RunScope scope, ExpectedStages stages)
    : deadline_(deadline_of(arguments, scope)),
      last_deadline_(std::numeric_limits<double>::infinity(), deadline_.memory_bytes(), &signal_flag()),
      quiet_(arguments.has("--quiet")),
      standard_output_taken_(takes_standard_output(arguments)),
      mode_(given_choice<ProgressMode>(arguments, "--progress")
                .value_or(quiet_ ? ProgressMode::none : ProgressMode::automatic)),
      palette_(
          wants_color(STDOUT_FILENO, given_choice<ColorMode>(arguments, "--color").value_or(ColorMode::automatic))) {
  if (scope != RunScope::each_run_and_threads) {
    execution_.threads = given_value(arguments, "--threads", threads_value).value_or(execution_.threads);
  }
  if (const auto file = output_file(arguments, "--trace")) {
    trace_file_ = *file;
    trace_.emplace();
    execution_.trace = &*trace_;
  }
  execution_.deadline = &deadline_;
  execution_.progress = &progress_;
  bar_ = std::make_unique<ProgressBar>(progress_, mode_, budget_of(arguments, scope), stages);
  if (resolved(mode_) == ProgressMode::none) return;
  on_improvement_ = [this](const Improvement& improvement) {
    if (bar_) bar_->tell(improvement);
    return true;
  };
  execution_.on_improvement = &on_improvement_;
}

Run::~Run() = default;

void Run::note(std::string_view line) const {
  if (mode_ == ProgressMode::none) return;
  say_on_standard_error(fmt::format("{}{}\n", resolved(mode_) == ProgressMode::bar ? "\r\x1b[K" : "", printable(line)));
}

void Run::conclude(const std::function<std::string()>& summary, std::optional<StopReason> stopped) {
  end();
  if (!quiet_ && !standard_output_taken_) return print_text(summary());
  if (stopped) fmt::print(stderr, "warren: stopped: {}\n", stop_text(*stopped, deadline_.wanted_bytes()));
}

Execution Run::execution_for_what_is_left(bool has_used_its_time) {
  if (!has_used_its_time && !deadline_.reached()) return execution_;
  forget_signal();
  Execution left = execution_;
  left.deadline = &last_deadline_;
  return left;
}

void Run::end() {
  bar_.reset();
  if (execution_.trace == nullptr) return;
  execution_.trace = nullptr;
  write_file(trace_file_, trace_json(*trace_), Execution{});
}

int exit_code_of(StopReason reason) {
  return reason == StopReason::interrupt   ? exit_code::interrupted
         : reason == StopReason::terminate ? exit_code::terminated
         : reason == StopReason::hang_up   ? exit_code::hung_up
                                           : exit_code::budget;
}

std::string trace_json(const Trace& trace) {
  std::string text = R"({"displayTimeUnit":"ms","otherData":{"version":"warren )" WARREN_VERSION R"("},"traceEvents":[
{"name":"process_name","ph":"M","pid":1,"tid":0,"args":{"name":"warren"}})";
  for (std::size_t thread = 0; thread < trace.thread_count(); ++thread) {
    fmt::format_to(std::back_inserter(text),
                   ",\n"
                   R"({{"name":"thread_name","ph":"M","pid":1,"tid":{0},"args":{{"name":"{1} {0}"}}}})",
                   thread, thread == 0 ? "main" : "worker");
  }
  for (const Trace::Event& event : trace.events()) {
    // Ends are rounded as beginnings are, so that what lies inside another event still does.
    const std::int64_t begin_ns = std::llround(1e3 * event.begin_us);
    const std::int64_t end_ns = std::llround(1e3 * (event.begin_us + event.duration_us));
    fmt::format_to(std::back_inserter(text),
                   ",\n"
                   R"({{"name":"{}","cat":"{}","ph":"X","ts":{:.3f},"dur":{:.3f},"pid":1,"tid":{}{}}})",
                   event.name, event.is_stage ? "stage" : "chunk", 1e-3 * static_cast<double>(begin_ns),
                   1e-3 * static_cast<double>(end_ns - begin_ns), event.thread,
                   event.items > 0 ? fmt::format(R"(,"args":{{"items":{}}})", event.items) : "");
  }
  return text + "\n]}\n";
}

}  // namespace warren::tools
