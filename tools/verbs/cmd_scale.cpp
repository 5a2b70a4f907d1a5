// SPDX-License-Identifier: BSD-3-Clause
// warren scale: how time, memory and work grow with the size of the maze and shrink with threads. warren largest: the
// largest maze that is solved and verified within the budget, found by measuring.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/studies/largest_maze.hpp"
#include "apps/studies/scaling_study.hpp"
#include "solve/question/planner_choice.hpp"
#include "tools/screen/output_files.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/words/option_values.hpp"
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

using Size = std::pair<std::uint32_t, std::uint32_t>;

Size size_value(std::string_view option, std::string_view word) {
  constexpr std::uint64_t most = 0xffffffff;
  const std::size_t by = word.find('x');
  const std::uint64_t rows = count_value(option, word.substr(0, by), 1, most);
  const std::uint64_t cols = by == std::string_view::npos ? rows : count_value(option, word.substr(by + 1), 1, most);
  if (rows > most / cols) throw UsageError(fmt::format("{}: {} has 2^32 cells or more", option, word));
  return {static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(cols)};
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
  options.sizes = given_values(arguments, "--sizes", "--sizes", size_value);
  if (options.sizes.empty()) options.sizes = {{100, 100}, {316, 316}, {1000, 1000}};
  std::ranges::stable_sort(options.sizes, {}, [](const Size& size) { return std::uint64_t{size.first} * size.second; });
  options.threads = given_values(arguments, "--threads", "--threads", threads_value);
  if (options.threads.empty())
    options.threads = thread_count(0) > 1 ? std::vector{1U, thread_count(0)} : std::vector{1U};
  std::sort(options.threads.begin(), options.threads.end());
  options.planners = planners_of(arguments);
  options.seeds = given_values(arguments, "--seeds", "--seeds", seed_value);
  if (options.seeds.empty()) options.seeds = {1};
  options.repeats = given_count(arguments, "--repeats", 1, most_repeats).value_or(options.repeats);
  options.budget_s =
      given_value(arguments, "--budget", duration_value).value_or(std::numeric_limits<double>::infinity());
  options.maze = maze_words(arguments);
  options.question = question_words(arguments);
  return options;
}

int exit_code(const studies::ScalingResult& result) {
  if (result.signal) return exit_code_of(*result.signal);
  const auto is_stopped = [](const studies::ScalingRun& run) { return run.trial.outcome == Outcome::stopped; };
  if (!result.ungenerated.empty() || std::ranges::any_of(result.runs, is_stopped)) return exit_code::budget;
  const auto is_solved = [](const studies::ScalingRun& run) { return run.trial.verified; };
  return std::ranges::all_of(result.runs, is_solved) ? exit_code::success : exit_code::no_path;
}

int scale(const Arguments& arguments) {
  const studies::ScalingOptions options = scaling_options(arguments);
  check_reports(arguments, {"--json", "--csv", "--html"});
  Run run(arguments, RunScope::each_run_and_threads);
  const studies::ScalingResult result =
      studies::run_scaling_study(options, run.execution(), [&](std::string_view line) { run.note(line); });
  run.end();
  write_report(arguments, "--json", [&] { return studies::scaling_json(options, result); });
  write_report(arguments, "--csv", [&] { return studies::scaling_csv(result); });
  write_report(arguments, "--html", [&] { return studies::scaling_page(result, arguments.command_line()); });
  run.conclude([&] { return studies::scaling_summary(result, run.palette()); }, result.signal);
  return exit_code(result);
}

constexpr OptionSpec search_specs[] = {
    {"--budget", "TIME",
     "most time for each maze, from its walls in memory (streamed: from its seed) to the verified path (default: 20s)"},
    {"--rows", "R", "with --cols C: mazes whose rows are to their columns as R to C (default: 1)"},
    {"--cols", "C", "see --rows (default: 1)"},
    {"--start-size", "N", "the first maze tried has about N x N cells (default: 128)"},
    {"--max-size", "N", "try no maze larger than about N x N cells (default: what memory holds)"},
    {"--precision", "P", "end when the largest side is known to P per cent (default: 5)"},
    {"--seed", "N", "seed of the first maze and of its samples (default: 1)"},
    {"--seeds", "N", "how many mazes of the largest size must all be solved (default: 3)"},
    {"--json", "FILE", "write all figures as JSON; - is standard output"},
    {"--picture", "FILE",
     "plot time against the number of cells, as .svg, .png or .pdf by ending; - is standard output"},
};

/// "5" or "5%", unlike share_value.
double percent_value(std::string_view option, std::string_view text) {
  if (text.ends_with('%')) text.remove_suffix(1);
  return number_value(option, text, 0.01, 100.0) / 100.0;
}

