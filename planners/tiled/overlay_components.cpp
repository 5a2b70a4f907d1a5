// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiled/overlay_components.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "core/search/graph.hpp"
#include "parallel/chunks.hpp"
#include "parallel/first_touch.hpp"

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

/// Steps of the shortest edge from key v to key w; there must be one.
std::uint32_t steps_between(const Overlay& overlay, VertexId v, VertexId w) {
  std::uint32_t least = no_vertex;
  for (const OverlayEnd& end : overlay.ends(v)) {
    if (end.target == w) least = std::min(least, end.steps);
  }
  assert(least != no_vertex);
  return least;
}

/// The first chain of so many steps between keys from < to of a tile; there must be one.
const Chain& chain_between(const TileSummary& tile, std::uint32_t from, std::uint32_t to, std::uint32_t steps) {
  const auto first = std::lower_bound(tile.chains.begin(), tile.chains.end(), from,
                                      [](const Chain& chain, std::uint32_t key) { return chain.from < key; });
  const auto found = std::find_if(first, tile.chains.end(),
                                  [&](const Chain& chain) { return chain.to == to && chain.length == steps; });
  assert(found != tile.chains.end() && found->from == from);
  return *found;
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

Path<Vec2> expand_path(const Overlay& overlay, const TileGrid& grid, std::span<const TileSummary> tiles,
                       const OverlayEnds& ends, std::span<const VertexId> path, const Execution& execution) {
  const Places places(overlay, grid, tiles, ends);
  constexpr std::size_t grain = 1024;
  const std::size_t legs = path.size() - 1;
  const auto steps_of = [&](std::size_t leg) {
    const bool is_link = !overlay.is_key(path[leg]) || !overlay.is_key(path[leg + 1]);
    return is_link ? 1 : steps_between(overlay, path[leg], path[leg + 1]);
  };
  execution.reserve((legs + 1) * sizeof(std::size_t));
  std::vector<std::size_t> first(legs + 1, 1);  // where the vertices of a leg go, its own beginning not counted
  Execution quiet = execution;
  quiet.progress = nullptr;
  for_chunks(legs, grain, quiet, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) first[i + 1] = steps_of(i);
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  Path<Vec2> points;
  reserve_touched(points, first.back(), execution);
  points.resize(first.back());  // not with a value: the library of g++ 12 is slow at that
  points.front() = ends.start.at;
  for_chunks(legs, grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) {
      Vec2* const out = points.data() + first[i];
      const auto steps = static_cast<std::uint32_t>(first[i + 1] - first[i]);
      if (steps == 1) {
        *out = places.of(path[i + 1]);
        continue;
      }
      const std::size_t tile = overlay.tile_of(path[i]);
      const VertexId from = path[i] - overlay.first_key(tile);
      const VertexId to = path[i + 1] - overlay.first_key(tile);
      const Chain& chain = chain_between(tiles[tile], std::min(from, to), std::max(from, to), steps);
      walk_chain(tiles[tile], chain, from < to, places.of(path[i]), out);
    }
  });
  return points;
}

}  // namespace warren
