// SPDX-License-Identifier: BSD-3-Clause
// One search for explicit and implicit graphs: A* (Hart, Nilsson, Raphael 1968), which is best_first(), Dijkstra (A*
// with a zero heuristic), and breadth- and depth-first search. From both ends: bidirectional_search.hpp. Of roadmaps
// the queue is IndexedHeap<4> unless --queue says otherwise (planners/graph/roadmap_search.hpp), the heuristic the
// straight line or the world's metric (estimated_way() in planners/graph/roadmap_options.hpp); from 50,000 vertices on
// both ends search (planners/graph/roadmap_search.cpp). Maps take a BucketQueue and heuristics of their own
// (planners/grid). Loops of their own have cars on grids (ARA*, planners/grid/motion_lattice.hpp), fields of prices
// (price_field there), classes of paths (path_classes), overlays of mazes (planners/mazes/overlay), polyanya
// (planners/vertical_cells), discs' paths (planners/visibility), redrive (planners/shorten) and the judge's bounds.
//
// A graph is any callable neighbours(v, visit) that calls visit(w, length) for each neighbour in ascending order; a
// lazily checked roadmap tests an edge there, and asks visit.wants(w, length) first, whether an edge of at least this
// length could help.
// Heuristics must be consistent (by others the path may be longer) and lengths non-negative, so that each vertex is
// settled once. Ties break by vertex number, therefore the path and the counts don't depend on the queue. Time O((V +
// E) log V); memory 12 bytes a vertex and the queue.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/function_ref.hpp"
#include "core/base/raw_vector.hpp"
#include "core/search/graph.hpp"

namespace warren {

enum class SearchStatus : std::uint8_t { found, exhausted, stopped };

struct SearchResult {
  SearchStatus status = SearchStatus::exhausted;
  RawVector<VertexId> path;  ///< start to goal; empty unless found
  double length = 0.0;
  std::uint64_t expanded = 0;   ///< vertices settled, the goal included
  std::uint64_t pushes = 0;     ///< vertices that came into the queue; of breadth- and depth-first search 0
  std::uint64_t decreases = 0;  ///< times that one in the queue got a shorter way
};

/// Distances and parents of one search, as arrays. A settled vertex keeps its distance with the sign bit set, so that
/// one load answers "settled, or no farther than this" at once. Touched vertices are remembered by blocks of 64:
/// clearing costs only the blocks that the last search touched.
class SearchState {
 public:
  /// Clears, and makes room for vertices 0 .. vertex_count - 1; costs O(vertex_count) only where it grows, and then
  /// calls poll() in between, which may throw.
  template <class Poll = NoPoll>
  void resize(std::size_t vertex_count, const Poll& poll = {}) {
    clear();
    if (vertex_count > g_.size()) {
      vertex_count_ = 0;
      assign_polled(g_, vertex_count, unreached, poll);
      parent_.resize(vertex_count);
      is_touched_.assign((vertex_count + block_size - 1) / block_size, 0);
    }
    vertex_count_ = vertex_count;
  }
  void clear() {
    for (const VertexId block : touched_blocks_) {
      is_touched_[block] = 0;
      const std::size_t first = block * block_size;
      std::fill(g_.begin() + static_cast<std::ptrdiff_t>(first),
                g_.begin() + static_cast<std::ptrdiff_t>(std::min(first + block_size, g_.size())), unreached);
    }
    touched_blocks_.clear();
  }
  double g(VertexId v) const { return std::abs(g_[v]); }
  bool reached(VertexId v) const { return g_[v] != unreached; }
  bool closed(VertexId v) const { return std::signbit(g_[v]); }
  /// Is v open or unreached, and would a path of this length (>= 0) be shorter than the one it has?
  bool improves(VertexId v, double through) const { return through < g_[v]; }
  /// What improves() compares with, of all vertices at once: infinity, the way's length, or minus that where it is
  /// settled.
  std::span<const double> labels() const { return g_; }
  VertexId parent(VertexId v) const { return parent_[v]; }
  std::size_t vertex_count() const { return vertex_count_; }

