// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiled/tile_overlay.hpp"

#include <algorithm>
#include <cassert>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

/// The tile beyond a side (0 right, 1 above, 2 left, 3 below).
std::size_t neighbour(const TileGrid& grid, std::size_t tile, unsigned side) {
  const std::size_t across = side == 0 || side == 2 ? 1 : grid.tile_cols;
  return side < 2 ? tile + across : tile - across;
}

/// Tiles are peeled in ranges of so many: at most 32 ranges.
std::size_t peel_grain(std::size_t tiles) { return std::max<std::size_t>(8, (tiles + 31) / 32); }

/// Tiles whose rows are written at once: 65 536 lattice points.
std::size_t fill_grain(const TileGrid& grid) { return std::size_t{1} << (16 - 2 * std::min(grid.side_log2, 8U)); }

}  // namespace

Overlay::Overlay(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends,
                 const Execution& execution) {
  number_keys(tiles);
  execution.reserve(vertex_count() * (sizeof(rows_[0]) + 1));
  rows_.resize(start());
  left_.resize(vertex_count());
  std::vector<std::uint32_t> longest(tile_count(), 1);
  for_chunks(tile_count(), fill_grain(grid), execution, [&](Range r) {
    for (std::size_t tile = r.first; tile < r.last; ++tile) longest[tile] = fill_tile(grid, tiles, tile);
  });
  longest_ = *std::max_element(longest.begin(), longest.end());
  fill_ends(grid, tiles, ends);
}

std::span<const OverlayEnd> Overlay::ends(VertexId v) const {
  if (!is_key(v)) return links_[v - start()];
  const std::array<OverlayEnd, 4>& row = rows_[v];
  std::size_t count = row.size();
  while (count > 0 && row[count - 1].target == v) --count;
  return {row.data(), count};
}

std::uint32_t Overlay::steps_between(VertexId v, VertexId w) const {
  std::uint32_t least = no_vertex;
  for (const OverlayEnd& end : ends(v)) {
    if (end.target == w) least = std::min(least, end.steps);
  }
  assert(least != no_vertex);
  return least;
}

void Overlay::number_keys(std::span<const TileSummary> tiles) {
  first_key_.assign(tiles.size() + 1, 0);
  std::uint64_t keys = 0;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    first_key_[t] = static_cast<VertexId>(keys);
    keys += tiles[t].keys.size();
    if (keys > no_vertex - 4U) throw InputError("roadmap", "has more than 2^32 overlay vertices");
  }
  first_key_.back() = static_cast<VertexId>(keys);
}

VertexId Overlay::key_at(const TileGrid& grid, std::span<const TileSummary> tiles, const EndLink& link) const {
  const std::size_t tile = grid.tile_at(link.col, link.row);
  const std::uint32_t local = (link.row - grid.first_row(tile)) * grid.side() + (link.col - grid.first_col(tile));
  const auto& keys = tiles[tile].keys;
  const auto found = std::lower_bound(keys.begin(), keys.end(), local);
  assert(found != keys.end() && *found == local);  // linked vertices are kept by the reduction
  return first_key_[tile] + static_cast<VertexId>(found - keys.begin());
}

/// Writes the rows of one tile's keys. Returns the steps of the longest edge.
std::uint32_t Overlay::fill_tile(const TileGrid& grid, std::span<const TileSummary> tiles, std::size_t tile) {
  const TileSummary& own = tiles[tile];
  const VertexId first = first_key_[tile];
  for (VertexId v = first; v < first_key_[tile + 1]; ++v) {
    rows_[v].fill({v, 0});
    left_[v] = 0;
  }
  std::uint32_t longest = 1;
  for (const Chain& chain : own.chains) {
    longest = std::max(longest, chain.length);
    add_end(first + chain.from, first + chain.to, chain.length);
    add_end(first + chain.to, first + chain.from, chain.length);
  }
  for (unsigned side = 0; side < 4; ++side) {
    if (own.crossings[side].empty()) continue;
    const std::size_t other = neighbour(grid, tile, side);
    const auto& theirs = tiles[other].crossings[side ^ 2];
    assert(theirs.size() == own.crossings[side].size());
    for (std::size_t i = 0; i < theirs.size(); ++i) {
      add_end(first + own.crossings[side][i], first_key_[other] + theirs[i], 1);
    }
  }
  return longest;
}

/// A link counts as two edges of its key: what start and goal join is never peeled.
void Overlay::fill_ends(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends) {
  for (const EndLinks* end : {&ends.start, &ends.goal}) {
    std::vector<OverlayEnd>& row = links_[end == &ends.start ? 0 : 1];
    for (const EndLink& link : end->links) {
      const VertexId key = key_at(grid, tiles, link);
      row.push_back({key, 0});
      left_[key] = static_cast<std::uint8_t>(left_[key] + 2);
    }
    if (ends.direct) row.push_back({end == &ends.start ? goal() : start(), 0});
  }
  left_[start()] = left_[goal()] = 2;
}

std::size_t Overlay::tile_of(VertexId v) const {
  return static_cast<std::size_t>(std::upper_bound(first_key_.begin(), first_key_.end(), v) - first_key_.begin()) - 1;
}

std::uint64_t Overlay::peel(const Execution& execution) {
  const std::size_t grain = peel_grain(tile_count());
  std::vector<std::uint64_t> closed(chunk_count(tile_count(), grain) + 1, 0);
  std::vector<std::vector<VertexId>> stops(closed.size() - 1);
  for_chunks(tile_count(), grain, execution, [&](Range r) {
    const VertexId first = first_key_[r.first];
    const VertexId last = first_key_[r.last];
    std::vector<VertexId> stopped_at;
    std::uint64_t alone = 0;
    for (VertexId v = first; v < last; ++v) {
      if (left_[v] > 1) continue;
      const VertexId stop = peel_from(v, first, last, alone);
      if (stop != no_vertex) stopped_at.push_back(stop);
    }
    closed[r.first / grain] = alone;
    stops[r.first / grain] = std::move(stopped_at);
  });
  for (const auto& part : stops) {
    execution.check();
    for (const VertexId v : part) peel_from(v, 0, start(), closed.back());
  }
  std::uint64_t total = 0;
  for (const std::uint64_t count : closed) total += count;
  return total;
}

void Overlay::peel_after(VertexId gone) {
  left_[gone] = peeled;
  std::uint64_t closed = 0;
  for (const OverlayEnd& end : ends(gone)) {
    if (is_peeled(end.target)) continue;
    --left_[end.target];
    peel_from(end.target, 0, start(), closed);
  }
}

/// Follows the dead end that begins at v, if one does, as long as it stays among first .. last - 1. Edges that leave
/// the range count as not peeled, and they are not: whatever has one is peeled by no other range either. Returns the
/// dead end's vertex whose last edge leaves the range, or no_vertex; counts `closed` if the whole component was a tree
/// and is gone now.
VertexId Overlay::peel_from(VertexId v, VertexId first, VertexId last, std::uint64_t& closed) {
  while (left_[v] <= 1) {
    if (left_[v] == 0) {
      left_[v] = peeled;
      ++closed;
      return no_vertex;
    }
    const auto row = ends(v);
    const auto out = std::find_if(row.begin(), row.end(), [&](const OverlayEnd& end) {
      return end.target < first || end.target >= last || !is_peeled(end.target);
    });
    assert(out != row.end());
    const VertexId next = out->target;
    if (next < first || next >= last) return v;
    left_[v] = peeled;
    --left_[next];
    v = next;
  }
  return no_vertex;
}

}  // namespace warren
