// SPDX-License-Identifier: BSD-3-Clause
// warren largest: the largest maze that is solved and verified within the budget, found by measuring.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/studies/largest_maze.hpp"
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

constexpr double most_cells = 4294967295.0;  // of a maze that is held
constexpr double most_streamed = 1e12;
constexpr double default_budget_s = 20.0;

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
  options.budget_s = given_value(arguments, "--budget", duration_value).value_or(default_budget_s);
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
  const bool standard_output_taken = check_reports(arguments, {"--json", "--picture"});
  check_plots(arguments);
  Run run(arguments, RunScope::each_run);
  const studies::LargestResult result =
      studies::find_largest(options, run.execution(), [&](std::string_view line) { run.note(line); });
  run.end();
  write_report(arguments, "--json", [&] { return studies::largest_json(options, result); });
  write_plots(arguments, run.execution(), result.signal.has_value(),
              [&] { return PlotsPage{{studies::largest_plot(options, result)}}; });
  run.conclude(standard_output_taken, result.signal,
               [&] { return studies::largest_summary(options, result, run.palette()); });
  return exit_code(result);
}

}  // namespace

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
