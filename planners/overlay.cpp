// SPDX-License-Identifier: BSD-3-Clause
#include "planners/overlay.hpp"

#include <algorithm>
#include <cassert>

#include "core/error.hpp"
#include "parallel/chunks.hpp"
#include "parallel/scan.hpp"

namespace warren {
namespace {

/// The tile beyond a side (0 right, 1 above, 2 left, 3 below).
std::size_t neighbour(const TileGrid& grid, std::size_t tile, unsigned side) {
  const std::size_t across = side == 0 || side == 2 ? 1 : grid.tile_cols;
  return side < 2 ? tile + across : tile - across;
}

/// Tiles are peeled in ranges of so many: at most 32 ranges.
std::size_t peel_grain(std::size_t tiles) { return std::max<std::size_t>(8, (tiles + 31) / 32); }

}  // namespace

Overlay::Overlay(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends,
                 const Execution& execution) {
  number_keys(tiles);
  count_ends(grid, tiles, ends, execution);
  if (exclusive_scan(first_end_, execution) > 0xffffffffU)
    throw InputError("roadmap", "has more than 2^32 overlay edges");
  execution.reserve(first_end_.back() * sizeof(OverlayEnd));
  ends_.resize(first_end_.back());
  for_chunks(tile_count(), 16, execution, [&](Range r) {
    for (std::size_t tile = r.first; tile < r.last; ++tile) fill_tile(grid, tiles, tile);
  });
  fill_ends(grid, tiles, ends);
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

void Overlay::count_ends(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends,
                         const Execution& execution) {
  const std::size_t vertices = std::size_t{first_key_.back()} + 2;
  execution.reserve(vertices * (sizeof(std::uint32_t) + 1));
  first_end_.resize(vertices + 1);
  for_chunks(tiles.size(), 16, execution, [&](Range r) {
    std::fill(first_end_.begin() + first_key_[r.first], first_end_.begin() + first_key_[r.last], 0U);
    for (std::size_t tile = r.first; tile < r.last; ++tile) {
      std::uint32_t* degree = first_end_.data() + first_key_[tile];
      for (const Chain& chain : tiles[tile].chains) {
        ++degree[chain.from];
        ++degree[chain.to];
      }
      for (const auto& side : tiles[tile].crossings) {
        for (const std::uint16_t key : side) ++degree[key];
      }
    }
  });
  const std::uint32_t direct = ends.direct ? 1 : 0;
  first_end_[vertices - 2] = static_cast<std::uint32_t>(ends.start.links.size()) + direct;
  first_end_[vertices - 1] = static_cast<std::uint32_t>(ends.goal.links.size()) + direct;
  first_end_[vertices] = 0;
  for (const EndLinks* end : {&ends.start, &ends.goal}) {
    for (const EndLink& link : end->links) ++first_end_[key_at(grid, tiles, link)];
  }
  left_.resize(vertices);
}

VertexId Overlay::key_at(const TileGrid& grid, std::span<const TileSummary> tiles, const EndLink& link) const {
  const std::size_t tile = grid.tile_at(link.col, link.row);
  const std::uint32_t local = (link.row - grid.first_row(tile)) * grid.side() + (link.col - grid.first_col(tile));
  const auto& keys = tiles[tile].keys;
  const auto found = std::lower_bound(keys.begin(), keys.end(), local);
  assert(found != keys.end() && *found == local);  // linked vertices are kept by the reduction
  return first_key_[tile] + static_cast<VertexId>(found - keys.begin());
}

/// Writes the rows of one tile's keys, but for links to start and goal, whose places stay free at the end of the row.
void Overlay::fill_tile(const TileGrid& grid, std::span<const TileSummary> tiles, std::size_t tile) {
  const TileSummary& own = tiles[tile];
  const VertexId first = first_key_[tile];
  std::vector<std::uint32_t> next(first_end_.begin() + first, first_end_.begin() + first_key_[tile + 1]);
  for (std::size_t c = 0; c < own.chains.size(); ++c) {
    const Chain& chain = own.chains[c];
    const auto length = static_cast<double>(chain.length);
    ends_[next[chain.from]++] = {first + chain.to, static_cast<std::uint32_t>(c), length};
    ends_[next[chain.to]++] = {first + chain.from, static_cast<std::uint32_t>(c), length};
  }
  for (unsigned side = 0; side < 4; ++side) {
    if (own.crossings[side].empty()) continue;
    const std::size_t other = neighbour(grid, tile, side);
    const auto& theirs = tiles[other].crossings[side ^ 2];
    assert(theirs.size() == own.crossings[side].size());
    for (std::size_t i = 0; i < theirs.size(); ++i) {
      ends_[next[own.crossings[side][i]]++] = {first_key_[other] + theirs[i], no_chain, 1.0};
    }
  }
  for (std::size_t k = 0; k < next.size(); ++k) {
    const std::uint32_t filled = next[k] - first_end_[first + k];
    left_[first + k] = static_cast<std::uint8_t>(filled);
  }
}

void Overlay::fill_ends(const TileGrid& grid, std::span<const TileSummary> tiles, const OverlayEnds& ends) {
  left_[start()] = 0;
  left_[goal()] = 0;
  const auto join = [&](VertexId a, VertexId b, double length) {
    ends_[first_end_[a] + left_[a]++] = {b, no_chain, length};
    ends_[first_end_[b] + left_[b]++] = {a, no_chain, length};
  };
  for (const EndLink& link : ends.start.links) join(start(), key_at(grid, tiles, link), link.length);
  for (const EndLink& link : ends.goal.links) join(goal(), key_at(grid, tiles, link), link.length);
  if (ends.direct) join(start(), goal(), distance(ends.start.at, ends.goal.at));
}

std::size_t Overlay::tile_of(VertexId v) const {
  return static_cast<std::size_t>(std::upper_bound(first_key_.begin(), first_key_.end(), v) - first_key_.begin()) - 1;
}

std::uint64_t Overlay::peel(const Execution& execution) {
  const std::size_t grain = peel_grain(tile_count());
  const std::size_t ranges = chunk_count(tile_count(), grain);
  std::vector<std::uint64_t> closed(ranges + 1, 0);
  std::vector<std::vector<VertexId>> cores(ranges);
  for_chunks(tile_count(), grain, execution, [&](Range r) {
    const VertexId first = first_key_[r.first];
    const VertexId last = first_key_[r.last];
    std::vector<VertexId>& core = cores[r.first / grain];
    for (VertexId v = first; v < last; ++v) closed[r.first / grain] += peel_from(v, first, last);
    for (VertexId v = first; v < last; ++v) {
      if (!is_peeled(v)) core.push_back(v);
    }
  });
  for (const auto& core : cores) {
    execution.check();
    for (const VertexId v : core) closed[ranges] += peel_from(v, 0, static_cast<VertexId>(vertex_count()));
  }
  keep_core(cores, execution);
  std::uint64_t total = 0;
  for (const std::uint64_t count : closed) total += count;
  return total;
}

/// What is not peeled of the vertices that each range had left, then start and goal. One range starts no threads.
void Overlay::keep_core(std::vector<std::vector<VertexId>>& cores, const Execution& execution) {
  for_chunks(cores.size(), 1, execution,
             [&](Range r) { std::erase_if(cores[r.first], [&](VertexId v) { return is_peeled(v); }); });
  std::vector<std::size_t> first(cores.size() + 1, 0);
  for (std::size_t i = 0; i < cores.size(); ++i) first[i + 1] = first[i] + cores[i].size();
  core_.resize(first.back() + 2);
  for_chunks(cores.size(), 1, execution, [&](Range r) {
    std::copy(cores[r.first].begin(), cores[r.first].end(),
              core_.begin() + static_cast<std::ptrdiff_t>(first[r.first]));
  });
  core_[first.back()] = start();
  core_[first.back() + 1] = goal();
}

/// Follows the dead end that begins at v, if one does, as long as it stays among first .. last - 1. Edges that leave
/// the range count as not peeled, and they are not: whatever has one is peeled by no other range either. Returns 1 if
/// the whole component was a tree and is gone now.
std::uint64_t Overlay::peel_from(VertexId v, VertexId first, VertexId last) {
  while (is_key(v) && left_[v] <= 1) {
    if (left_[v] == 0) {
      left_[v] = peeled;
      return 1;
    }
    const auto row = ends(v);
    const auto out = std::find_if(row.begin(), row.end(), [&](const OverlayEnd& end) {
      return end.target < first || end.target >= last || !is_peeled(end.target);
    });
    assert(out != row.end());
    const VertexId next = out->target;
    if (next < first || next >= last) return 0;
    left_[v] = peeled;
    --left_[next];
    v = next;
  }
  return 0;
}

}  // namespace warren
