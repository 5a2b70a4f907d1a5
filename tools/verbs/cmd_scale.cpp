// SPDX-License-Identifier: BSD-3-Clause
// warren scale: how time, memory and work grow with the size of the maze and shrink with threads.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/base/error.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question.hpp"
#include "studies/sizes/scaling_report.hpp"
#include "studies/sizes/scaling_study.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/words/command.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

constexpr OptionSpec study_specs[] = {
    {"--sizes", "LIST", "mazes, N for N x N or ROWSxCOLS, apart by commas (default: 100,316,1000)"},
    {"--threads", "LIST", "numbers of threads, apart by commas (default: 1 and all)"},
    {"--planners", "LIST", "planners of 'solve', apart by commas (default: as 'solve' chooses)"},
    {"--samplers", "LIST",
     "samplers of 'solve', apart by commas; each planner takes each (default: as 'solve' chooses)"},
    {"--seeds", "LIST", "seeds of the mazes and of their sampling, apart by commas (default: 1)"},
    {"--repeats", "N", "how often each run is made; they alternate with the others (default: 3)"},
    {"--budget", "TIME", "each run may take so long from walls in memory to path verified (default: none)"},
    {"--json", "FILE", "write warren.scale/1; - is standard output"},
    {"--csv", "FILE", "write a line a run; - is standard output"},
    {"--html", "FILE", "write a page with plots that needs no network; - is standard output"},
};
constexpr std::array<std::string_view, 3> dealt_out{"--planner", "--sampler", "--seed"};
constexpr std::array<std::string_view, 1> own_seed{"--seed"};

/// The words of a list; no list is an empty one.
std::vector<std::string> words_of(const Arguments& arguments, std::string_view option) {
  const auto text = arguments.value(option);
  return text ? list_value(option, *text) : std::vector<std::string>{};
}

std::pair<std::uint32_t, std::uint32_t> size_value(const std::string& word) {
  constexpr std::uint64_t most = 0xffffffff;
  const std::size_t by = word.find('x');
  const std::uint64_t rows = count_value("--sizes", word.substr(0, by), 1, most);
  const std::uint64_t cols = by == std::string::npos ? rows : count_value("--sizes", word.substr(by + 1), 1, most);
  if (rows > most / cols) throw UsageError(fmt::format("--sizes: {} has 2^32 cells or more", word));
  return {static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(cols)};
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes_of(const Arguments& arguments) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes;
  for (const std::string& word : words_of(arguments, "--sizes")) sizes.push_back(size_value(word));
  if (sizes.empty()) sizes = {{100, 100}, {316, 316}, {1000, 1000}};
  std::stable_sort(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) {
    return std::uint64_t{a.first} * a.second < std::uint64_t{b.first} * b.second;
  });
  return sizes;
}

std::vector<unsigned> threads_of(const Arguments& arguments) {
  std::vector<unsigned> threads;
  for (const std::string& word : words_of(arguments, "--threads")) threads.push_back(threads_value(word));
  if (threads.empty()) threads = thread_count(0) > 1 ? std::vector{1U, thread_count(0)} : std::vector{1U};
  std::sort(threads.begin(), threads.end());
  return threads;
}

/// The options of `solve` that one planner and sampler makes; checked as `solve` checks them.
Arguments solve_arguments(const Arguments& given, const std::string& planner, const std::string& sampler) {
  const Command solve{"scale", "", "", trial_solve_specs(own_seed), {}};
  std::vector<std::string> words;
  for (const OptionSpec& option : trial_solve_specs(dealt_out)) {
    if (!given.has(option.name)) continue;
    words.emplace_back(option.name);
    if (!option.value.empty()) words.push_back(*given.value(option.name));
  }
  if (!planner.empty()) words.insert(words.end(), {"--planner", planner});
  if (!sampler.empty()) words.insert(words.end(), {"--sampler", sampler});
  Arguments arguments(solve, words);
  check_planner_options(arguments);
  return arguments;
}

std::vector<Arguments> planners_of(const Arguments& arguments) {
  std::vector<std::string> planners = words_of(arguments, "--planners");
  std::vector<std::string> samplers = words_of(arguments, "--samplers");
  if (planners.empty()) planners.emplace_back();
  if (samplers.empty()) samplers.emplace_back();
  std::vector<Arguments> all;
  for (const std::string& planner : planners) {
    for (const std::string& sampler : samplers) all.push_back(solve_arguments(arguments, planner, sampler));
  }
  return all;
}

ScalingOptions scaling_options(const Arguments& arguments) {
  constexpr std::uint64_t most_repeats = 1000;
  ScalingOptions options;
  options.sizes = sizes_of(arguments);
  options.threads = threads_of(arguments);
  options.planners = planners_of(arguments);
  for (const std::string& word : words_of(arguments, "--seeds")) {
    options.seeds.push_back(count_value("--seeds", word, 0, std::numeric_limits<std::uint64_t>::max()));
  }
  if (options.seeds.empty()) options.seeds = {1};
  if (const auto repeats = arguments.value("--repeats")) {
    options.repeats = static_cast<unsigned>(count_value("--repeats", *repeats, 1, most_repeats));
  }
  const auto budget = arguments.value("--budget");
  options.budget_s = budget ? duration_value("--budget", *budget) : std::numeric_limits<double>::infinity();
  options.maze = trial_maze(arguments);
  return options;
}

constexpr std::array<const char*, 3> output_options{"--json", "--csv", "--html"};

/// Throws unless every output can be written; says whether one of them takes standard output.
bool check_reports(const Arguments& arguments) {
  bool taken = false;
  for (const char* option : output_options) {
    const auto file = arguments.value(option);
    if (!file) continue;
    check_writable(*file);
    taken = taken || *file == "-";
  }
  return taken;
}

int exit_code(const ScalingResult& result) {
  if (result.signal) return exit_code_of(*result.signal);
  bool stopped = !result.ungenerated.empty();
  bool unsolved = false;
  for (const ScalingRun& run : result.runs) {
    stopped = stopped || run.trial.outcome == Outcome::stopped;
    unsolved = unsolved || !run.trial.verified;
  }
  if (stopped) return exit_code::budget;
  return unsolved ? exit_code::no_path : exit_code::success;
}

int scale(const Arguments& arguments) {
  const ScalingOptions options = scaling_options(arguments);
  problem_options(arguments);  // refuses impossible values now, not after a maze was made
  const bool standard_output_taken = check_reports(arguments);
  Run run(arguments, RunScope::each_run);
  const ScalingResult result = run_scaling_study(options, run);
  run.end();
  const auto write = [&](std::string_view option, const auto& text) {
    if (const auto file = arguments.value(option)) write_file(*file, text(), Execution{});
  };
  write("--json", [&] { return scaling_json(options, result); });
  write("--csv", [&] { return scaling_csv(result); });
  write("--html", [&] { return scaling_page(result, arguments.command_line()); });
  if (!run.quiet() && !standard_output_taken) {
    print_text(scaling_summary(result, run.palette()));
  } else if (result.signal) {
    say_stopped(*result.signal);
  }
  return exit_code(result);
}

}  // namespace

Command scale_command() {
  Command command{"scale", "", "measure time and memory against size and threads", {}, scale};
  add_options(command.options, study_specs);
  add_options(command.options, trial_maze_specs());
  add_options(command.options, trial_solve_specs(dealt_out));
  for (const OptionSpec& option : run_option_specs()) {
    if (option.name != "--budget" && option.name != "--threads") command.options.push_back(option);
  }
  return command;
}

}  // namespace warren