  void reach(VertexId v, double g, VertexId parent) {
    std::uint8_t& is_touched = is_touched_[v / block_size];
    if (is_touched == 0) {
      is_touched = 1;
      touched_blocks_.push_back(static_cast<VertexId>(v / block_size));
    }
    g_[v] = g;
    parent_[v] = parent;
  }
  /// Asks for what the others read of v, ahead of time.
  void fetch(VertexId v) const { __builtin_prefetch(g_.data() + v); }
  void close(VertexId v) { g_[v] = -g(v); }  // -0.0 for the start: closed() reads the sign bit

  /// The vertices from start to v along the parents.
  RawVector<VertexId> path_to(VertexId v) const {
    RawVector<VertexId> path;
    for (; v != no_vertex; v = parent_[v]) path.push_back(v);
    std::reverse(path.begin(), path.end());
    return path;
  }
  /// Vertices that the search has reached, ascending: the search tree, for pictures. O(touched blocks log).
  std::vector<VertexId> touched() const {
    std::vector<VertexId> blocks = touched_blocks_;
    std::sort(blocks.begin(), blocks.end());
    std::vector<VertexId> vertices;
    for (const VertexId block : blocks) {
      const auto first = static_cast<VertexId>(block * block_size);
      for (VertexId v = first; v < vertex_count_ && v < first + block_size; ++v) {
        if (reached(v)) vertices.push_back(v);
      }
    }
    return vertices;
  }

 private:
  static constexpr double unreached = std::numeric_limits<double>::infinity();
  static constexpr std::size_t block_size = 64;
  std::size_t vertex_count_ = 0;
  RawVector<double> g_;
  RawVector<VertexId> parent_;
  std::vector<std::uint8_t> is_touched_;  // one a block
  std::vector<VertexId> touched_blocks_;
};

/// How many expansions pass between two looks at should_stop(): few, for a vertex may have ten thousand neighbours.
inline constexpr std::uint64_t expansions_per_poll = 128;

/// For callers without a deadline.
struct NeverStop {
  bool operator()() const { return false; }
};

/// A search's visit, whatever its queue and its heuristic, for graphs whose expansion is dear: they are compiled once,
/// not once a search. What is asked for each edge is answered here; an edge that helps costs a call.
class AnyVisit {
 public:
  template <class Visit>
  AnyVisit(const Visit& visit)  // NOLINT(google-explicit-constructor): searches call with their own
      : labels_(visit.labels()),
        settled_elsewhere_(visit.settled_elsewhere()),
        through_(visit.through()),
        take_(visit) {}
  bool wants(VertexId w, double length) const {
    return through_ + length < labels_[w] && (settled_elsewhere_ == nullptr || settled_elsewhere_[w] == 0);
  }
  std::span<const double> labels() const { return labels_; }
  void operator()(VertexId w, double length) const { take_(w, length); }

