// SPDX-License-Identifier: BSD-3-Clause
// Searches side by side on one graph: each runs once to be checked against the others, then they take turns, each time
// measured alone, so that whatever else the machine does meets all of them alike.
//
// A time is one whole search: clearing what the last one left, searching, handing over the path. What two readings of
// the clock cost (measured between the searches, the median) is taken off.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "studies/compare/comparison.hpp"
#include "studies/searches/graph_search.hpp"

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

}  // namespace warren::studies
