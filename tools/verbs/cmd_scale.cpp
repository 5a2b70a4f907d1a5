// SPDX-License-Identifier: BSD-3-Clause
// warren scale: how time, memory and work grow with the size of the maze and shrink with threads.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "apps/studies/scaling_study.hpp"
#include "core/base/error.hpp"
#include "solve/question/planner_choice.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/words/command.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/planner_words.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec study_specs[] = {
    {"--sizes", "LIST", "sizes of mazes, N for N x N or ROWSxCOLS, separated by commas (default: 100,316,1000)"},
    {"--threads", "LIST", "numbers of threads, separated by commas (default: 1 and all cores)"},
    {"--planners", "LIST", "planners to measure, separated by commas (default: as 'solve' chooses)"},
    {"--samplers", "LIST", "samplers, separated by commas; each planner runs with each (default: as 'solve' chooses)"},
    {"--seeds", "LIST", "seeds of the mazes and of their samples, separated by commas (default: 1)"},
    {"--repeats", "N", "how often each run is made, by turns with the others (default: 3)"},
    {"--budget", "TIME", "most time for each run, from walls in memory to the verified path (default: none)"},
    {"--json", "FILE", "write all figures as JSON; - is standard output"},
    {"--csv", "FILE", "write a line for each run, as CSV; - is standard output"},
    {"--html", "FILE", "write a page with plots that needs no network; - is standard output"},
};

/// Rows and columns.
using Size = std::pair<std::uint32_t, std::uint32_t>;

Size size_value(std::string_view option, std::string_view word) {
  constexpr std::uint64_t most = 0xffffffff;
  const std::size_t by = word.find('x');
  const std::uint64_t rows = count_value(option, word.substr(0, by), 1, most);
  const std::uint64_t cols = by == std::string_view::npos ? rows : count_value(option, word.substr(by + 1), 1, most);
  if (rows > most / cols) throw UsageError(fmt::format("{}: {} has 2^32 cells or more", option, word));
  return {static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(cols)};
}

std::vector<Size> sizes_of(const Arguments& arguments) {
  std::vector<Size> sizes = given_values(arguments, "--sizes", "--sizes", size_value);
  if (sizes.empty()) sizes = {{100, 100}, {316, 316}, {1000, 1000}};
  std::stable_sort(sizes.begin(), sizes.end(), [](const Size& a, const Size& b) {
    return std::uint64_t{a.first} * a.second < std::uint64_t{b.first} * b.second;
  });
  return sizes;
}

std::vector<unsigned> threads_of(const Arguments& arguments) {
  std::vector<unsigned> threads = given_values(arguments, "--threads", "--threads", threads_value);
  if (threads.empty()) threads = thread_count(0) > 1 ? std::vector{1U, thread_count(0)} : std::vector{1U};
  std::sort(threads.begin(), threads.end());
  return threads;
}

/// Every planner with every sampler, and all with the other options; checked as `solve` checks them.
std::vector<SolveOptions> planners_of(const Arguments& arguments) {
  const SolveOptions common = solve_words(arguments);
  const auto planners = given_values(arguments, "--planners", "--planner", choice_value<PlannerKind>);
  const auto samplers = given_values(arguments, "--samplers", "--sampler", choice_value<SamplerKind>);
  std::vector<SolveOptions> all;
  for (std::size_t p = 0; p < std::max<std::size_t>(1, planners.size()); ++p) {
    for (std::size_t s = 0; s < std::max<std::size_t>(1, samplers.size()); ++s) {
      all.push_back(common);
      if (!planners.empty()) all.back().planner = planners[p];
      if (!samplers.empty()) all.back().sampler = samplers[s];
      check_planner_options(all.back());
    }
  }
  return all;
}

studies::ScalingOptions scaling_options(const Arguments& arguments) {
  constexpr std::uint32_t most_repeats = 1000;
  studies::ScalingOptions options;
  options.sizes = sizes_of(arguments);
  options.threads = threads_of(arguments);
  options.planners = planners_of(arguments);
  options.seeds = given_values(arguments, "--seeds", "--seeds", seed_value);
  if (options.seeds.empty()) options.seeds = {1};
  options.repeats = given_count(arguments, "--repeats", 1, most_repeats).value_or(options.repeats);
  const double endless = std::numeric_limits<double>::infinity();
  options.budget_s = given_value(arguments, "--budget", duration_value).value_or(endless);
  options.maze = maze_words(arguments);
  options.question = question_words(arguments);
  return options;
}

int exit_code(const studies::ScalingResult& result) {
  if (result.signal) return exit_code_of(*result.signal);
  bool stopped = !result.ungenerated.empty();
  bool unsolved = false;
  for (const studies::ScalingRun& run : result.runs) {
    stopped = stopped || run.trial.outcome == Outcome::stopped;
    unsolved = unsolved || !run.trial.verified;
  }
  if (stopped) return exit_code::budget;
  return unsolved ? exit_code::no_path : exit_code::success;
}

int scale(const Arguments& arguments) {
  const studies::ScalingOptions options = scaling_options(arguments);
  const bool standard_output_taken = check_reports(arguments, {"--json", "--csv", "--html"});
  Run run(arguments, RunScope::each_run_and_threads);
  const studies::ScalingResult result =
      studies::run_scaling_study(options, run.execution(), [&](std::string_view line) { run.note(line); });
  run.end();
  write_report(arguments, "--json", [&] { return studies::scaling_json(options, result); });
  write_report(arguments, "--csv", [&] { return studies::scaling_csv(result); });
  write_report(arguments, "--html", [&] { return studies::scaling_page(result, arguments.command_line()); });
  run.conclude(standard_output_taken, result.signal, [&] { return studies::scaling_summary(result, run.palette()); });
  return exit_code(result);
}

}  // namespace

Command scale_command() {
  return {"scale", "", "measure how time and memory grow with size and threads",
          joined_options({study_specs, maze_option_specs(),
                          options_but(roadmap_option_specs(), {"--planner", "--sampler", "--seed"}),
                          options_but(question_option_specs(), {"--start", "--goal", "--goal-pose"}),
                          options_but(run_option_specs(), {"--budget", "--threads"})}),
          scale};
}

}  // namespace warren::tools
