// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps/graph/free_components.hpp"

#include "parallel/chunks.hpp"
#include "parallel/union_forest.hpp"

namespace warren {

RawVector<VertexId> free_components(const RoadmapParts& parts, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  const std::size_t n = parts.vertex_count();
  execution.reserve(n * sizeof(VertexId));
  RawVector<VertexId> parent(n);
  for_chunks(n, grain, execution, [&](Range r) {
    for (std::size_t v = r.first; v < r.last; ++v) parent[v] = static_cast<VertexId>(v);
  });
  const UnionForest forest(parent);
  for_chunks(n, grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) {
      const auto v = static_cast<VertexId>(i);
      for (std::size_t end = parts.first[i]; end < parts.first[i + 1]; ++end) {
        if (parts.state_of_end(end) == EdgeState::free) forest.join(v, parts.to[end]);
      }
    }
  });
  RawVector<VertexId> label(n);
  for_chunks(n, grain, execution, [&](Range r) {
    for (std::size_t v = r.first; v < r.last; ++v) label[v] = forest.root(static_cast<VertexId>(v));
  });
  return label;
}

}  // namespace warren
