// SPDX-License-Identifier: BSD-3-Clause
// One way to search one graph again and again, its memory allocated once: ours with each queue, and a peer's. All stop
// when the goal is settled. Virtual once a search, never inside it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "core/base/enum_names.hpp"
#include "core/search/search.hpp"
#include "planners/roadmap/roadmap_options.hpp"
#include "studies/searches/search_graph.hpp"

namespace warren::studies {

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

constexpr bool has_queue(SearchKind search) { return search == SearchKind::astar || search == SearchKind::dijkstra; }

class GraphSearch {
 public:
  virtual ~GraphSearch() = default;
  GraphSearch() = default;
  GraphSearch(const GraphSearch&) = delete;
  GraphSearch& operator=(const GraphSearch&) = delete;
  /// Searches from the graph's start to its goal. length is that of the path for A* and Dijkstra; path_length() knows
  /// it for the others. Polls the deadline where the library can.
  virtual SearchResult run(const Execution& execution) = 0;
};

/// The graph must outlive it. Throws UsageError for a library that this build does not have.
std::unique_ptr<GraphSearch> graph_search(const SearchGraph& graph, const SearchVariant& variant);

/// Was the program built where Boost.Graph was found? (boost_search.cpp, boost_search_absent.cpp)
bool has_boost_graph();
std::unique_ptr<GraphSearch> boost_search(const SearchGraph& graph, SearchKind search);

/// Sum of the lengths along a path; the path's vertices are neighbours.
double path_length(const SearchGraph& graph, std::span<const VertexId> path);

}  // namespace warren::studies
