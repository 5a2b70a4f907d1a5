// SPDX-License-Identifier: BSD-3-Clause
// One search for explicit and implicit graphs: A* (Hart, Nilsson, Raphael 1968), Dijkstra (A* with a zero heuristic),
// and breadth- and depth-first search.
//
// A graph is any callable neighbours(v, visit) that calls visit(w, length) for each neighbour in ascending order; a
// lazily checked roadmap tests an edge there, and improves(w, g) tells it before the test whether the edge could help.
// Heuristics must be consistent, so that each vertex is settled once. Ties break by vertex number, therefore the path
// and the counts don't depend on the queue. Time O((V + E) log V); memory 16 bytes a vertex and the queue.
#pragma once

#include <cassert>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/graph.hpp"
#include "core/indexed_heap.hpp"
#include "core/raw_vector.hpp"

namespace warren {

enum class SearchStatus : std::uint8_t { found, exhausted, stopped };

struct SearchResult {
  SearchStatus status = SearchStatus::exhausted;
  std::vector<VertexId> path;  ///< start to goal; empty unless found
  double length = 0.0;
  std::uint64_t expanded = 0;  ///< vertices settled, the goal included
};

/// Distances and parents of one search, as arrays. Clearing costs only what was touched.
class SearchState {
 public:
  void resize(std::size_t vertex_count) {
    g_.assign(vertex_count, unreached);
    parent_.resize(vertex_count);
    closed_.assign(vertex_count, 0);
    touched_.clear();
  }
  void clear() {
    for (const VertexId v : touched_) {
      g_[v] = unreached;
      closed_[v] = 0;
    }
    touched_.clear();
  }
  double g(VertexId v) const { return g_[v]; }
  bool reached(VertexId v) const { return g_[v] != unreached; }
  bool closed(VertexId v) const { return closed_[v] != 0; }
  VertexId parent(VertexId v) const { return parent_[v]; }
  std::size_t vertex_count() const { return g_.size(); }

  void reach(VertexId v, double g, VertexId parent) {
    if (!reached(v)) touched_.push_back(v);
    g_[v] = g;
    parent_[v] = parent;
  }
  void close(VertexId v) { closed_[v] = 1; }

  /// The vertices from start to v along the parents.
  std::vector<VertexId> path_to(VertexId v) const;
  /// Vertices that the search has reached, in the order of first touch: the search tree, for pictures.
  const std::vector<VertexId>& touched() const { return touched_; }

 private:
  static constexpr double unreached = std::numeric_limits<double>::infinity();
  RawVector<double> g_;
  RawVector<VertexId> parent_;
  RawVector<std::uint8_t> closed_;
  std::vector<VertexId> touched_;
};

/// A* from start to goal. state and queue must be cleared and sized for all vertices; should_stop() is asked every
/// 1024 expansions. The heuristic is called once a vertex push.
template <class Queue, class Neighbours, class Heuristic, class ShouldStop>
SearchResult best_first(VertexId start, VertexId goal, const Neighbours& neighbours, const Heuristic& heuristic,
                        Queue& queue, SearchState& state, const ShouldStop& should_stop) {
  SearchResult result;
  state.reach(start, 0.0, no_vertex);
  queue.push(start, heuristic(start));
  while (!queue.empty()) {
    const VertexId v = queue.pop().vertex;
    if (state.closed(v)) continue;  // a stale entry of a queue without decrease-key
    state.close(v);
    ++result.expanded;
    if (v == goal) {
      result.status = SearchStatus::found;
      result.length = state.g(v);
      result.path = state.path_to(v);
      return result;
    }
    if (result.expanded % 1024 == 0 && should_stop()) {
      result.status = SearchStatus::stopped;
      return result;
    }
    const double g = state.g(v);
    neighbours(v, [&](VertexId w, double length) {
      const double through = g + length;
      if (state.closed(w) || through >= state.g(w)) return;
      state.reach(w, through, v);
      queue.push(w, through + heuristic(w));
    });
  }
  return result;
}

/// Fewest edges; neighbours in the graph's order; a vertex is marked when it is queued. length is left 0.
SearchResult breadth_first(const Graph& graph, VertexId start, VertexId goal, SearchState& state);
/// Some path: the last vertex found is expanded first, neighbours in the graph's order. length is left 0.
SearchResult depth_first(const Graph& graph, VertexId start, VertexId goal, SearchState& state);

}  // namespace warren
