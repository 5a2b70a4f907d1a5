// SPDX-License-Identifier: BSD-3-Clause
// Lazy PRM as Bohlin and Kavraki describe it (ICRA 2000): search a graph whose edges are assumed free, check the edges
// of the path that is found, drop the bad ones, repair, repeat.
//
// The repair is local: dropping the tree edge into v takes only v's subtree out of the search tree; its vertices are
// attached again from settled neighbours outside and put back into the queue (Ramalingam and Reps, J. Algorithms 21,
// 1996, for A*). What stays settled keeps its distance, because dropping edges never shortens a path. The queue is a
// heap with stale entries: an entry counts only while its key is its vertex's present one.
// Time: one A*, plus O(subtree degree log) a dropped edge. Memory: 13 bytes a vertex, 1 an edge end.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/world.hpp"
#include "core/search/graph.hpp"
#include "core/search/search_queues.hpp"
#include "parallel/execution.hpp"

namespace warren {

template <World W>
class LazyPathSearch {
 public:
  using State = typename W::State;
  /// The graph's candidate edges are unchecked but for those in `checked` (start's and goal's).
  LazyPathSearch(const W& world, const Graph& graph, std::span<const State> states, VertexId start, VertexId goal,
                 const Execution& execution)
      : world_(world),
        graph_(graph),
        states_(states),
        start_(start),
        goal_(goal),
        execution_(execution),
        query_(world.make_query()),
        g_(graph.vertex_count(), unreached),
        parent_(graph.vertex_count(), no_vertex),
        closed_(graph.vertex_count(), 0),
        status_(graph.vertex_count()) {
    for (VertexId v = 0; v < graph.vertex_count(); ++v) status_[v].assign(graph.degree(v), unknown);
    g_[start] = 0.0;
    queue_.push(start, key(start));
  }

  /// The shortest path all of whose edges are free, as vertices; empty if there is none. Throws Stopped.
  RawVector<VertexId> run() {
    while (settle_goal()) {
      RawVector<VertexId> path;
      for (VertexId v = goal_; v != no_vertex; v = parent_[v]) path.push_back(v);
      std::reverse(path.begin(), path.end());
      if (check(path)) return path;
      ++repairs_;
    }
    return {};
  }

  std::uint64_t expanded() const { return expanded_; }
  std::uint64_t checked() const { return checked_; }
  std::uint64_t repairs() const { return repairs_; }
  const std::vector<Edge>& free_edges() const { return free_; }
  bool reached(VertexId v) const { return g_[v] != unreached; }
  VertexId parent(VertexId v) const { return parent_[v]; }

 private:
  enum Status : std::uint8_t { unknown, free, blocked };
  static constexpr double unreached = std::numeric_limits<double>::infinity();

  double key(VertexId v) const { return g_[v] + world_.distance(states_[v], states_[goal_]); }
  double length(VertexId v, VertexId w) const { return world_.distance(states_[v], states_[w]); }

  bool settle_goal();
  bool check(std::span<const VertexId> path);
  bool is_free(VertexId v, VertexId w);
  std::uint8_t& status(VertexId v, VertexId w) {
    const auto row = graph_.neighbours(v);
    return status_[v][static_cast<std::size_t>(std::lower_bound(row.begin(), row.end(), w) - row.begin())];
  }
  void drop_blocked_around(VertexId v);
  void drop_subtree(VertexId root);
  void attach(VertexId v);

  const W& world_;
  const Graph& graph_;
  std::span<const State> states_;
  VertexId start_;
  VertexId goal_;
  const Execution& execution_;
  typename W::Query query_;
  LazyHeap queue_;
  std::vector<double> g_;
  std::vector<VertexId> parent_;
  std::vector<std::uint8_t> closed_;
  std::vector<std::vector<std::uint8_t>> status_;
  std::vector<Edge> free_;
  std::uint64_t expanded_ = 0;
  std::uint64_t checked_ = 0;
  std::uint64_t repairs_ = 0;
};

template <World W>
bool LazyPathSearch<W>::settle_goal() {
  while (closed_[goal_] == 0 && !queue_.empty()) {
    const auto [entry_key, v] = queue_.pop();
    if (closed_[v] != 0 || g_[v] == unreached || entry_key != key(v)) continue;
    closed_[v] = 1;
    if (++expanded_ % 1024 == 0) execution_.check();
    const auto row = graph_.neighbours(v);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const VertexId w = row[i];
      const double through = g_[v] + length(v, w);
      if (status_[v][i] == blocked || closed_[w] != 0 || through >= g_[w]) continue;
      g_[w] = through;
      parent_[w] = v;
      queue_.push(w, key(w));
    }
  }
  return closed_[goal_] != 0;
}

/// Checks all edges of a path from the goal's end and drops the blocked ones: small subtrees first.
template <World W>
bool LazyPathSearch<W>::check(std::span<const VertexId> path) {
  bool all_free = true;
  for (std::size_t i = path.size() - 1; i > 0; --i) {
    if (is_free(path[i - 1], path[i])) continue;
    all_free = false;
    drop_blocked_around(path[i]);
    drop_blocked_around(path[i - 1]);
  }
  return all_free;
}

/// Where one motion of a milestone is blocked, more are: checks them all, and drops the blocked ones of the tree.
template <World W>
void LazyPathSearch<W>::drop_blocked_around(VertexId v) {
  for (const VertexId w : graph_.neighbours(v)) {
    if (is_free(v, w)) continue;
    if (parent_[v] == w) drop_subtree(v);
    if (parent_[w] == v) drop_subtree(w);
  }
}

template <World W>
bool LazyPathSearch<W>::is_free(VertexId v, VertexId w) {
  std::uint8_t& there = status(v, w);
  if (there == unknown) {
    ++checked_;
    if (checked_ % 1024 == 0) execution_.check();
    const Edge edge{std::min(v, w), std::max(v, w)};
    there = world_.is_free_motion(states_[edge.from], states_[edge.to], query_) ? free : blocked;
    status(w, v) = there;
    if (there == free) free_.push_back(edge);
  }
  return there == free;
}

template <World W>
void LazyPathSearch<W>::drop_subtree(VertexId root) {
  std::vector<VertexId> subtree{root};
  for (std::size_t i = 0; i < subtree.size(); ++i) {
    for (const VertexId w : graph_.neighbours(subtree[i])) {
      if (parent_[w] == subtree[i]) subtree.push_back(w);
    }
    closed_[subtree[i]] = 0;
    g_[subtree[i]] = unreached;
  }
  for (const VertexId v : subtree) parent_[v] = no_vertex;
  for (const VertexId v : subtree) attach(v);
}

/// Reaches v from the best settled neighbour; vertices of a dropped subtree are not settled, so they don't count.
template <World W>
void LazyPathSearch<W>::attach(VertexId v) {
  const auto row = graph_.neighbours(v);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const VertexId w = row[i];
    if (status_[v][i] == blocked || closed_[w] == 0 || g_[w] + length(w, v) >= g_[v]) continue;
    g_[v] = g_[w] + length(w, v);
    parent_[v] = w;
  }
  if (parent_[v] != no_vertex) queue_.push(v, key(v));
}

}  // namespace warren
