// SPDX-License-Identifier: BSD-3-Clause
// Searches an explicit roadmap: one place where the kind of search and its queue are chosen, once a search.
#pragma once

#include <span>
#include <variant>

#include "core/counters.hpp"
#include "core/graph.hpp"
#include "core/search.hpp"
#include "core/search_queues.hpp"
#include "core/world.hpp"
#include "parallel/execution.hpp"
#include "planners/roadmap.hpp"
#include "planners/roadmap_options.hpp"

namespace warren {

/// Calls f with an empty queue of the kind, ready for vertex_count vertices.
template <class F>
auto with_queue(QueueKind kind, std::size_t vertex_count, const F& f) {
  const auto call = [&](auto queue) {
    queue.resize(vertex_count);
    return f(queue);
  };
  switch (kind) {
    case QueueKind::lazy_heap:
      return call(LazyHeap());
    case QueueKind::sorted_array:
      return call(SortedArray());
    case QueueKind::resorted_array:
      return call(ResortedArray());
    case QueueKind::heap:
      break;
  }
  return call(IndexedHeap<4>());
}

/// (vertex, parent) of every vertex that a search reached.
std::vector<Edge> search_tree(const SearchState& state);
/// The same of a search from both ends; what both have reached has the first one's parent.
std::vector<Edge> search_trees(const SearchState& forward, const SearchState& backward);

/// Searches from `start` to `goal` over the graph; edge lengths are the world's distances. Throws Stopped at the
/// deadline.
template <World W>
SearchResult search_roadmap(const Graph& graph, std::span<const typename W::State> states, VertexId start,
                            VertexId goal, const RoadmapOptions& options, const Execution& execution,
                            SearchState& state) {
  const auto should_stop = [&] { return execution.should_stop(); };
  const auto neighbours = [&](VertexId v, const auto& visit) {
    for (const VertexId w : graph.neighbours(v)) visit(w, W::distance(states[v], states[w]));
  };
  const auto to_goal = [&](VertexId v) { return W::distance(states[v], states[goal]); };
  const auto nothing = [](VertexId) { return 0.0; };
  state.resize(graph.vertex_count());
  SearchResult result;
  switch (options.search) {
    case SearchKind::bfs:
      result = breadth_first(graph, start, goal, state);
      break;
    case SearchKind::dfs:
      result = depth_first(graph, start, goal, state);
      break;
    case SearchKind::dijkstra:
      result = with_queue(options.queue, graph.vertex_count(), [&](auto& queue) {
        return best_first(start, goal, neighbours, nothing, queue, state, should_stop);
      });
      break;
    case SearchKind::astar:
      result = with_queue(options.queue, graph.vertex_count(), [&](auto& queue) {
        return best_first(start, goal, neighbours, to_goal, queue, state, should_stop);
      });
      break;
  }
  if (result.status == SearchStatus::stopped) execution.check();
  return result;
}

}  // namespace warren
