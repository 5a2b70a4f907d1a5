// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiled/overlay_components.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/search/graph.hpp"

namespace warren {

VertexId OverlayComponents::root(VertexId v) const {
  while (parent_[v - first_] != v) v = parent_[v - first_];
  return v;
}

/// Were they two components until now?
bool OverlayComponents::join(VertexId v, VertexId w) {
  const auto halved = [this](VertexId u) {
    const auto parent = [this](VertexId of) -> VertexId& { return parent_[of - first_]; };
    while (parent(u) != u) u = parent(u) = parent(parent(u));
    return u;
  };
  const VertexId a = halved(v);
  const VertexId b = halved(w);
  parent_[std::max(a, b) - first_] = std::min(a, b);
  return a != b;
}

OverlayComponents::OverlayComponents(const Overlay& overlay, Range vertices, const Execution& execution)
    : first_(static_cast<VertexId>(vertices.first)) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  struct Part {
    std::size_t members = 0;
    std::size_t joins = 0;
    std::vector<Edge> across;  // to vertices before the chunk
  };
  execution.reserve(vertices.size() * sizeof(VertexId));
  parent_.resize(vertices.size());
  std::vector<Part> parts(chunk_count(vertices.size(), grain));
  for_chunks(vertices.size(), grain, execution, [&](Range r) {
    Part part;
    const auto first = static_cast<VertexId>(vertices.first + r.first);
    for (VertexId v = first; v < vertices.first + r.last; ++v) {
      parent_[v - first_] = v;
      if (overlay.is_peeled(v)) continue;
      ++part.members;
      for (const OverlayEnd& end : overlay.ends(v)) {
        if (end.target > v || end.target < first_ || overlay.is_peeled(end.target)) continue;  // each edge once
        if (end.target < first) {
          part.across.push_back({v, end.target});
        } else {
          part.joins += join(v, end.target) ? 1 : 0;
        }
      }
    }
    parts[r.first / grain] = std::move(part);
  });
  for (const Part& part : parts) {
    execution.check();
    count_ += part.members - part.joins;
    for (const Edge& edge : part.across) count_ -= join(edge.from, edge.to) ? 1 : 0;
  }
}

CoreComponents core_components(const Overlay& overlay, const Execution& execution) {
  const OverlayComponents components(overlay, {0, overlay.vertex_count()}, execution);
  return {components.count(), components.root(overlay.start()) == components.root(overlay.goal())};
}

}  // namespace warren
