// SPDX-License-Identifier: BSD-3-Clause
// The one place where a search of a graph and its queue are chosen, once a search.
// And the rounds of core/search/bidirectional_search.hpp with a thread for each side: the same path, length and counts
// as on one thread. The first rounds are too short to pay for a thread.
#pragma once

#include <cstddef>

#include "core/run/execution.hpp"
#include "core/search/bidirectional_search.hpp"
#include "core/search/search.hpp"
#include "core/search/search_queues.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/roadmap_options.hpp"

namespace warren {

/// An array kept in order: one insertion costs as much as thousands into a heap, so each looks at the deadline.
template <class Queue>
class PolledArray : public Queue {
 public:
  explicit PolledArray(const Execution& execution) : execution_(&execution) {}
  void push(VertexId v, double key) {
    execution_->check();
    Queue::push(v, key);
  }

 private:
  const Execution* execution_;
};

/// Calls f with an empty queue of the kind, ready for vertex_count vertices. Throws Stopped.
template <class F>
auto with_queue(QueueKind kind, std::size_t vertex_count, const Execution& execution, const F& f) {
  const auto call = [&](auto queue) {
    queue.resize(vertex_count, [&] { execution.check(); });
    return f(queue);
  };
  if (kind == QueueKind::heap) return call(IndexedHeap<4>());
  if (kind == QueueKind::lazy_heap) return call(LazyHeap());
  if (kind == QueueKind::sorted_array) return call(PolledArray<SortedArray>(execution));
  return call(PolledArray<ResortedArray>(execution));
}

/// A vertex of a search that has all of them in its heap: its way and parent, its place in the heap and its entry.
inline constexpr std::size_t searched_bytes = sizeof(double) + 2 * sizeof(VertexId) + sizeof(QueueEntry);

/// Asks for what a search of so many vertices takes, its queue included, where the state has to grow. Throws Stopped.
inline void ask_room(const SearchState& state, std::size_t vertex_count, std::size_t bytes_a_vertex,
                     const Execution& execution) {
  if (state.vertex_count() < vertex_count) execution.reserve(vertex_count * bytes_a_vertex);
}

/// A* or Dijkstra, by the estimate, over vertex_count vertices, which the state is sized for. Whether it was stopped is
/// in the result; sizing throws Stopped.
template <class Neighbours, class Estimate>
SearchResult search_best_first(QueueKind kind, std::size_t vertex_count, VertexId start, VertexId goal,
                               const Neighbours& neighbours, const Estimate& estimate, SearchState& state,
                               const Execution& execution) {
  ask_room(state, vertex_count, searched_bytes, execution);
  state.resize(vertex_count, [&] { execution.check(); });
  return with_queue(kind, vertex_count, execution, [&](auto& queue) {
    return best_first(start, goal, neighbours, estimate, queue, state, [&] { return execution.should_stop(); });
  });
}

/// The blind search of this kind, as search_best_first.
inline SearchResult search_blindly(SearchKind search, const Graph& graph, VertexId start, VertexId goal,
                                   SearchState& state, const Execution& execution) {
  constexpr std::size_t bytes_a_vertex = 24;  // the state's 12, and 8 of the deepest path, more while its list moves
  ask_room(state, graph.vertex_count(), bytes_a_vertex, execution);
  state.resize(graph.vertex_count(), [&] { execution.check(); });
  const auto should_stop = [&] { return execution.should_stop(); };
  return search == SearchKind::bfs ? breadth_first(graph, start, goal, state, should_stop)
                                   : depth_first(graph, start, goal, state, should_stop);
}

/// Both sides, on two threads where execution.threads allows it. Throws what a side's callables throw.
template <class Forward, class Backward>
SearchResult bidirectional(Forward& forward, Backward& backward, const Execution& execution) {
  constexpr std::uint64_t rounds_alone = 5;
  const auto together = [&](std::uint64_t round, const auto& first, const auto& second) {
    round < rounds_alone ? InTurn()(round, first, second) : run_both(execution, first, second);
  };
  return bidirectional(
      forward, backward, [&] { return execution.should_stop(); }, together);
}

}  // namespace warren
