// SPDX-License-Identifier: BSD-3-Clause
// The exact reduction that shortest paths allow: dead ends are peeled (vertices of degree 1, again and again) and
// chains of degree-2 vertices become one edge, so that a search runs on the junctions alone. On a perfect maze only the
// path is left; where every doorway is crossed by several edges (uniform sampling) nothing is, and the reduction only
// costs.
//
// Peeling: each block of vertices first peels what has all its neighbours in the block, in cache and without atomics;
// then all threads together follow the dead ends that are left across the blocks. What is left is the same in any
// order: the largest set in which all but the kept vertices have degree 2 or more. Its vertices of another degree than
// 2, and the kept ones, are the *keys*; each key follows its chains by itself, so a chain is walked once from either
// end. Loops and all but the shortest chain between two keys are dropped (ties: the smaller first vertex).
//
// O(V + E). Memory: 1.2 bytes a vertex, and 20 bytes an edge end of the reduced graph. Measured in
// bench/search_bench.cpp.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/graph.hpp"
#include "parallel/chunks.hpp"

namespace warren {

/// Which vertices of a graph are left, and which of them are keys. Refers to the graph.
class KeyCoverView {
 public:
  /// keep: vertices that must stay (start and goal); any number, in any order.
  KeyCoverView(const Graph& graph, std::span<const VertexId> keep, const Execution& execution);

  std::size_t key_count() const { return rank_.back(); }
  bool is_key(VertexId v) const { return (keys_[v / 64] >> v % 64 & 1U) != 0; }
  bool is_left(VertexId v) const { return left_[v] != 0; }
  /// Number of a key among the keys, ascending.
  VertexId rank(VertexId key) const {
    return rank_[key / 64] +
           static_cast<VertexId>(std::popcount(keys_[key / 64] & ((std::uint64_t{1} << key % 64) - 1)));
  }
  /// The vertex after `at` on a chain that was entered from `before`; `at` is no key.
  VertexId next_on_chain(VertexId before, VertexId at) const {
    for (const VertexId w : graph_->neighbours(at)) {
      if (w != before && is_left(w)) return w;
    }
    return no_vertex;
  }
  const Graph& graph() const { return *graph_; }

 private:
  std::vector<VertexId> peel_block(Range block);
  void peel_across(VertexId seed, const Execution& execution);
  void mark_keys(Range block);

  const Graph* graph_;
  RawVector<std::uint8_t> left_;   // 0 peeled, 1 left, 2 left and never to be peeled
  RawVector<std::uint64_t> keys_;  // one bit a vertex
  RawVector<VertexId> rank_;       // keys before each word of keys_, and all
};

/// The keys as a graph with lengths. Refers to the graph that it was made from. Any number of threads may read.
class ReducedGraphView {
 public:
  /// One edge end of a key: number of the key at the other end, length of the chain, and its first vertex.
  struct Chain {
    VertexId target;
    VertexId via;
    double length;
  };
  ReducedGraphView(KeyCoverView cover, const std::vector<std::vector<Chain>>& parts, RawVector<EdgeEnd> degrees,
                   const Execution& execution);

  const Graph& graph() const { return reduced_; }  ///< vertices are numbers of keys
  VertexId vertex_of(VertexId key) const { return vertices_[key]; }
  /// The key with this vertex, which must be a key: start and goal always are.
  VertexId key_of(VertexId vertex) const { return cover_.rank(vertex); }
  bool is_key(VertexId vertex) const { return cover_.is_key(vertex); }
  /// A path over keys as the path over vertices that it stands for. O(path).
  std::vector<VertexId> expand(std::span<const VertexId> keys, const Execution& execution) const;

 private:
  KeyCoverView cover_;
  Graph reduced_;
  RawVector<VertexId> via_;       // of each edge end: first vertex of its chain
  RawVector<VertexId> vertices_;  // of each key
};

namespace detail {
inline constexpr std::size_t reduce_grain = std::size_t{1} << 14;  // a multiple of 64: key words are not shared
inline constexpr std::size_t steps_per_poll = std::size_t{1} << 18;

/// Follows the chain that leaves `key` towards `via`.
template <class Length>
ReducedGraphView::Chain follow_chain(const KeyCoverView& cover, VertexId key, VertexId via, const Length& length,
                                     const Execution& execution) {
  double sum = length(key, via);
  VertexId before = key;
  VertexId at = via;
  for (std::size_t steps = 1; !cover.is_key(at); ++steps) {
    if (steps % steps_per_poll == 0) execution.check();
    const VertexId next = cover.next_on_chain(before, at);
    sum += length(at, next);
    before = at;
    at = next;
  }
  return {cover.rank(at), via, sum};
}

/// Appends the row of a key: one chain to each other key, ascending.
template <class Length>
void append_row(const KeyCoverView& cover, VertexId key, const Length& length, const Execution& execution,
                std::vector<ReducedGraphView::Chain>& row, std::vector<ReducedGraphView::Chain>& part) {
  using Chain = ReducedGraphView::Chain;
  row.clear();
  for (const VertexId via : cover.graph().neighbours(key)) {
    if (cover.is_left(via)) row.push_back(follow_chain(cover, key, via, length, execution));
  }
  const VertexId self = cover.rank(key);
  std::erase_if(row, [self](const Chain& chain) { return chain.target == self; });
  std::sort(row.begin(), row.end(), [](const Chain& a, const Chain& b) {
    if (a.target != b.target) return a.target < b.target;
    return a.length != b.length ? a.length < b.length : a.via < b.via;
  });
  const auto same_target = [](const Chain& a, const Chain& b) { return a.target == b.target; };
  row.erase(std::unique(row.begin(), row.end(), same_target), row.end());
  part.insert(part.end(), row.begin(), row.end());
}
}  // namespace detail

/// Peels and contracts; start, goal and whatever else stands in `keep` become keys. length(v, w) > 0 is called for
/// neighbours by several threads at once; a path's length is the sum of its chains', exact up to rounding. `graph` has
/// no duplicate edges and must outlive the result.
template <class Length>
ReducedGraphView reduce_graph(const Graph& graph, std::span<const VertexId> keep, const Length& length,
                              const Execution& execution) {
  KeyCoverView cover(graph, keep, execution);
  const std::size_t n = graph.vertex_count();
  std::vector<std::vector<ReducedGraphView::Chain>> parts(chunk_count(n, detail::reduce_grain));
  RawVector<EdgeEnd> degrees(cover.key_count() + 1, 0);
  for_chunks(n, detail::reduce_grain, execution, [&](Range r) {
    std::vector<ReducedGraphView::Chain>& part = parts[r.first / detail::reduce_grain];
    std::vector<ReducedGraphView::Chain> row;
    for (auto v = static_cast<VertexId>(r.first); v < r.last; ++v) {
      if (!cover.is_key(v)) continue;
      const std::size_t before = part.size();
      detail::append_row(cover, v, length, execution, row, part);
      degrees[cover.rank(v)] = static_cast<EdgeEnd>(part.size() - before);
    }
  });
  return ReducedGraphView(std::move(cover), parts, std::move(degrees), execution);
}

}  // namespace warren