studies::SizeSearch size_search(const Arguments& arguments, double shape_rows, double shape_cols, bool is_streamed) {
  constexpr double most_cells = 4294967295.0;  // of a maze that is held
  constexpr double most_streamed = 1e12;
  const double lean = std::sqrt(std::max(shape_rows / shape_cols, shape_cols / shape_rows));
  studies::SizeSearch search;
  // Rounding the rows and columns of a shape may add half a row: stay a little under the limit.
  const double limit = std::floor(std::sqrt(is_streamed ? most_streamed : most_cells) - 1.0 - lean);
  if (limit < 1.0) throw UsageError("--rows, --cols: too far apart for any maze");
  const auto largest_side = static_cast<std::uint32_t>(limit);
  search.most = given_count(arguments, "--max-size", 1, largest_side).value_or(largest_side);
  search.least = static_cast<std::uint32_t>(std::min(std::ceil(lean), limit));
  if (search.most < search.least) {
    throw UsageError(
        fmt::format("--max-size: with these --rows and --cols at least {} (found: {})", search.least, search.most));
  }
  search.start =
      given_count(arguments, "--start-size", 1, largest_side).value_or(std::clamp(128U, search.least, search.most));
  if (search.start < search.least || search.start > search.most) {
    throw UsageError(fmt::format("--start-size: expected {} to {}, as --max-size and the shape say (found: {})",
                                 search.least, search.most, search.start));
  }
  search.step = given_value(arguments, "--precision", percent_value).value_or(search.step);
  return search;
}

studies::LargestOptions largest_options(const Arguments& arguments) {
  constexpr double most_shape = 1e6;
  constexpr std::uint64_t most_seeds = 1000;
  constexpr std::uint64_t last_seed = std::numeric_limits<std::uint64_t>::max() - most_seeds;
  const auto shape = [&](std::string_view option) {
    return given_value(arguments, option, number_value, 1.0 / most_shape, most_shape).value_or(1.0);
  };
  studies::LargestOptions options;
  options.budget_s = given_value(arguments, "--budget", duration_value).value_or(options.budget_s);
  options.shape_rows = shape("--rows");
  options.shape_cols = shape("--cols");
  options.planner = solve_words(arguments);
  const bool is_streamed = options.planner.roadmap.pipeline == PipelineKind::streamed;
  if (is_streamed) options.maze.algorithm = MazeAlgorithm::mst;
  options.maze = maze_words(arguments, options.maze);
  const bool is_unmade = is_streamed && options.maze.algorithm == MazeAlgorithm::mst;
  options.sizes = size_search(arguments, options.shape_rows, options.shape_cols, is_unmade);
  options.seeds = given_value(arguments, "--seeds", count_value, std::uint64_t{1}, most_seeds).value_or(options.seeds);
  options.maze.seed = given_value(arguments, "--seed", count_value, std::uint64_t{0}, last_seed).value_or(1);
  check_planner_options(options.planner);
  options.question = question_words(arguments);
  return options;
}

int exit_code(const studies::LargestResult& result) {
  if (result.signal) return exit_code_of(*result.signal);
  if (!result.best.empty()) return exit_code::success;
  // Nothing fitted: were the smallest mazes unsolvable with these options, or only too slow or too large?
  const bool unsolved = std::any_of(result.trials.begin(), result.trials.end(), [](const studies::MazeTrial& t) {
    return t.outcome != Outcome::solved && t.outcome != Outcome::stopped;
  });
  return unsolved ? exit_code::no_path : exit_code::budget;
}

int largest(const Arguments& arguments) {
  const studies::LargestOptions options = largest_options(arguments);
  check_reports(arguments, {"--json", "--picture"});
  check_plots(arguments);
  Run run(arguments, RunScope::each_run);
  const studies::LargestResult result =
      studies::find_largest(options, run.execution(), [&](std::string_view line) { run.note(line); });
  run.end();
  write_report(arguments, "--json", [&] { return studies::largest_json(options, result); });
  write_plots(arguments, run.execution(), result.signal.has_value(),
              [&] { return PlotsPage{{studies::largest_plot(options, result)}}; });
  run.conclude([&] { return studies::largest_summary(options, result, run.palette()); }, result.signal);
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

Command largest_command() {
  return {"largest",
          "",
          "find the largest maze that is solved within a budget",
          joined_options({search_specs, maze_option_specs(), options_but(roadmap_option_specs(), {"--seed"}),
                          options_but(question_option_specs(), {"--start", "--goal"}),
                          options_but(run_option_specs(), {"--budget"})}),
          largest,
          {{"--step", "is called --precision"}}};
}

}  // namespace warren::tools
