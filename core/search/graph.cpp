// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/graph.hpp"

#include <algorithm>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/items_by_key.hpp"
#include "core/search/union_find.hpp"

namespace warren {

Graph Graph::from_edges(std::size_t vertex_count, std::span<const Edge> edges) {
  if (edges.size() > std::numeric_limits<EdgeEnd>::max() / 2) {
    throw InputError("graph", "too many edges for 32-bit positions; use fewer samples or neighbours");
  }
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

std::size_t Components::size_of(VertexId v) const {
  return static_cast<std::size_t>(std::count(label.begin(), label.end(), label[v]));
}

Components components(const Graph& graph) {
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

}  // namespace warren
