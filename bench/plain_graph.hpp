// SPDX-License-Identifier: BSD-3-Clause
// The serial ways from edges to a graph and to its components: what planners/graph/assemble_graph and
// planners/graph/assemble_graph are measured against, and the oracles of their tests.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "core/base/items_by_key.hpp"
#include "core/search/graph.hpp"
#include "core/search/union_find.hpp"

namespace warren::bench {

/// Edges may come in any order; duplicates are kept as they are. O(V + E log degree).
inline Graph plain_graph(std::size_t vertex_count, std::span<const Edge> edges) {
  ItemsByKey rows = items_by_key(vertex_count, [&](const auto& visit) {
    for (const Edge& e : edges) {
      visit(e.from, e.to);
      visit(e.to, e.from);
    }
  });
  for (std::size_t v = 0; v < vertex_count; ++v) {
    std::sort(rows.items.begin() + rows.first[v], rows.items.begin() + rows.first[v + 1]);
  }
  return Graph(std::move(rows.first), std::move(rows.items));
}

/// Union-find with path halving, O(E α(V)).
inline Components plain_components(const Graph& graph) {
  const auto n = static_cast<VertexId>(graph.vertex_count());
  Components result;
  RawVector<VertexId>& parent = result.label;
  parent.resize(n);
  for (VertexId v = 0; v < n; ++v) parent[v] = v;
  for (VertexId v = 0; v < n; ++v) {
    for (const VertexId w : graph.neighbours(v)) {
      if (w > v) break;  // each edge once, from its larger end
      unite(parent, v, w);
    }
  }
  for (VertexId v = 0; v < n; ++v) {
    parent[v] = parent[parent[v]];  // roots are the smallest of their component, so parent[v] is final already
    result.count += parent[v] == v ? 1U : 0U;
  }
  return result;
}

}  // namespace warren::bench
