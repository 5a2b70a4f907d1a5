// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/components.hpp"

#include "core/search/union_find.hpp"

namespace warren {
namespace {

constexpr std::size_t component_grain = std::size_t{1} << 14;

void join_inside(const Graph& graph, Range block, RawVector<VertexId>& parent) {
  for (auto v = static_cast<VertexId>(block.first); v < block.last; ++v) {
    parent[v] = v;
    for (const VertexId w : graph.neighbours(v)) {
      if (w > v) break;  // each edge once, from its larger end
      if (w < block.first) continue;
      unite(parent, v, w);
    }
  }
}

}  // namespace

Components components(const Graph& graph, const Execution& execution) {
  const std::size_t n = graph.vertex_count();
  Components result;
  execution.reserve(n * sizeof(VertexId));
  result.label.resize(n);
  const UnionForest forest(result.label);
  for_chunks(n, component_grain, execution, [&](Range r) { join_inside(graph, r, result.label); });
  for_chunks(n, component_grain, execution.quiet(), [&](Range r) {
    for (auto v = static_cast<VertexId>(r.first); v < r.last; ++v) {
      for (const VertexId w : graph.neighbours(v)) {
        if (w >= r.first) break;
        forest.join(v, w);
      }
    }
  });
  result.count = sum_of_chunks(n, component_grain, execution.quiet(), [&](Range r) {
    std::size_t count = 0;
    for (auto v = static_cast<VertexId>(r.first); v < r.last; ++v) {
      const VertexId root = forest.root_of(v);
      std::atomic_ref(result.label[v]).store(root, std::memory_order_relaxed);
      count += root == v ? 1U : 0U;
    }
    return count;
  });
  return result;
}

}  // namespace warren
