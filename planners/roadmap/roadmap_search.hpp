// SPDX-License-Identifier: BSD-3-Clause
// Searches an explicit roadmap; how follows from the options and from counts.
//
// A* and Dijkstra, from 50,000 vertices on: where most vertices are dead ends or links of chains (lattices) the roadmap
// is reduced first (parallel/reduce_graph.hpp) and its keys are searched; the expanded path is as long as the plain
// one. Else (uniform sampling, where every doorway is crossed by several edges and next to nothing could be peeled) the
// search runs from both ends. Smaller roadmaps, and breadth- and depth-first search: plainly, on one thread.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/base/world.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "parallel/execution.hpp"
#include "parallel/reduce_graph.hpp"
#include "planners/roadmap/queue_choice.hpp"
#include "planners/roadmap/roadmap_options.hpp"
#include "planners/roadmap/search_from_both_ends.hpp"

namespace warren {

/// (vertex, parent) of every vertex that a search reached.
std::vector<Edge> search_tree(const SearchState& state);
/// The same of a search from both ends; what both have reached has the first one's parent.
std::vector<Edge> search_trees(const SearchState& forward, const SearchState& backward);

namespace detail {

/// Are at least half of the vertices of degree 2 or less? On lattices of mazes 80 % are, in uniform roadmaps 1 %.
bool is_stringy(const Graph& graph, const Execution& execution);
/// A search tree over keys as the tree over the vertices on their chains.
std::vector<Edge> expanded_tree(const TwiceReducedGraphView& reduced, const std::vector<Edge>& keys,
                                const Execution& execution);

/// The edges of a graph, as a search asks for them; length(v, w) is called for neighbours.
template <class Length>
struct GraphEdges {
  const Graph& graph;
  const Length& length;
  template <class Visit>
  void operator()(VertexId v, const Visit& visit) const {
    for (const VertexId w : graph.neighbours(v)) visit(w, length(v, w));
  }
  void fetch(VertexId v) const { __builtin_prefetch(graph.neighbours(v).data()); }
  template <class Visit>
  void for_each_target(VertexId v, const Visit& visit) const {
    for (const VertexId w : graph.neighbours(v)) visit(w);
  }
};

/// A* or Dijkstra. estimate_to(root) gives a consistent estimate of the way to start or goal; `tree`, where given,
/// receives the search's tree.
template <class Neighbours, class EstimateTo>
SearchResult search_best(std::size_t vertex_count, VertexId start, VertexId goal, const Neighbours& neighbours,
                         const EstimateTo& estimate_to, QueueKind kind, const Execution& execution,
                         std::vector<Edge>* tree) {
  execution.reserve(vertex_count * 36);
  std::array<SearchState, 2> states;
  SearchResult found;
  if (vertex_count >= fewest_for_both_ends) {
    found = search_from_both_ends<Neighbours>(kind, vertex_count, {start, goal}, {neighbours, neighbours}, estimate_to,
                                              {&states[0], &states[1]}, execution);
  } else {
    states[0].resize(vertex_count, [&] { execution.check(); });
    found = with_queue(kind, vertex_count, execution, [&](auto& queue) {
      return best_first(start, goal, neighbours, estimate_to(goal), queue, states[0],
                        [&] { return execution.should_stop(); });
    });
  }
  if (tree != nullptr) *tree = search_trees(states[0], states[1]);
  return found;
}

/// The same over the keys of a reduced graph.
template <class EstimateTo>
SearchResult search_reduced(const TwiceReducedGraphView& reduced, VertexId start, VertexId goal,
                            const EstimateTo& estimate_to, QueueKind kind, const Execution& execution,
                            std::vector<Edge>* tree) {
  const auto neighbours = [&](VertexId key, const auto& visit) {
    const std::span<const VertexId> row = reduced.graph().neighbours(key);
    const std::span<const double> lengths = reduced.graph().lengths(key);
    for (std::size_t i = 0; i < row.size(); ++i) visit(row[i], lengths[i]);
  };
  const auto estimate_to_key = [&](VertexId root) {
    return [&reduced, estimate = estimate_to(root == no_vertex ? root : reduced.vertex_of(root))](VertexId key) {
      return estimate(reduced.vertex_of(key));
    };
  };
  SearchResult found = search_best(reduced.graph().vertex_count(), reduced.key_of(start), reduced.key_of(goal),
                                   neighbours, estimate_to_key, kind, execution, tree);
  found.path = reduced.expand(found.path, execution);
  if (tree != nullptr) *tree = expanded_tree(reduced, *tree, execution);
  return found;
}

}  // namespace detail

/// What is to be searched instead of the roadmap, start and goal kept; nothing where the roadmap itself is. Refers to
/// the graph.
template <World W>
std::optional<TwiceReducedGraphView> reduced_for_search(const W& world, const Graph& graph,
                                                        std::span<const typename W::State> states, VertexId start,
                                                        VertexId goal, const RoadmapOptions& options,
                                                        const Execution& execution) {
  if (options.search == SearchKind::bfs || options.search == SearchKind::dfs) return std::nullopt;
  if (graph.vertex_count() < fewest_for_both_ends || !detail::is_stringy(graph, execution)) return std::nullopt;
  const auto length = [&](VertexId v, VertexId w) { return world.distance(states[v], states[w]); };
  return TwiceReducedGraphView(graph, std::array{start, goal}, length, execution);
}

/// Searches from `start` to `goal` over the graph, or over what reduced_for_search made of it; edge lengths are the
/// world's distances. `tree`, where given, receives (vertex, parent) of what the search reached. Throws Stopped at the
/// deadline.
template <World W>
SearchResult search_roadmap(const W& world, const Graph& graph, const std::optional<TwiceReducedGraphView>& reduced,
                            std::span<const typename W::State> states, VertexId start, VertexId goal,
                            const RoadmapOptions& options, const Execution& execution, std::vector<Edge>* tree) {
  const auto should_stop = [&] { return execution.should_stop(); };
  const auto length = [&](VertexId v, VertexId w) { return world.distance(states[v], states[w]); };
  const detail::GraphEdges<decltype(length)> neighbours{graph, length};
  const bool informed = options.search == SearchKind::astar;
  const auto estimate_to = [&](VertexId root) {
    return [&world, states, informed, root](VertexId v) {
      return informed ? world.distance(states[v], states[root]) : 0.0;
    };
  };
  const std::size_t n = graph.vertex_count();
  SearchResult found;
  if (options.search == SearchKind::bfs || options.search == SearchKind::dfs) {
    SearchState state;
    state.resize(n, [&] { execution.check(); });
    found = options.search == SearchKind::bfs ? breadth_first(graph, start, goal, state, should_stop)
                                              : depth_first(graph, start, goal, state, should_stop);
    if (tree != nullptr) *tree = search_tree(state);
  } else if (reduced) {
    found = detail::search_reduced(*reduced, start, goal, estimate_to, options.queue, execution, tree);
  } else {
    found = detail::search_best(n, start, goal, neighbours, estimate_to, options.queue, execution, tree);
  }
  if (found.status == SearchStatus::stopped) execution.check();
  return found;
}

}  // namespace warren
