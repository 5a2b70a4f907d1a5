// SPDX-License-Identifier: BSD-3-Clause
// The log that OMPL's benchmarks write, line by line as ompl_benchmark_statistics.py reads it: run lines are split at
// "; ", so each value is followed by one, and an empty value is NULL. One status more than OMPL knows stands last.
#include <fmt/format.h>

#include <array>
#include <iterator>

#include "core/base/printable.hpp"
#include "studies/compare/comparison_report.hpp"
#include "studies/measure/machine_memory.hpp"

namespace warren::studies {
namespace {

constexpr std::string_view statuses =
    "status|Unknown status|Invalid start|Invalid goal|Unrecognized goal type|Timeout|Approximate solution|"
    "Exact solution|Crash|Abort|Infeasible|Not connected";

int status_of(Outcome outcome) {
  constexpr std::array<int, 6> by_outcome{6, 1, 2, 10, 9, 4};
  return by_outcome[static_cast<std::size_t>(outcome)];
}

std::string planner_name(const Contender& contender) {
  std::string name = contender.library + "_" + contender_name(contender, true);
  for (const auto& [option, value] : contender.options) name += "_" + option + "_" + value;
  std::string word;
  for (const char c : name) {
    const bool kept =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
    if (kept) {
      word += c;
    } else if (!word.ends_with('_')) {
      word += '_';
    }
  }
  return word;
}

constexpr std::string_view properties =
    "10 properties for each run\n"
    "status ENUM\ntime REAL\nsolved BOOLEAN\ncorrect solution BOOLEAN\nsolution length REAL\nsolution clearance REAL\n"
    "solution segments INTEGER\nstates expanded INTEGER\nsearch time REAL\nseed INTEGER\n";

std::string run_line(const ComparedRun& run) {
  const auto known = [](bool is_known, auto value) { return is_known ? fmt::format("{}", value) : std::string{}; };
  const int solved = run.solved() ? 1 : 0;
  return fmt::format("{}; {}; {}; {}; {}; {}; {}; {}; {}; {}; \n", status_of(run.outcome), run.time_s, solved, solved,
                     known(run.solved(), run.length),
                     known(run.solved() && run.min_clearance, run.min_clearance.value_or(0.0)),
                     known(run.solved(), run.hops), run.expanded,
                     known(run.search_s.has_value(), run.search_s.value_or(0.0)), run.seed);
}

std::string planner_block(const Contender& contender) {
  std::string text = planner_name(contender) + "\n";
  text += fmt::format("{} common properties\n", contender.options.size());
  for (const auto& [name, value] : contender.options) text += fmt::format("{} = {}\n", name, printable(value));
  text += properties;
  text += fmt::format("{} runs\n", contender.runs.size());
  for (const ComparedRun& run : contender.runs) text += run_line(run);
  return text + ".\n";
}

}  // namespace

std::string ompl_log(const Comparison& comparison, const OmplExperiment& experiment) {
  std::size_t most_runs = 0;
  for (const Contender& c : comparison.contenders) most_runs = std::max(most_runs, c.runs.size());
  std::string text =
      fmt::format("warren version {}\nExperiment {}\nRunning on {}\nStarting at {}\n<<<|\n{}\n|>>>\n<<<|\n{}\n|>>>\n",
                  WARREN_VERSION, printable(experiment.name), experiment.hostname, experiment.date,
                  printable(experiment.setup), text_of(this_machine()));
  fmt::format_to(std::back_inserter(text),
                 "{} is the random seed\n{} seconds per run\n{} MB per run\n{} runs per planner\n"
                 "{} seconds spent to collect the data\n1 enum type\n{}\n{} planners\n",
                 experiment.seed, experiment.budget_s, experiment.memory_mb, most_runs, experiment.total_s, statuses,
                 comparison.contenders.size());
  for (const Contender& c : comparison.contenders) text += planner_block(c);
  return text;
}

}  // namespace warren::studies
