// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiled/peeled_band.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "parallel/chunks.hpp"
#include "planners/tiled/tile_borders.hpp"

namespace warren {
namespace {

using Crossings = std::array<std::vector<std::uint16_t>, 4>;

/// The band as a lattice of its own.
class PeeledBand {
 public:
  PeeledBand(const TileGrid& grid, std::size_t first_row, std::size_t last_row, std::span<TileSummary> tiles)
      : band_(grid), first_row_(static_cast<std::uint32_t>(first_row << grid.side_log2)), tiles_(tiles) {
    band_.tile_rows = static_cast<std::uint32_t>(last_row - first_row);
    band_.rows = std::min(grid.rows, static_cast<std::uint32_t>(last_row << grid.side_log2)) - first_row_;
  }

  void run(const OverlayEnds& ends, const Execution& execution) {
    const OverlayEnds kept = kept_cells(ends);
    take_away_rims();
    check_borders(band_, tiles_, execution);
    Overlay overlay(band_, tiles_, kept, execution);
    tiles_.front().closed_components += overlay.peel(execution);
    std::vector<Crossings> crossings(tiles_.size());
    constexpr std::size_t grain = 64;
    for_chunks(tiles_.size(), grain, execution, [&](Range r) {
      for (std::size_t t = r.first; t < r.last; ++t) crossings[t] = crossings_left(overlay, t);
    });
    for_chunks(tiles_.size(), grain, execution, [&](Range r) {
      for (std::size_t t = r.first; t < r.last; ++t) prune(overlay, t, std::move(crossings[t]));
    });
  }

 private:
  bool is_lowest(std::size_t tile) const { return tile < band_.tile_cols; }
  bool is_highest(std::size_t tile) const { return tile + band_.tile_cols >= tiles_.size(); }

  /// Whatever leaves the band, and what start and goal join in it, as if they were linked.
  OverlayEnds kept_cells(const OverlayEnds& ends) const {
    OverlayEnds kept;
    const auto add = [&](std::size_t tile, std::span<const std::uint16_t> keys) {
      for (const std::uint16_t key : keys) {
        const std::uint32_t place = tiles_[tile].keys[key];
        kept.start.links.push_back(
            {band_.first_col(tile) + place % band_.side(), band_.first_row(tile) + place / band_.side(), 0.0});
      }
    };
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      if (is_lowest(t)) add(t, tiles_[t].crossings[3]);
      if (is_highest(t)) add(t, tiles_[t].crossings[1]);
    }
    for (const EndLinks* end : {&ends.start, &ends.goal}) {
      for (const EndLink& link : end->links) {
        if (link.row < first_row_ || link.row - first_row_ >= band_.rows) continue;
        kept.goal.links.push_back({link.col, link.row - first_row_, link.length});
      }
    }
    return kept;
  }

  void take_away_rims() {
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
      if (is_lowest(t)) std::swap(lowest_.emplace_back(), tiles_[t].crossings[3]);
      if (is_highest(t)) std::swap(highest_.emplace_back(), tiles_[t].crossings[1]);
    }
  }

  /// Both ends of a crossing are left, or it goes.
  Crossings crossings_left(const Overlay& overlay, std::size_t tile) const {
    const std::array<std::size_t, 4> beyond{tile + 1, tile + band_.tile_cols, tile - 1, tile - band_.tile_cols};
    Crossings left;
    for (unsigned side = 0; side < 4; ++side) {
      const auto& own = tiles_[tile].crossings[side];
      for (std::size_t i = 0; i < own.size(); ++i) {
        const std::uint16_t theirs = tiles_[beyond[side]].crossings[side ^ 2U][i];
        if (overlay.is_peeled(overlay.first_key(tile) + own[i])) continue;
        if (overlay.is_peeled(overlay.first_key(beyond[side]) + theirs)) continue;
        left[side].push_back(own[i]);
      }
    }
    return left;
  }

  void prune(const Overlay& overlay, std::size_t t, Crossings crossings) {
    TileSummary& tile = tiles_[t];
    if (is_lowest(t)) crossings[3] = lowest_[t];
    if (is_highest(t)) crossings[1] = highest_[t + band_.tile_cols - tiles_.size()];
    const auto is_left = [&](std::size_t key) {
      return !overlay.is_peeled(overlay.first_key(t) + static_cast<VertexId>(key));
    };
    std::vector<std::uint16_t> number(tile.keys.size());
    std::vector<std::uint16_t> keys;
    for (std::size_t k = 0; k < tile.keys.size(); ++k) {
      number[k] = static_cast<std::uint16_t>(keys.size());
      if (is_left(k)) keys.push_back(tile.keys[k]);
    }
    std::vector<Chain> chains;
    for (const Chain& chain : tile.chains) {
      if (is_left(chain.from) && is_left(chain.to)) {
        chains.push_back({number[chain.from], number[chain.to], chain.first_step, chain.length});
      }
    }
    for (auto& side : crossings) {
      for (std::uint16_t& key : side) key = number[key];
    }
    tile.keys = std::move(keys);
    tile.chains = std::move(chains);
    tile.crossings = std::move(crossings);
  }

  TileGrid band_;
  const std::uint32_t first_row_;
  std::span<TileSummary> tiles_;
  std::vector<std::vector<std::uint16_t>> lowest_, highest_;  // crossings out of the band, by column of tiles
};

}  // namespace

void peel_band(const TileGrid& grid, std::size_t first_row, std::size_t last_row, const OverlayEnds& ends,
               std::span<TileSummary> tiles, const Execution& execution) {
  PeeledBand(grid, first_row, last_row, tiles).run(ends, execution);
}

}  // namespace warren
