// SPDX-License-Identifier: BSD-3-Clause
#include "planners/overlay_search.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "parallel/chunks.hpp"
#include "planners/meeting_search.hpp"

namespace warren {
namespace {

/// Where overlay vertices stand.
class Places {
 public:
  Places(const Overlay& overlay, const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends)
      : overlay_(overlay), grid_(grid), tiles_(tiles), ends_(ends) {}

  Vec2 of(VertexId v) const {
    if (v == overlay_.start()) return ends_.start.at;
    if (v == overlay_.goal()) return ends_.goal.at;
    const std::size_t tile = overlay_.tile_of(v);
    const std::uint32_t local = tiles_[tile].keys[v - overlay_.first_key(tile)];
    const std::uint32_t side = grid_.side();
    return TileGrid::point(grid_.first_col(tile) + local % side, grid_.first_row(tile) + local / side);
  }

 private:
  const Overlay& overlay_;
  const TileGrid& grid_;
  std::span<const TileSummary> tiles_;
  const OverlayEnds& ends_;
};

/// The shortest of the edges from v to w, the first of equals; there must be one.
const OverlayEnd& edge_between(const Overlay& overlay, VertexId v, VertexId w) {
  const std::span<const OverlayEnd> row = overlay.ends(v);
  std::size_t best = row.size();
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i].target == w && (best == row.size() || row[i].length < row[best].length)) best = i;
  }
  assert(best < row.size());
  return row[best];
}

std::size_t steps_of(const OverlayEnd& edge) {
  return edge.chain == no_chain ? 1 : static_cast<std::size_t>(edge.length);
}

constexpr Vec2 directions[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

/// Writes the vertices after v along a chain of v's tile, up to its other end.
void walk_chain(const TileSummary& tile, const Chain& chain, bool forward, Vec2 at, Vec2* out) {
  const std::uint8_t* steps = tile.steps.data() + chain.first_step;
  for (std::uint32_t i = 0; i < chain.length; ++i) {
    const unsigned direction = forward ? steps[i] : steps[chain.length - 1 - i] ^ 2U;
    at = at + directions[direction];
    *out++ = at;
  }
}

/// The edges of the core, as a search asks for them.
struct CoreEdges {
  const Overlay& overlay;
  template <class Visit>
  void operator()(VertexId v, const Visit& visit) const {
    for (const OverlayEnd& end : overlay.ends(v)) {
      if (!overlay.is_peeled(end.target)) visit(end.target, end.length);
    }
  }
  void fetch(VertexId v) const { overlay.fetch(v); }
  template <class Visit>
  void for_each_target(VertexId v, const Visit& visit) const {
    for (const OverlayEnd& end : overlay.ends(v)) visit(end.target);
  }
};

/// The points of all vertices, for the heuristic.
RawVector<Vec2> points_of(const Overlay& overlay, const TileGrid& grid, std::span<const TileSummary> tiles,
                          const OverlayEnds& ends, const Execution& execution) {
  RawVector<Vec2> points(overlay.vertex_count());
  for_chunks(tiles.size(), 16, execution, [&](Range r) {
    for (std::size_t tile = r.first; tile < r.last; ++tile) {
      const std::uint32_t side = grid.side();
      Vec2* out = points.data() + overlay.first_key(tile);
      for (const std::uint32_t local : tiles[tile].keys) {
        *out++ = TileGrid::point(grid.first_col(tile) + local % side, grid.first_row(tile) + local / side);
      }
    }
  });
  points[overlay.start()] = ends.start.at;
  points[overlay.goal()] = ends.goal.at;
  return points;
}

}  // namespace

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
    std::size_t joins = 0;
    std::vector<Edge> across;  // to vertices before the chunk
  };
  std::vector<Part> parts(chunk_count(n, grain));
  for_chunks(n, grain, execution, [&](Range r) {
    Part part;
    for (auto v = static_cast<VertexId>(r.first); v < r.last; ++v) {
      parent[v] = v;
      if (overlay.is_peeled(v)) continue;
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
  CoreComponents result{overlay.core().size(), false};
  for (const Part& part : parts) {
    execution.check();
    result.count -= part.joins;
    for (const Edge& edge : part.across) result.count -= join(edge.from, edge.to) ? 1 : 0;
  }
  result.joined = root(overlay.start()) == root(overlay.goal());
  return result;
}

SearchResult search_overlay(const Overlay& overlay, const TileGrid& grid, std::span<const TileSummary> tiles,
                            const OverlayEnds& ends, const Execution& execution) {
  execution.reserve(overlay.vertex_count() * (sizeof(Vec2) + 2 * (sizeof(double) + 2 * sizeof(VertexId) + 1)));
  const RawVector<Vec2> points = points_of(overlay, grid, tiles, ends, execution);
  const CoreEdges edges{overlay};
  const auto estimate_to = [&](VertexId root) {
    return [&points, at = points[root]](VertexId v) { return distance(points[v], at); };
  };
  std::array<SearchState, 2> states;
  return search_from_both_ends<CoreEdges>(QueueKind::heap, overlay.vertex_count(), {overlay.start(), overlay.goal()},
                                          {edges, edges}, estimate_to, {&states[0], &states[1]}, execution);
}

std::vector<Vec2> expand_path(const Overlay& overlay, const TileGrid& grid, std::span<const TileSummary> tiles,
                              const OverlayEnds& ends, std::span<const VertexId> path, const Execution& execution) {
  const Places places(overlay, grid, tiles, ends);
  constexpr std::size_t grain = 1024;
  const std::size_t legs = path.size() - 1;
  std::vector<std::size_t> first(legs + 1, 1);  // where the vertices of a leg go, its own beginning not counted
  for (std::size_t i = 0; i < legs; ++i)
    first[i + 1] = first[i] + steps_of(edge_between(overlay, path[i], path[i + 1]));
  execution.reserve(first.back() * sizeof(Vec2));
  std::vector<Vec2> points(first.back(), ends.start.at);
  for_chunks(legs, grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) {
      const OverlayEnd& edge = edge_between(overlay, path[i], path[i + 1]);
      Vec2* const out = points.data() + first[i];
      if (edge.chain == no_chain) {
        *out = places.of(path[i + 1]);
        continue;
      }
      const std::size_t tile = overlay.tile_of(path[i]);
      const Chain& chain = tiles[tile].chains[edge.chain];
      const bool forward = overlay.first_key(tile) + chain.from == path[i];
      walk_chain(tiles[tile], chain, forward, places.of(path[i]), out);
    }
  });
  return points;
}

}  // namespace warren
