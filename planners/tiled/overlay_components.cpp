// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiled/overlay_components.hpp"

#include <algorithm>
#include <vector>

#include "core/search/graph.hpp"
#include "parallel/chunks.hpp"

namespace warren {

CoreComponents core_components(const Overlay& overlay, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  const std::size_t n = overlay.vertex_count();
  execution.reserve(n * sizeof(VertexId));
  RawVector<VertexId> parent(n);
  const auto root = [&](VertexId v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  const auto join = [&](VertexId v, VertexId w) {  // are they two components until now?
    const VertexId a = root(v);
    const VertexId b = root(w);
    parent[std::max(a, b)] = std::min(a, b);
    return a != b;
  };
  struct Part {
    std::size_t members = 0;
    std::size_t joins = 0;
    std::vector<Edge> across;  // to vertices before the chunk
  };
  std::vector<Part> parts(chunk_count(n, grain));
  for_chunks(n, grain, execution, [&](Range r) {
    Part part;
    for (auto v = static_cast<VertexId>(r.first); v < r.last; ++v) {
      parent[v] = v;
      if (overlay.is_peeled(v)) continue;
      ++part.members;
      for (const OverlayEnd& end : overlay.ends(v)) {
        if (end.target > v || overlay.is_peeled(end.target)) continue;  // each edge once
        if (end.target < r.first) {
          part.across.push_back({v, end.target});
        } else {
          part.joins += join(v, end.target) ? 1 : 0;
        }
      }
    }
    parts[r.first / grain] = std::move(part);
  });
  CoreComponents result;
  for (const Part& part : parts) {
    execution.check();
    result.count += part.members - part.joins;
    for (const Edge& edge : part.across) result.count -= join(edge.from, edge.to) ? 1 : 0;
  }
  result.joined = root(overlay.start()) == root(overlay.goal());
  return result;
}

}  // namespace warren
