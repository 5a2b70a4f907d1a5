// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/run_of_verb.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <limits>

#include "core/base/printable.hpp"
#include "scenes/text/output_file_io.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/last_words.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/signals.hpp"
#include "tools/screen/trace_json.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

constexpr std::array<std::string_view, 3> color_words{"auto", "always", "never"};
constexpr std::array<std::string_view, 4> progress_words{"auto", "bar", "plain", "none"};

constexpr OptionSpec run_specs[] = {
    {"--threads", "N", "threads to compute on; changes the time, never the result (default: all)"},
    {"--budget", "TIME", "stop after this time, such as 20s or 500ms: exit code 124 (default: none)"},
    {"--memory", "BYTES", "hold at most so much memory, such as 20GiB (default: what the machine has)"},
    {"--quiet", "", "print nothing but what was asked for"},
    {"--progress", "MODE", "how to show progress on standard error (default: auto)", "auto bar plain none"},
    {"--color", "WHEN", "colour the output (default: auto)", "auto always never"},
    {"--trace", "FILE", "write when each stage and chunk ran, as a Chrome trace"},
};

Deadline deadline_of(const Arguments& arguments, RunScope scope) {
  const auto budget = scope == RunScope::each_run ? std::nullopt : arguments.value("--budget");
  const auto memory = arguments.value("--memory");
  const double seconds = budget ? duration_value("--budget", *budget) : std::numeric_limits<double>::infinity();
  const std::size_t bytes = memory ? memory_value("--memory", *memory) : available_bytes();
  return Deadline(seconds, bytes, &signal_flag());
}

ProgressMode progress_mode(const Arguments& arguments, bool quiet) {
  const auto word = arguments.value("--progress");
  if (word) return static_cast<ProgressMode>(choice_value("--progress", *word, progress_words));
  return quiet ? ProgressMode::none : ProgressMode::automatic;
}

ColorMode color_mode(const Arguments& arguments) {
  const auto word = arguments.value("--color");
  return word ? static_cast<ColorMode>(choice_value("--color", *word, color_words)) : ColorMode::automatic;
}

}  // namespace

std::span<const OptionSpec> run_option_specs() { return run_specs; }

unsigned threads_value(std::string_view text) {
  constexpr std::uint64_t most_threads = 1024;
  return static_cast<unsigned>(count_value("--threads", text, 1, most_threads));
}

Run::Run(const Arguments& arguments, RunScope scope)
    : deadline_(deadline_of(arguments, scope)),
      quiet_(arguments.has("--quiet")),
      mode_(progress_mode(arguments, quiet_)),
      palette_(wants_color(STDOUT_FILENO, color_mode(arguments))) {
  const auto threads = arguments.value("--threads");
  if (threads && scope == RunScope::whole_command) execution_.threads = threads_value(*threads);
  if (const auto file = output_file(arguments, "--trace")) {
    trace_file_ = *file;
    trace_.emplace();
    execution_.trace = &*trace_;
  }
  execution_.deadline = &deadline_;
  execution_.progress = &progress_;
  bar_ = std::make_unique<ProgressBar>(progress_, mode_);
}

void Run::note(std::string_view line) const {
  if (mode_ == ProgressMode::none) return;
  say_on_standard_error(fmt::format("{}{}\n", resolved(mode_) == ProgressMode::bar ? "\r\x1b[K" : "", printable(line)));
}

void Run::end() {
  bar_.reset();
  if (execution_.trace == nullptr) return;
  execution_.trace = nullptr;
  write_file(trace_file_, trace_json(*trace_), Execution{});
}

int exit_code_of(StopReason reason) {
  switch (reason) {
    case StopReason::interrupt:
      return exit_code::interrupted;
    case StopReason::terminate:
      return exit_code::terminated;
    case StopReason::hang_up:
      return exit_code::hung_up;
    default:
      return exit_code::budget;
  }
}

std::string_view text_of(StopReason reason) {
  switch (reason) {
    case StopReason::time:
      return "the time budget ended";
    case StopReason::memory:
      return "it needs more memory than it may hold";
    case StopReason::interrupt:
      return "interrupted";
    case StopReason::hang_up:
      return "the terminal was closed";
    default:
      return "terminated";
  }
}

void say_stopped(StopReason reason) { fmt::print(stderr, "warren: stopped: {}\n", text_of(reason)); }

std::string_view signal_name(StopReason reason) {
  if (reason == StopReason::hang_up) return "SIGHUP";
  return reason == StopReason::terminate ? "SIGTERM" : "SIGINT";
}

}  // namespace warren
