// SPDX-License-Identifier: BSD-3-Clause
// A graph in the plane with a question: what `warren compare` runs its searches on. Anything that can give one is a
// source of graphs; random geometric graphs of any size are the one that needs no world.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/enum_names.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "planners/graph/roadmap_options.hpp"

namespace warren::studies {

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

}  // namespace warren::studies
