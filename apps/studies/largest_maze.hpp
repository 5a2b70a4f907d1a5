// SPDX-License-Identifier: BSD-3-Clause
// The search behind `warren largest`: which mazes are tried, what stands when it ends or is broken off, and what is
// said of it. And the honest bar beside it: breadth-first search and funnel.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/studies/machine.hpp"
#include "apps/studies/maze_trial.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "pictures/plots/plot.hpp"
#include "scenes/text/human_units.hpp"

namespace warren::studies {
// Finds the largest size that fits by trying: starts small, doubles the area while it fits, then bisects on the side.
// Sizes that don't fit are supposed to be above those that do; noise at the border costs at most a step.

struct SizeSearch {
  std::uint32_t start = 1;  ///< the first side tried; least <= start <= most
  std::uint32_t least = 1;  ///< >= 1
  std::uint32_t most = 1;
  double step = 0.05;  ///< > 0: ends when the side that fits and the one that doesn't are closer than this fraction
};

/// The largest side for which fits(side) was seen to hold; 0 if none. Halves the area where the start doesn't fit.
/// Number of tries: the doublings, and log2(0.41 / step) more.
std::uint32_t largest_side(const SizeSearch& search, const std::function<bool(std::uint32_t)>& fits);

/// The next smaller side to try when one that fitted once doesn't always: a step below, 0 below the least.
std::uint32_t side_below(const SizeSearch& search, std::uint32_t side);

/// A side n stands for n * n cells in the shape rows : cols.
struct LargestOptions {
  double budget_s = 20.0;  ///< of each run's solve_s
  SizeSearch sizes;
  double shape_rows = 1.0;  ///< > 0
  double shape_cols = 1.0;  ///< > 0
  MazeOptions maze;         ///< algorithm, loops, and the first seed
  std::uint64_t seeds = 3;  ///< mazes at the last size; >= 1
  Question question;        ///< start and goal are the mazes'
  SolveOptions planner;     ///< prm or lazy-prm; the seed is the maze's
};

struct UnbegunSize {
  std::uint32_t rows, cols;
  std::size_t expected_bytes;
};

/// BFS and funnel on the last maze.
struct HonestBar {
  double seconds = 0.0;
  double length = 0.0;
};

struct LargestResult {
  std::vector<MazeTrial> trials;     ///< in the order in which they ran
  std::vector<UnbegunSize> unbegun;  ///< would not have fitted in memory
  std::vector<MazeTrial> best;       ///< the runs at the largest size, a seed each; empty: none fitted
  bool confirmed = false;            ///< all seeds of `best` ran and fitted
  std::optional<HonestBar> bar;
  MemoryTouch touch;
  std::optional<StopReason> signal;  ///< the search was broken off
};

/// Searches, and tells `note` a line a trial. The execution has a deadline, whose memory is the limit; its signal ends
/// the search with what there is. Never throws Stopped; throws UsageError for what can't be asked of mazes.
LargestResult find_largest(const LargestOptions& options, const Execution& execution,
                           const std::function<void(std::string_view)>& note);

/// What `warren largest` says: to a person, as warren.largest/1, and as a plot of time against cells.
std::string largest_summary(const LargestOptions& options, const LargestResult& result, const Palette& palette);
std::string largest_json(const LargestOptions& options, const LargestResult& result);
/// Every run that came to its end, the runs at the largest size, and the budget's line.
PlotSheet largest_plot(const LargestOptions& options, const LargestResult& result);

// The honest bar beside any record: what somebody does who knows that the walls are a maze. Reads the cells back from
// the walls, walks them breadth first, and pulls the string through the corridor's open sides (the funnel of Lee and
// Preparata 1984, in Mononen's form). Gives the shortest path of a point that may touch wall ends; in a maze with loops
// the shortest within the corridor that the breadth-first search took. O(walls + cells) time; beside the walls 1 byte a
// cell, 1 a step and 16 a bend.

/// From the maze's start (0.5, 1) to its goal (cols + 0.5, rows); empty if cells don't connect them. The scene has the
/// maze hint. Throws InputError if a wall is off the unit grid, Stopped at the deadline.
Path<Vec2> bfs_funnel(const Scene& scene, const Execution& execution);

}  // namespace warren::studies
