// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/visibility_graph.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "parallel/first_touch.hpp"

namespace warren {
namespace {

/// Of some vertices in a row: the neighbours above each.
struct Rows {
  RawVector<VertexId> targets;
  RawVector<EdgeEnd> degrees;
};

/// Vertices a chunk: few enough to share the work, enough to pay for a chunk's scratch, which is O(n).
std::size_t grain_for(std::size_t vertices) { return std::clamp<std::size_t>(vertices / 256, 16, 1024); }

std::vector<Rows> rows_above(const VisibleCorners& corners, SightLines which, const Execution& execution) {
  const std::size_t n = corners.size();
  const std::size_t grain = grain_for(n);
  std::vector<Rows> parts(chunk_count(n, grain));
  for_chunks(n, grain, execution, [&](Range r) {
    CornerSight sight(corners, execution);
    std::vector<VertexId> seen;
    Rows& part = parts[r.first / grain];
    for (std::size_t v = r.first; v < r.last; ++v) {
      execution.check();
      sight.above_vertex(static_cast<VertexId>(v), which, seen);
      part.targets.insert(part.targets.end(), seen.begin(), seen.end());
      part.degrees.push_back(static_cast<EdgeEnd>(seen.size()));
    }
    execution.reserve(part.targets.size() * sizeof(VertexId));
  });
  return parts;
}

/// Calls visit(v, w) for all v, ascending, and the neighbours w above it, ascending.
template <class Visit>
void for_each_pair(const std::vector<Rows>& parts, const Execution& execution, const Visit& visit) {
  VertexId v = 0;
  for (const Rows& part : parts) {
    auto target = part.targets.begin();
    for (const EdgeEnd degree : part.degrees) {
      if (v % 16 == 0) execution.check();
      for (const auto end = target + degree; target != end; ++target) visit(v, *target);
      ++v;
    }
  }
}

/// Where each vertex's row begins, and where the part of it begins that lies above.
struct RowBorders {
  RawVector<EdgeEnd> first;
  RawVector<EdgeEnd> above;
};

RowBorders row_borders(std::size_t n, const std::vector<Rows>& parts, const Execution& execution) {
  std::vector<std::uint32_t> below(n, 0);
  for_each_pair(parts, execution, [&](VertexId, VertexId w) { ++below[w]; });
  RowBorders borders;
  borders.first.reserve(n + 1);
  borders.above.reserve(n);
  std::uint64_t ends = 0;
  for (const Rows& part : parts) {
    for (const EdgeEnd degree : part.degrees) {
      borders.first.push_back(static_cast<EdgeEnd>(ends));
      ends += below[borders.above.size()];
      borders.above.push_back(static_cast<EdgeEnd>(ends));
      ends += degree;
    }
    if (ends > std::numeric_limits<EdgeEnd>::max())
      throw InputError("visibility graph", "more than 2^32 - 1 edge ends");
  }
  borders.first.push_back(static_cast<EdgeEnd>(ends));
  return borders;
}

/// Each edge was found at its lower end: writes it into both rows, and sorts these.
Graph graph_of_rows(std::size_t n, std::vector<Rows>& parts, const Execution& execution) {
  RowBorders borders = row_borders(n, parts, execution);
  execution.reserve(borders.first[n] * sizeof(VertexId));
  RawVector<VertexId> targets(borders.first[n]);
  touch_first(targets, execution);
  std::vector<EdgeEnd> below(borders.first.begin(), borders.first.end() - 1);
  std::vector<EdgeEnd> above(borders.above.begin(), borders.above.end());
  for_each_pair(parts, execution, [&](VertexId v, VertexId w) {
    targets[above[v]++] = w;
    targets[below[w]++] = v;
  });
  parts.clear();
  for_chunks(n, 1024, execution, [&](Range r) {
    for (std::size_t v = r.first; v < r.last; ++v) {
      std::inplace_merge(targets.begin() + borders.first[v], targets.begin() + borders.above[v],
                         targets.begin() + borders.first[v + 1]);
    }
  });
  return Graph(std::move(borders.first), std::move(targets));
}

}  // namespace

VisibilityGraph::VisibilityGraph(const VisibleCorners& corners, Graph graph, VisibilityEdges edges)
    : corners_(corners),
      which_(edges == VisibilityEdges::full ? SightLines::all : SightLines::tangent),
      positions_(corners.size()),
      graph_(std::move(graph)) {
  for (VertexId v = 0; v < positions_.size(); ++v) positions_[v] = corners.position(v);
}

VisibilityGraph::VisibilityGraph(const VisibleCorners& corners, VisibilityEdges edges, const Execution& execution)
    : VisibilityGraph(corners, Graph(), edges) {
  std::vector<Rows> parts = rows_above(corners, which_, execution);
  graph_ = graph_of_rows(positions_.size(), parts, execution);
}

VisibilityLinks VisibilityGraph::link(Vec2 start, Vec2 goal, const Execution& execution) const {
  VisibilityLinks links{start, goal, {}, {}, std::vector<std::uint8_t>(size(), 0), false};
  CornerSight sight(corners_, execution);
  sight.from_point(start, which_, goal, links.from_start);
  if (!links.from_start.empty() && links.from_start.back() == CornerSight::target) {
    links.direct = true;
    links.from_start.pop_back();
  }
  sight.from_point(goal, which_, std::nullopt, links.from_goal);
  for (const VertexId v : links.from_goal) links.sees_goal[v] = 1;
  return links;
}

Graph VisibilityGraph::joined(const VisibilityLinks& links, const Execution& execution) const {
  const std::size_t n = size();
  std::vector<std::uint8_t> sees_start(n, 0);
  for (const VertexId v : links.from_start) sees_start[v] = 1;
  RawVector<EdgeEnd> offsets;
  RawVector<VertexId> targets;
  offsets.reserve(n + 3);
  reserve_touched(targets, 2 * (graph_.edge_count() + links.count()), execution);
  for (VertexId v = 0; v < n; ++v) {
    if (v % 256 == 0) execution.check();
    offsets.push_back(static_cast<EdgeEnd>(targets.size()));
    targets.insert(targets.end(), graph_.neighbours(v).begin(), graph_.neighbours(v).end());
    if (sees_start[v] != 0) targets.push_back(start_vertex());
    if (links.sees_goal[v] != 0) targets.push_back(goal_vertex());
  }
  offsets.push_back(static_cast<EdgeEnd>(targets.size()));
  targets.insert(targets.end(), links.from_start.begin(), links.from_start.end());
  if (links.direct) targets.push_back(goal_vertex());
  offsets.push_back(static_cast<EdgeEnd>(targets.size()));
  targets.insert(targets.end(), links.from_goal.begin(), links.from_goal.end());
  if (links.direct) targets.push_back(start_vertex());
  offsets.push_back(static_cast<EdgeEnd>(targets.size()));
  return Graph(std::move(offsets), std::move(targets));
}

}  // namespace warren
