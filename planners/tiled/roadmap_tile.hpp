// SPDX-License-Identifier: BSD-3-Clause
// What the exact reduction leaves of one tile of a roadmap: dead ends peeled, chains of degree-2 vertices contracted
// (parallel/reduce_graph.hpp), the milestones with edges out of the tile kept.
#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/search/graph.hpp"
#include "parallel/reduce_graph.hpp"
#include "planners/roadmap/connection.hpp"

namespace warren::detail {

/// What is left of one tile. Keys have numbers of their own within the tile.
struct ReducedTile {
  /// Vertices between two keys, in the order from the smaller key to the larger one.
  struct Chain {
    Edge keys;
    double length;
    std::size_t first;  // of `inner`
    std::size_t count;
  };
  RawVector<VertexId> keys;    // their milestones, ascending
  EdgeParts edges;             // as they were found, or by the first key
  std::vector<Chain> chains;   // of the edges that stand for several; by keys, ascending
  RawVector<VertexId> inner;   // milestones on chains
  std::size_t components = 0;  // of which nothing is left
  std::uint64_t free_edges = 0;
  Counters counters;

  std::size_t bytes() const {
    return total_edges(edges) * sizeof(Edge) + (keys.size() + inner.size()) * sizeof(VertexId) +
           chains.size() * sizeof(Chain);
  }
  const Chain* chain_between(VertexId a, VertexId b) const {
    const Edge keys_of_chain{std::min(a, b), std::max(a, b)};
    const auto at = std::lower_bound(chains.begin(), chains.end(), keys_of_chain,
                                     [](const Chain& chain, const Edge& edge) { return chain.keys < edge; });
    return at != chains.end() && at->keys == keys_of_chain ? &*at : nullptr;
  }

  /// Fills an empty tile. first: its first milestone; is_kept: of each of its milestones, not 0 where it has an edge
  /// out of the tile; edges: the free ones inside, numbered within the tile; length(v, w) of two milestones. Where
  /// fewer than half of the milestones are dead ends or links of chains, all are keys. O(edges log edges), one thread.
  template <class Length>
  void reduce(VertexId first, std::span<const std::uint8_t> is_kept, EdgeParts&& found, const Length& length);

 private:
  static bool is_stringy(std::size_t size, const EdgeParts& found);
  template <class Length>
  void contract(VertexId first, std::span<const std::uint8_t> is_kept, const EdgeParts& found, const Length& length);
};

inline bool ReducedTile::is_stringy(std::size_t size, const EdgeParts& found) {
  std::vector<std::uint32_t> degrees(size, 0);
  for (const RawVector<Edge>& part : found) {
    for (const Edge& edge : part) {
      ++degrees[edge.from];
      ++degrees[edge.to];
    }
  }
  const auto is_thin = [](std::uint32_t degree) { return degree <= 2; };
  return 2 * std::count_if(degrees.begin(), degrees.end(), is_thin) >= static_cast<std::ptrdiff_t>(size);
}

template <class Length>
void ReducedTile::reduce(VertexId first, std::span<const std::uint8_t> is_kept, EdgeParts&& found,
                         const Length& length) {
  free_edges = total_edges(found);
  if (is_stringy(is_kept.size(), found)) return contract(first, is_kept, found, length);
  keys.resize(is_kept.size());
  std::iota(keys.begin(), keys.end(), first);
  edges = std::move(found);
}

template <class Length>
void ReducedTile::contract(VertexId first, std::span<const std::uint8_t> is_kept, const EdgeParts& found,
                           const Length& length) {
  std::vector<VertexId> kept;
  for (VertexId v = 0; v < is_kept.size(); ++v) {
    if (is_kept[v] != 0) kept.push_back(v);
  }
  Execution own;  // a tile takes milliseconds and little memory
  own.threads = 1;
  std::vector<Edge> all;
  for (const RawVector<Edge>& part : found) all.insert(all.end(), part.begin(), part.end());
  const Graph graph = Graph::from_edges(is_kept.size(), all);
  const auto length_within = [&](VertexId v, VertexId w) { return length(first + v, first + w); };
  const ReducedGraphView view = reduce_graph(graph, kept, length_within, own, Peeling::within_blocks);
  components = view.keyless_components();
  edges.emplace_back();
  for (VertexId key = 0; key < view.graph().vertex_count(); ++key) {
    keys.push_back(first + view.vertex_of(key));
    const std::span<const VertexId> row = view.graph().neighbours(key);
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i] < key) continue;
      edges.back().push_back({key, row[i]});
      if (view.is_plain_edge(key, i)) continue;
      const RawVector<VertexId> vertices = view.expand(std::array{key, row[i]}, own);
      chains.push_back({{key, row[i]}, view.graph().lengths(key)[i], inner.size(), vertices.size() - 2});
      for (std::size_t k = 1; k + 1 < vertices.size(); ++k) inner.push_back(first + vertices[k]);
    }
  }
}

}  // namespace warren::detail