 private:
  std::span<const double> labels_;
  const std::uint8_t* settled_elsewhere_;  // by the other side of a search from both ends, a byte a vertex; or nullptr
  double through_;
  FunctionRef<void(VertexId, double)> take_;
};

/// The graph of such a search: graph(v, AnyVisit).
using AnyNeighbours = FunctionRef<void(VertexId, const AnyVisit&)>;

/// A* from start to goal. state and queue must be cleared and sized for all vertices; should_stop() is asked every
/// expansions_per_poll of them, and of stale entries. The heuristic is called once a vertex push.
template <class Queue, class Neighbours, class Heuristic, class ShouldStop>
SearchResult best_first(VertexId start, VertexId goal, const Neighbours& neighbours, const Heuristic& heuristic,
                        Queue& queue, SearchState& state, const ShouldStop& should_stop) {
  struct Visit {
    SearchState& state;
    Queue& queue;
    const Heuristic& heuristic;
    SearchResult& result;
    VertexId from;
    double g;
    bool wants(VertexId w, double length) const { return state.improves(w, g + length); }
    double through() const { return g; }
    std::span<const double> labels() const { return state.labels(); }
    const std::uint8_t* settled_elsewhere() const { return nullptr; }
    void operator()(VertexId w, double length) const {
      if (!wants(w, length)) return;
      ++(state.reached(w) ? result.decreases : result.pushes);
      state.reach(w, g + length, from);
      queue.push(w, g + length + heuristic(w));
    }
  };
  SearchResult result;
  std::uint64_t stale = 0;
  state.reach(start, 0.0, no_vertex);
  queue.push(start, heuristic(start));
  ++result.pushes;
  while (!queue.empty()) {
    const VertexId v = queue.pop().vertex;
    if (state.closed(v)) {  // a stale entry of a queue without decrease-key
      if (++stale % expansions_per_poll != 0 || !should_stop()) continue;
      result.status = SearchStatus::stopped;
      return result;
    }
    state.close(v);
    ++result.expanded;
    if (v == goal) {
      result.status = SearchStatus::found;
      result.length = state.g(v);
      result.path = state.path_to(v);
      return result;
    }
    if (result.expanded % expansions_per_poll == 0 && should_stop()) {
      result.status = SearchStatus::stopped;
      return result;
    }
    neighbours(v, Visit{state, queue, heuristic, result, v, state.g(v)});
  }
  return result;
}

/// Fewest edges; neighbours in the graph's order; a vertex is marked when it is queued. length is left 0; state.g()
/// counts edges. O(V + E); 4 bytes a vertex reached beside the state.
template <class ShouldStop = NeverStop>
SearchResult breadth_first(const Graph& graph, VertexId start, VertexId goal, SearchState& state,
                           const ShouldStop& should_stop = {}) {
  SearchResult result;
  std::vector<VertexId> queue{start};
  state.reach(start, 0.0, no_vertex);
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const VertexId v = queue[head];
    ++result.expanded;
    if (v == goal) {
      result.status = SearchStatus::found;
      result.path = state.path_to(v);
      return result;
    }
    if (result.expanded % expansions_per_poll == 0 && should_stop()) {
      result.status = SearchStatus::stopped;
      return result;
    }
    for (const VertexId w : graph.neighbours(v)) {
      if (state.reached(w)) continue;
      state.reach(w, state.g(v) + 1.0, v);
      queue.push_back(w);
    }
  }
  return result;
}

/// Some path: the last vertex found is expanded first, neighbours in the graph's order. length is left 0; state.g()
/// counts edges. O(V + E); 8 bytes a vertex of the deepest path beside the state.
template <class ShouldStop = NeverStop>
SearchResult depth_first(const Graph& graph, VertexId start, VertexId goal, SearchState& state,
                         const ShouldStop& should_stop = {}) {
  struct Frame {
    VertexId vertex;
    std::uint32_t next;  // how many of its neighbours have been looked at
  };
  SearchResult result;
  std::vector<Frame> stack;
  const auto enter = [&](VertexId v, VertexId parent) {
    state.reach(v, static_cast<double>(stack.size()), parent);
    stack.push_back({v, 0});
    ++result.expanded;
    if (v == goal) result.status = SearchStatus::found;
    if (result.expanded % expansions_per_poll == 0 && should_stop()) result.status = SearchStatus::stopped;
  };
  enter(start, no_vertex);
  while (!stack.empty() && result.status == SearchStatus::exhausted) {
    Frame& top = stack.back();
    const std::span<const VertexId> neighbours = graph.neighbours(top.vertex);
    while (top.next < neighbours.size() && state.reached(neighbours[top.next])) ++top.next;
    if (top.next == neighbours.size()) {
      stack.pop_back();
    } else {
      const VertexId v = top.vertex;
      enter(neighbours[top.next++], v);
    }
  }
  if (result.status == SearchStatus::found) result.path = state.path_to(goal);
  return result;
}

}  // namespace warren
