// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap/build_roadmap.hpp"

#include <limits>

#include "core/base/error.hpp"
#include "core/base/items_by_key.hpp"
#include "core/search/search.hpp"

namespace warren {

namespace {

constexpr std::size_t polled_vertices = std::size_t{1} << 14;

/// Each edge in the row of its end.
Graph reversed(const Graph& graph, const Execution& execution) {
  const std::size_t n = graph.vertex_count();
  execution.reserve((n + 1) * 2 * sizeof(EdgeEnd) + graph.targets().size() * sizeof(VertexId));
  const auto each = [&](const auto& visit) {
    for (VertexId v = 0; v < n; ++v) {
      if (v % polled_vertices == 0) execution.check();
      for (const VertexId w : graph.neighbours(v)) visit(w, v);
    }
  };
  ItemsByKey rows = items_by_key(n, each, [&] { execution.check(); });
  return {std::move(rows.first), std::move(rows.items)};
}

}  // namespace

Components reached_and_reaching(const Graph& graph, VertexId from, VertexId to, const Execution& execution) {
  Components parts;
  execution.reserve(graph.vertex_count() * (sizeof(VertexId) + sizeof(double) + 2 * sizeof(VertexId)));
  parts.label.assign(graph.vertex_count(), no_vertex);
  const auto mark = [&](const Graph& along, VertexId root) {
    SearchState state;
    state.resize(along.vertex_count(), [&] { execution.check(); });
    breadth_first(along, root, no_vertex, state, [&] { return execution.should_stop(); });
    execution.check();
    for (VertexId v = 0; v < along.vertex_count(); ++v) {
      if (state.reached(v)) parts.label[v] = root;
    }
  };
  mark(graph, from);
  mark(reversed(graph, execution), to);
  return parts;
}

Graph one_way_graph(std::size_t vertex_count, const EdgeParts& edges, const Execution& execution) {
  std::uint64_t ends = 0;
  for (const RawVector<Edge>& part : edges) ends += part.size();
  if (ends >= std::numeric_limits<EdgeEnd>::max())
    throw InputError("roadmap", "more than 2^32 - 1 edges; ask for fewer samples or neighbours");
  execution.reserve((vertex_count + 1) * 2 * sizeof(EdgeEnd) + ends * sizeof(VertexId));
  const auto each = [&](const auto& visit) {
    for (const RawVector<Edge>& part : edges) {
      execution.check();
      for (const Edge& e : part) visit(e.from, e.to);
    }
  };
  ItemsByKey rows = items_by_key(vertex_count, each, [&] { execution.check(); });
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (v % polled_vertices == 0) execution.check();
    std::sort(rows.items.begin() + rows.first[v], rows.items.begin() + rows.first[v + 1]);
  }
  return {std::move(rows.first), std::move(rows.items)};
}

Graph free_part(const Graph& candidates, std::span<const std::uint64_t> edge_states, const Execution& execution) {
  execution.reserve((candidates.vertex_count() + 1) * sizeof(EdgeEnd) + candidates.targets().size() * sizeof(VertexId));
  const auto is_free = [&](std::size_t end) { return edge_state(edge_states, end) == EdgeState::free; };
  return detail::part_with_edges(candidates, is_free, candidates.vertex_count(), {}, execution);
}

}  // namespace warren
