// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/run_of_verb.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>

#include "core/base/printable.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/question/limits.hpp"
#include "tools/screen/exit_code.hpp"
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

/// Of the whole command.
std::optional<double> budget_of(const Arguments& arguments, RunScope scope) {
  return scope == RunScope::whole_command ? given_value(arguments, "--budget", duration_value) : std::nullopt;
}

Deadline deadline_of(const Arguments& arguments, RunScope scope) {
  const std::optional<double> budget = budget_of(arguments, scope);
  const auto memory = given_value(arguments, "--memory", memory_value);
  return Deadline(budget.value_or(std::numeric_limits<double>::infinity()), memory ? *memory : available_bytes(),
                  &signal_flag());
}

}  // namespace

std::span<const OptionSpec> run_option_specs() { return run_specs; }

unsigned threads_value(std::string_view option, std::string_view text) {
  return static_cast<unsigned>(count_value(option, text, 1, most_threads));
}

Run::Run(const Arguments& arguments, RunScope scope, ExpectedStages stages)
    : deadline_(deadline_of(arguments, scope)),
      last_deadline_(std::numeric_limits<double>::infinity(), deadline_.memory_bytes(), &signal_flag()),
      quiet_(arguments.has("--quiet")),
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

void Run::note(std::string_view line) const {
  if (mode_ == ProgressMode::none) return;
  say_on_standard_error(fmt::format("{}{}\n", resolved(mode_) == ProgressMode::bar ? "\r\x1b[K" : "", printable(line)));
}

void Run::conclude(bool standard_output_taken, std::optional<StopReason> stopped,
                   const std::function<std::string()>& summary) const {
  if (!quiet_ && !standard_output_taken) return print_text(summary());
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
