// SPDX-License-Identifier: BSD-3-Clause
// Builds a Graph in parallel from the parts that the chunks of an earlier loop left behind. Rows are ascending and the
// arrays are the same bits for any thread count. And what is made of graphs: parts of them, and their components.
//
// Vertices are cut into blocks (a power of two, at most 2048 blocks). The longest run of leading parts in which `from`
// ascends and from < to is cut at the block borders, so that a block's upper halves (from -> to) are its own run of
// edges. A lower half (to -> from) that stays in its block is found there too; the few that leave it, and both halves
// of all edges in the remaining, unordered parts, are routed to their block by two passes over the edges (count,
// place). Each block then counts and fills its rows in cache with one cursor a row: routed lower halves come first,
// then those of the block, then the upper halves, so that ordered input needs no sort; rows found out of order are
// sorted.
//
// No atomics. O(E + V), one sort of each unordered row. Memory: offsets and targets (4 bytes a vertex, 8 an edge), 8
// bytes a routed half while building, at most 16 MiB of counts; the parts stay with the caller. Cost on a lattice in
// tile order: see docs/performance.md and bench/graph_bench.cpp.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/search/graph.hpp"
#include "parallel/chunks.hpp"

namespace warren {

/// Parts: any edges (duplicates are kept), ends below vertex_count and different; fastest when `from` ascends over the
/// concatenation, from < to, and each `to` ascends within its `from`. Extra edges, of a start and goal say, follow as a
/// last part. Throws InputError for an end out of range, a loop, or more than 2^32 - 1 edge ends (before allocating).
Graph assemble_graph(std::size_t vertex_count, std::span<const RawVector<Edge>> parts, const Execution& execution);
/// The same of one list of edges.
Graph assemble_graph(std::size_t vertex_count, std::span<const Edge> edges, const Execution& execution);

/// The graph with lengths: length(v, w) is called once an edge end, by several threads at once. Throws Stopped.
template <class Length>
Graph with_lengths(Graph graph, const Execution& execution, const Length& length) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  execution.reserve(graph.targets().size() * sizeof(double));
  RawVector<double> lengths(graph.targets().size());
  for_each_index<VertexId>(graph.vertex_count(), grain, execution, [&](VertexId v) {
    std::size_t end = graph.first_end(v);
    for (const VertexId w : graph.neighbours(v)) lengths[end++] = length(v, w);
  });
  return std::move(graph).with_lengths(std::move(lengths));
}

/// The edges of a graph for which is_free(end), and more, which ascend and may join further vertices, each in the row
/// of its begin.
template <class IsFree>
Graph part_with_edges(const Graph& all, const IsFree& is_free, std::size_t vertex_count, std::span<const Edge> more,
                      const Execution& execution) {
  RawVector<EdgeEnd> offsets(vertex_count + 1);
  RawVector<VertexId> targets;
  targets.reserve(all.targets().size() + more.size());
  auto next = more.begin();
  for (VertexId v = 0; v < vertex_count; ++v) {
    execution.poll(v);
    offsets[v] = static_cast<EdgeEnd>(targets.size());
    if (v < all.vertex_count()) {
      std::size_t end = all.first_end(v);
      for (const VertexId w : all.neighbours(v)) {
        if (is_free(end++)) targets.push_back(w);
      }
    }
    for (; next != more.end() && next->from == v; ++next) targets.push_back(next->to);
  }
  offsets[vertex_count] = static_cast<EdgeEnd>(targets.size());
  return {std::move(offsets), std::move(targets)};
}

/// The graph of edges that lead one way: each stands in the row of its begin alone, in any order.
Graph one_way_graph(std::size_t vertex_count, std::span<const RawVector<Edge>> edges, const Execution& execution);
/// The edges of a graph that are free.
Graph free_part(const Graph& candidates, std::span<const std::uint64_t> edge_states, const Execution& execution);

/// Of a graph whose edges lead from a row to its targets: what `from` reaches has its label, and what reaches `to` has
/// that of `to`.
Components reached_and_reaching(const Graph& graph, VertexId from, VertexId to, const Execution& execution);

/// Connected components on all cores: label[v] is the smallest vertex of v's component, the same as by
/// bench/plain_graph.hpp. O(E α(V)); memory: the labels.
Components components(const Graph& graph, const Execution& execution);

/// Union-find that many threads work on at once without a lock: the larger root is hung under the smaller one with
/// compare-and-swap, and whoever looks for a root halves the path to it. Invariants: parent[v] <= v, and a vertex that
/// is no root never becomes one again. So the root of a tree is its smallest vertex at all times, whatever the order of
/// unions. Only the parents pass between threads, no other memory depends on them: relaxed order is enough. Refers to
/// parents that live elsewhere, where each vertex is its own at first. Any threads may call all of it.
class UnionForest {
 public:
  explicit UnionForest(std::span<VertexId> parent) : parent_(parent) {}

  VertexId parent(VertexId v) const { return std::atomic_ref(parent_[v]).load(std::memory_order_relaxed); }
  VertexId root(VertexId v) const {
    for (VertexId p = parent(v); p != v; p = parent(v)) {
      const VertexId above = parent(p);
      if (above == p) return p;
      std::atomic_ref(parent_[v]).store(above, std::memory_order_relaxed);  // path halving: an ancestor stays one
      v = above;
    }
    return v;
  }
  /// The root without writing on the way: another vertex may hold its final label already.
  VertexId root_of(VertexId v) const {
    for (VertexId p = parent(v); p != v; p = parent(v)) v = p;
    return v;
  }
  void join(VertexId a, VertexId b) const {
    if (parent(a) == parent(b)) return;  // most edges of a graph join what is one tree already
    for (;;) {
      a = root(a);
      b = root(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      VertexId expected = a;  // fails when another thread has hung this root meanwhile: look again
      if (std::atomic_ref(parent_[a]).compare_exchange_strong(expected, b, std::memory_order_relaxed)) return;
    }
  }

 private:
  std::span<VertexId> parent_;
};

/// Which of 0 .. n - 1 hang together: each(v, join) calls join(w) for those that v is joined with, of each pair for one
/// of the two at least. For each the smallest one of its set, whatever the order of the unions. Throws Stopped.
template <class Each>
RawVector<VertexId> joined_labels(std::size_t n, const Execution& execution, const Each& each) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  execution.reserve(n * sizeof(VertexId));
  RawVector<VertexId> label(n);
  for_each_index<VertexId>(n, grain, execution.quiet(), [&](VertexId v) { label[v] = v; });
  const UnionForest forest(label);
  for_each_index<VertexId>(n, grain, execution, [&](VertexId v) { each(v, [&](VertexId w) { forest.join(v, w); }); });
  for_each_index<VertexId>(n, grain, execution.quiet(), [&](VertexId v) {
    std::atomic_ref(label[v]).store(forest.root_of(v), std::memory_order_relaxed);
  });
  return label;
}

}  // namespace warren
