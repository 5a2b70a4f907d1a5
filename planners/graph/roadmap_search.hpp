// SPDX-License-Identifier: BSD-3-Clause
// Searches an explicit roadmap; how follows from the options and from counts. Compiled once for the roadmaps of all
// worlds: what a search asks of the world is a distance between two vertices.
//
// A* and Dijkstra, from 50,000 vertices on: where most vertices are dead ends or links of chains (lattices) the roadmap
// is reduced first (planners/graph/reduce_graph.hpp) and its keys are searched; the expanded path is as long as the
// plain one. Else (uniform sampling, where every doorway is crossed by several edges and next to nothing could be
// peeled) the search runs from both ends. Smaller roadmaps, and breadth- and depth-first search: plainly, on one
// thread.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "planners/graph/reduce_graph.hpp"
#include "planners/graph/roadmap_options.hpp"

namespace warren {

/// Vertices from which on a search runs from both ends. The number of vertices alone decides, so that path and counters
/// are the same for any number of threads: two threads do not repay their start on small roadmaps.
inline constexpr std::size_t fewest_for_both_ends = 50'000;

/// A function of two vertices, such as the world's distance between their states; refers to what it is made of. Called
/// by several threads at once. 2 ns more than the function itself.
class VertexDistance {
 public:
  template <class Distance>
  explicit VertexDistance(const Distance& distance)
      : distance_(&distance), call_([](const void* function, VertexId v, VertexId w) -> double {
          return (*static_cast<const Distance*>(function))(v, w);
        }) {}
  double operator()(VertexId v, VertexId w) const { return call_(distance_, v, w); }

 private:
  const void* distance_;
  double (*call_)(const void*, VertexId, VertexId);
};

/// What a search of a roadmap needs besides the graph. Where the graph has lengths, `length` is not called.
struct RoadmapSearch {
  VertexId start;
  VertexId goal;
  VertexDistance length;    ///< of an edge
  VertexDistance estimate;  ///< of the way between any two: at most its length; asked by A* alone
  SearchKind search;
  QueueKind queue;
  const Execution& execution;
  std::vector<Edge>* tree = nullptr;  ///< receives (vertex, parent) of what the search reached
  bool estimate_fits = true;          ///< false: it may be too long; the graph itself is searched, from the start alone
};

/// (vertex, parent) of every vertex that a search reached.
std::vector<Edge> search_tree(const SearchState& state);
/// The same of a search from both ends; what both have reached has the first one's parent.
std::vector<Edge> search_trees(const SearchState& forward, const SearchState& backward);

/// Are at least half of the vertices of degree 2 or less? On lattices of mazes 80 % are, in uniform roadmaps 1 %.
bool is_stringy(const Graph& graph, const Execution& execution);

/// What is to be searched instead of the roadmap, start and goal kept; nothing where the roadmap itself is. Refers to
/// the graph.
std::optional<TwiceReducedGraphView> reduced_for_search(const Graph& graph, const RoadmapSearch& asked);

/// Searches the graph, or the keys of a reduced one: then the path is of the vertices that they stand for. Throws
/// Stopped at the deadline.
SearchResult search_roadmap(const Graph& graph, const RoadmapSearch& asked);
SearchResult search_roadmap(const TwiceReducedGraphView& reduced, const RoadmapSearch& asked);

/// What a search of a graph needs that expands its vertices itself, as lazily checked roadmaps do.
struct ImplicitSearch {
  VertexDistance estimate;  ///< of the way between any two: consistent; asked where informed alone
  bool informed;            ///< false: Dijkstra
  QueueKind queue;
  std::size_t vertex_count;
  const Execution& execution;
};

/// From `from` to `to`, or (no_vertex) to all that can be reached. Whether it was stopped is in the result.
SearchResult search_implicit(const AnyNeighbours& neighbours, VertexId from, VertexId to, const ImplicitSearch& asked,
                             SearchState& state);
/// From both ends; an end's neighbours and state are its own. Throws Stopped.
SearchResult search_implicit_from_both_ends(const std::array<AnyNeighbours, 2>& neighbours,
                                            const std::array<VertexId, 2>& ends, const ImplicitSearch& asked,
                                            const std::array<SearchState*, 2>& states);

}  // namespace warren
