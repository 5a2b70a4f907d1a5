// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiled/tile_borders.hpp"

#include <algorithm>
#include <string>

#include "core/base/error.hpp"

namespace warren {
namespace {

/// Column or row, by the side (0 right, 1 above, 2 left, 3 below), of the points that cross it.
bool agree(const TileGrid& grid, const TileSummary& tile, const TileSummary& beyond, unsigned side) {
  const auto place = [&](const TileSummary& of, std::uint16_t key) {
    const std::uint32_t local = of.keys[key];
    return side == 0 ? local >> grid.side_log2 : local & (grid.side() - 1);
  };
  return std::equal(tile.crossings[side].begin(), tile.crossings[side].end(), beyond.crossings[side ^ 2U].begin(),
                    beyond.crossings[side ^ 2U].end(), [&](std::uint16_t ours, std::uint16_t theirs) {
                      return place(tile, ours) == place(beyond, theirs);
                    });
}

}  // namespace

void check_borders(const TileGrid& grid, std::span<const TileSummary> tiles, const Execution& execution) {
  const TileSummary nothing;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    if (t % 4096 == 0) execution.check();
    const bool is_last = t % grid.tile_cols + 1 == grid.tile_cols;
    const bool is_top = t + grid.tile_cols >= tiles.size();
    if (agree(grid, tiles[t], is_last ? nothing : tiles[t + 1], 0) &&
        agree(grid, tiles[t], is_top ? nothing : tiles[t + grid.tile_cols], 1)) {
      continue;
    }
    throw InputError("tiles", "neighbours do not agree about the border between them", std::to_string(t));
  }
}

}  // namespace warren
