// SPDX-License-Identifier: BSD-3-Clause
#include "studies/sizes/largest_maze.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

#include "core/base/error.hpp"
#include "scenes/text/human_units.hpp"
#include "studies/sizes/bfs_funnel_baseline.hpp"

namespace warren::studies {
namespace {

std::uint32_t extent(double cells) {
  return static_cast<std::uint32_t>(std::clamp(std::round(cells), 1.0, 4294967295.0));
}

/// One search: sizes come from size_search, mazes and runs from maze_trial.
class LargestSearch {
 public:
  LargestSearch(const LargestOptions& options, const Execution& execution,
                const std::function<void(std::string_view)>& note)
      : options_(options), execution_(execution), note_(note) {}

  void search();
  LargestResult& result() { return result_; }

 private:
  MazeOptions maze(std::uint32_t side, std::uint64_t seed) const;
  void probe();
  bool fits(std::uint32_t side);
  void confirm(std::uint32_t side);
  bool all_seeds_fit(std::uint32_t side, bool first_is_known);
  std::optional<MazeTrial> trial(const MazeOptions& maze, bool last);
  bool has_memory_for(const MazeOptions& maze);
  bool within_budget(const MazeTrial& t) const { return t.verified && t.solve_s <= options_.budget_s; }
  void measure_bar(const Scene& scene);
  void say(const MazeTrial& t) const;

  const LargestOptions& options_;
  const Execution& execution_;
  const std::function<void(std::string_view)>& note_;
  LargestResult result_;
  WarmMemory warm_;
  double bytes_a_cell_ = 0.0;  // of the last run that came to its end
};

void LargestSearch::search() {
  probe();
  const std::uint32_t side = largest_side(options_.sizes, [&](std::uint32_t n) { return fits(n); });
  if (side > 0) confirm(side);
}

/// What a cell takes, learned from a smaller maze: else the memory of a large first one could not be warmed, nor known
/// to be too little.
void LargestSearch::probe() {
  constexpr std::uint32_t large = 2000;
  constexpr std::uint32_t enough = 500;
  if (options_.sizes.start > large) trial(maze(std::max(enough, options_.sizes.start / 10), options_.maze.seed), false);
}

/// The shape keeps the number of cells: rows * cols is about side * side.
MazeOptions LargestSearch::maze(std::uint32_t side, std::uint64_t seed) const {
  MazeOptions maze = options_.maze;
  const double lean = std::sqrt(options_.shape_rows / options_.shape_cols);
  maze.rows = extent(side * lean);
  maze.cols = extent(side / lean);
  maze.seed = seed;
  return maze;
}

bool LargestSearch::fits(std::uint32_t side) {
  const auto ran = trial(maze(side, options_.maze.seed), false);
  if (!ran || !within_budget(*ran)) return false;
  result_.best = {*ran};
  return true;
}

void LargestSearch::confirm(std::uint32_t side) {
  bool known = options_.seeds > 1;  // the first seed has run; with one seed it runs again, as the independent check
  while (side > 0 && !all_seeds_fit(side, known)) {
    side = side_below(options_.sizes, side);
    known = false;
  }
  result_.confirmed = side > 0;
}

bool LargestSearch::all_seeds_fit(std::uint32_t side, bool first_is_known) {
  std::vector<MazeTrial> runs;
  if (first_is_known) runs = result_.best;
  while (runs.size() < options_.seeds) {
    const std::uint64_t seed = options_.maze.seed + runs.size();
    const auto ran = trial(maze(side, seed), runs.size() + 1 == options_.seeds);
    if (!ran || !within_budget(*ran)) {
      result_.best.clear();
      return false;
    }
    runs.push_back(*ran);
    result_.best = runs;
  }
  return true;
}

/// A size that is expected not to fit is not begun.
bool LargestSearch::has_memory_for(const MazeOptions& maze) {
  const double cells = static_cast<double>(maze.rows) * maze.cols;
  const auto expected = static_cast<std::size_t>(bytes_a_cell_ * cells);
  if (expected > execution_.deadline->memory_bytes()) {
    result_.unbegun.push_back({maze.rows, maze.cols, expected});
    note_(fmt::format("{:>6} x {:<6} not begun: it would need {}", maze.rows, maze.cols,
                      human_bytes(static_cast<double>(expected))));
    return false;
  }
  warm_.prepare(expected, execution_);
  result_.touch = warm_.touch();
  return true;
}

std::optional<MazeTrial> LargestSearch::trial(const MazeOptions& maze, bool last) {
  if (!has_memory_for(maze)) return std::nullopt;
  try {
    double generate_s = 0.0;
    const Scene scene = generate_trial(maze, options_.planner, execution_, generate_s);
    MazeTrial ran = solve_trial(scene, maze, options_.question, options_.planner, options_.budget_s, execution_);
    ran.generate_s = generate_s;
    if (ran.outcome == Outcome::solved) bytes_a_cell_ = static_cast<double>(ran.peak_memory_bytes) / ran.cells();
    result_.trials.push_back(ran);
    say(ran);
    if (last && within_budget(ran) && !is_unmade(scene)) measure_bar(scene);
    return ran;
  } catch (const Stopped& stopped) {
    if (stopped.reason != StopReason::memory) throw;
  } catch (const std::bad_alloc&) {
  }
  result_.unbegun.push_back({maze.rows, maze.cols, execution_.deadline->memory_bytes()});
  note_(fmt::format("{:>6} x {:<6} too little memory to generate it", maze.rows, maze.cols));
  return std::nullopt;
}

/// On the maze that was just solved, while its walls are in memory.
void LargestSearch::measure_bar(const Scene& scene) {
  const auto begin = std::chrono::steady_clock::now();
  try {
    const Path<Vec2> path = bfs_funnel(scene, execution_);
    HonestBar bar;
    bar.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    for (std::size_t i = 1; i < path.size(); ++i) bar.length += distance(path[i - 1], path[i]);
    result_.bar = bar;
  } catch (const Stopped& stopped) {
    if (stopped.reason != StopReason::memory) throw;
  } catch (const std::bad_alloc&) {  // then there is no bar
  }
}

void LargestSearch::say(const MazeTrial& t) const {
  const std::string_view verdict =
      t.outcome == Outcome::solved ? (within_budget(t) ? "within the budget" : "over the budget") : verdict_of(t);
  note_(fmt::format("{:>6} x {:<6} seed {}: {:>8}, {:>6.1f} ns a cell, {:>8}; {}", t.rows, t.cols, t.seed,
                    human_seconds(t.solve_s), t.solve_s * 1e9 / t.cells(),
                    human_bytes(static_cast<double>(t.peak_memory_bytes)), verdict));
}

}  // namespace

const MazeTrial& median_trial(const LargestResult& result) {
  std::vector<const MazeTrial*> runs;
  for (const MazeTrial& t : result.best) runs.push_back(&t);
  const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
  std::nth_element(runs.begin(), middle, runs.end(),
                   [](const MazeTrial* a, const MazeTrial* b) { return a->solve_s < b->solve_s; });
  return **middle;
}

LargestResult find_largest(const LargestOptions& options, const Execution& execution,
                           const std::function<void(std::string_view)>& note) {
  LargestSearch search(options, execution, note);
  try {
    search.search();
  } catch (const Stopped& stopped) {
    search.result().signal = stopped.reason;
  }
  return std::move(search.result());
}

}  // namespace warren::studies
