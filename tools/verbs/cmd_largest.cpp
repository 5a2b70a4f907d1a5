// SPDX-License-Identifier: BSD-3-Clause
// warren largest: the largest maze that is solved and verified within the budget, found by measuring.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question.hpp"
#include "studies/sizes/largest_maze.hpp"
#include "studies/sizes/largest_report.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/output_names.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/words/command.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

constexpr double most_cells = 4294967295.0;  // of any maze
constexpr double default_budget_s = 20.0;

constexpr OptionSpec search_specs[] = {
    {"--budget", "TIME", "each run may take so long from walls in memory to path verified (default: 20s)"},
    {"--rows", "R", "rows to columns as R to C, by --cols; the search is over the number of cells (default: 1)"},
    {"--cols", "C", "see --rows (default: 1)"},
    {"--start-size", "N", "the first maze tried has about N x N cells (default: 128)"},
    {"--max-size", "N", "try nothing larger than about N x N cells (default: what memory holds)"},
    {"--step", "P", "end when the side is known to P per cent (default: 5)"},
    {"--seed", "N", "the first maze's seed, and its sampling's (default: 1)"},
    {"--seeds", "N", "mazes that must all be solved at the largest size (default: 3)"},
    {"--json", "FILE", "write warren.largest/1; - is standard output"},
    {"--svg", "FILE", "plot time against cells with the budget; - is standard output"},
};

/// "5" or "5%".
double step_value(std::string text) {
  if (text.ends_with('%')) text.pop_back();
  return number_value("--step", text, 0.01, 100.0) / 100.0;
}

std::uint32_t side_value(const Arguments& arguments, std::string_view option, double most, double usual) {
  const auto text = arguments.value(option);
  return static_cast<std::uint32_t>(text ? count_value(option, *text, 1, static_cast<std::uint64_t>(most)) : usual);
}

SizeSearch size_search(const Arguments& arguments, double shape_rows, double shape_cols) {
  const double lean = std::sqrt(std::max(shape_rows / shape_cols, shape_cols / shape_rows));
  SizeSearch search;
  // Rounding the rows and columns of a shape may add half a row: stay a little under the limit.
  const double limit = std::floor(std::sqrt(most_cells) - 1.0 - lean);
  if (limit < 1.0) throw UsageError("--rows, --cols: too far apart for any maze");
  search.most = side_value(arguments, "--max-size", limit, limit);
  search.least = static_cast<std::uint32_t>(std::min(std::ceil(lean), limit));
  if (search.most < search.least) {
    throw UsageError(
        fmt::format("--max-size: with these --rows and --cols at least {} (found: {})", search.least, search.most));
  }
  search.start = side_value(arguments, "--start-size", limit, std::clamp(128U, search.least, search.most));
  if (search.start < search.least || search.start > search.most) {
    throw UsageError(fmt::format("--start-size: expected {} to {}, as --max-size and the shape say (found: {})",
                                 search.least, search.most, search.start));
  }
  if (const auto step = arguments.value("--step")) search.step = step_value(*step);
  return search;
}

LargestOptions largest_options(const Arguments& arguments) {
  constexpr double most_shape = 1e6;
  constexpr std::uint64_t most_seeds = 1000;
  const auto shape = [&](std::string_view option) {
    const auto text = arguments.value(option);
    return text ? number_value(option, *text, 1.0 / most_shape, most_shape) : 1.0;
  };
  LargestOptions options;
  const auto budget = arguments.value("--budget");
  options.budget_s = budget ? duration_value("--budget", *budget) : default_budget_s;
  options.shape_rows = shape("--rows");
  options.shape_cols = shape("--cols");
  options.sizes = size_search(arguments, options.shape_rows, options.shape_cols);
  options.maze = trial_maze(arguments);
  if (const auto seeds = arguments.value("--seeds")) options.seeds = count_value("--seeds", *seeds, 1, most_seeds);
  if (const auto seed = arguments.value("--seed")) {
    options.maze.seed = count_value("--seed", *seed, 0, std::numeric_limits<std::uint64_t>::max() - most_seeds);
  }
  return options;
}

void check_report_files(const Arguments& arguments) {
  for (const char* option : {"--json", "--svg", "--trace"}) {
    const auto file = arguments.value(option);
    if (!file) continue;
    check_writable(*file);
  }
  check_picture_ending("--svg", arguments.value("--svg").value_or(""), ".svg");
}

int exit_code(const LargestResult& result) {
  if (result.signal) return exit_code_of(*result.signal);
  if (!result.best.empty()) return exit_code::success;
  // Nothing fitted: were the smallest mazes unsolvable with these options, or only too slow or too large?
  const bool unsolved = std::any_of(result.trials.begin(), result.trials.end(), [](const MazeTrial& t) {
    return t.outcome != Outcome::solved && t.outcome != Outcome::stopped;
  });
  return unsolved ? exit_code::no_path : exit_code::budget;
}

int largest(const Arguments& arguments) {
  const LargestOptions options = largest_options(arguments);
  check_planner_options(arguments);
  problem_options(arguments);  // refuses impossible values now, not after a maze was made
  check_report_files(arguments);
  Run run(arguments, RunScope::each_run);
  Execution execution = run.execution();
  if (const auto threads = arguments.value("--threads")) execution.threads = threads_value(*threads);
  const LargestResult result = find_largest(options, arguments, run, execution);
  run.end();
  const std::string json = arguments.value("--json").value_or("");
  const std::string svg = arguments.value("--svg").value_or("");
  if (!json.empty()) write_file(json, largest_json(options, result), Execution{});
  if (!svg.empty()) write_file(svg, largest_plot(options, result), Execution{});
  if (!run.quiet() && json != "-" && svg != "-") {
    print_text(largest_summary(options, result, run.palette()));
  } else if (result.signal) {
    say_stopped(*result.signal);
  }
  return exit_code(result);
}

}  // namespace

Command largest_command() {
  constexpr std::array<std::string_view, 1> own{"--seed"};
  Command command{"largest", "", "find the largest maze that is solved within a budget", {}, largest};
  add_options(command.options, search_specs);
  add_options(command.options, trial_maze_specs());
  add_options(command.options, trial_solve_specs(own));
  for (const OptionSpec& option : run_option_specs()) {
    if (option.name != "--budget") command.options.push_back(option);
  }
  return command;
}

}  // namespace warren
