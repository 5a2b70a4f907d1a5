// SPDX-License-Identifier: BSD-3-Clause
// Searches side by side on one graph: each runs once to be checked against the others, then they take turns, each time
// measured alone, so that whatever else the machine does meets all of them alike.
//
// A time is one whole search: clearing what the last one left, searching, handing over the path. What two readings of
// the clock cost (measured between the searches, the median) is taken off.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/studies/comparison.hpp"
#include "apps/studies/search_graph.hpp"
#include "core/base/solution.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren::studies {

struct SearchContestOptions {
  std::vector<SearchVariant> variants;  ///< at least one, no two alike
  /// Times that each is measured, >= 1; none: as often as it fits in about a quarter of a second, 5 to 10,000 times.
  std::optional<std::uint64_t> trials = {};
  double budget_s = std::numeric_limits<double>::infinity();  ///< of each single search
};

/// Adds the graph as a problem and a contender a variant to `comparison`. A search that its budget cuts is measured no
/// further: its one run says stopped. Throws Stopped at a signal (what was measured until then is there),
/// std::logic_error where answers contradict each other.
void run_search_contest(const SearchGraph& graph, const SearchContestOptions& options, const Execution& execution,
                        Comparison& comparison);

/// What one search found, for the check.
struct SearchClaim {
  SearchVariant variant;
  bool found = false;
  double length = 0.0;
  std::uint64_t hops = 0;
  std::uint64_t expanded = 0;
};

/// What the answers contradict each other in, if anything: all or none find a path; A* and Dijkstra are equally long
/// with any queue and library (to 1e-9) and no longer than the others; breadth-first has the fewest hops; one search's
/// answer and count of settled vertices depend on no queue of ours; A* settles no more vertices than Dijkstra, which
/// settles no more with our queues than there are.
std::optional<std::string> contradiction_in(std::span<const SearchClaim> claims);

/// The same searches on random geometric graphs of several sizes: what `warren compare --sizes` measures.
struct SizeSweepOptions {
  std::vector<std::uint32_t> sizes;  ///< ascending, each >= 2
  double degree = 20.0;              ///< of a vertex, on average
  std::uint64_t first_seed = 1;
  std::uint64_t seeds = 1;  ///< graphs of each size
  SearchContestOptions contest;
};

/// Runs the contest on every graph. Where the number of trials is left to it, a search that took longer than two
/// seconds is left out of all larger graphs, with a note. `say` is told a line a graph. Throws as run_search_contest.
void run_size_sweep(const SizeSweepOptions& options, const Execution& execution, Comparison& comparison,
                    const std::function<void(std::string_view)>& say);

// The graph of a world, for searches to be compared on: what a planner of `solve` would search, with its options.

/// The planner whose graph is searched where none is asked for: the one that `solve` would take, prm for lazy-prm.
/// Throws UsageError where no planner solves this world.
PlannerKind usual_graph_planner(const Scene& scene, const Question& question, const SolveOptions& options);

struct WorldGraph {
  SearchGraph graph;                  ///< empty unless built
  Outcome outcome = Outcome::solved;  ///< start_blocked, goal_blocked: there is no graph to search
};

/// Solves with the planner and takes the graph that it leaves. Throws UsageError as `solve` does and for planners that
/// leave none, Stopped.
WorldGraph world_graph(const Scene& scene, const Question& question, const SolveOptions& options,
                       const Execution& execution);

}  // namespace warren::studies
