// SPDX-License-Identifier: BSD-3-Clause
// Searches side by side on one graph: each runs once to be checked against the others, then they take turns, each time
// measured alone, so that whatever else the machine does meets all of them alike.
//
// A time is one whole search: clearing what the last one left, searching, handing over the path. What two readings of
// the clock cost (measured between the searches, the median) is taken off.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/studies/comparison.hpp"
#include "core/base/enum_names.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren::studies {

// A graph in the plane with a question: what `warren compare` runs its searches on. Anything that can give one is a
// source of graphs; random geometric graphs of any size are the one that needs no world.

struct SearchGraph {
  std::string source;                                        ///< "maze:41x41", "geometric:300"
  std::string kind;                                          ///< whose graph it is: a planner's name, or "geometric"
  std::vector<std::pair<std::string, std::string>> options;  ///< how it was made: name, value as JSON
  Graph graph;                                               ///< with lengths, world units
  std::vector<Vec2> at;
  VertexId start = 0;
  VertexId goal = 0;
  std::string unit = {};  ///< of lengths: "m" or "cells"; empty: nobody says
};

/// `size` points drawn uniformly from a square of area `size` (so that their density is the same at any size), joined
/// where no farther apart than the radius whose disc holds `degree` points on average. Start and goal are those nearest
/// to the lower left and upper right corner among the vertices of the largest component. Vertices in tile order; a pure
/// function of the arguments. size 2 .. 2^31, degree > 0. O(size · degree). Throws Stopped, InputError for 2^32 edge
/// ends.
SearchGraph geometric_graph(std::uint32_t size, double degree, std::uint64_t seed, const Execution& execution);

// One way to search one graph again and again, its memory allocated once: ours with each queue, and a peer's. All stop
// when the goal is settled.

/// QueueKind, and the unordered array that is searched for its least entry, which no planner offers.
enum class QueuePolicy : std::uint8_t { heap, lazy_heap, sorted_array, resorted_array, linear_scan };
constexpr auto enum_names(QueuePolicy) {
  return std::array<std::string_view, 5>{"heap", "lazy-heap", "sorted-array", "resorted-array", "linear-scan"};
}

/// Whose search: ours, or Boost.Graph's with the queue that it brings along.
enum class SearchLibrary : std::uint8_t { warren, boost };
constexpr auto enum_names(SearchLibrary) { return std::array<std::string_view, 2>{"warren", "boost"}; }

struct SearchVariant {
  SearchKind search = SearchKind::astar;
  std::optional<QueuePolicy> queue = {};  ///< only ours, of astar and dijkstra
  SearchLibrary library = SearchLibrary::warren;
  friend bool operator==(const SearchVariant&, const SearchVariant&) = default;
};

/// Searches from the graph's start to its goal. length is that of the path for A* and Dijkstra; path_length() knows it
/// for the others. Polls the deadline where the library can.
using GraphSearch = std::function<SearchResult(const Execution&)>;

/// The graph must outlive it.
GraphSearch graph_search(const SearchGraph& graph, const SearchVariant& variant);

/// The same of Boost.Graph (boost_search.cpp).
GraphSearch boost_search(const SearchGraph& graph, SearchKind search);

/// Sum of the lengths along a path; the path's vertices are neighbours.
double path_length(const SearchGraph& graph, std::span<const VertexId> path);

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

struct WorldGraph {
  SearchGraph graph;                  ///< empty unless built
  Outcome outcome = Outcome::solved;  ///< start_blocked, goal_blocked: there is no graph to search
};

/// Solves with the planner and takes the graph that it leaves. Throws UsageError as `solve` does and for planners that
/// leave none, Stopped.
WorldGraph world_graph(const Scene& scene, const Question& question, const SolveOptions& options,
                       const Execution& execution);

}  // namespace warren::studies
