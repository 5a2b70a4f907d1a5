// SPDX-License-Identifier: BSD-3-Clause
// Which tiles are filed together: all, or bands of tiles one after the other, so that not all walls are held twice.
// Where the walls come in some order, a band takes but a part of the list, and many bands cost no more than one: the
// copies then are a 16th of the walls. Where they come in no order, each band is a pass over all walls, and there are
// as few as the memory allows. What is made of the tiles is the same for any bands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/execution.hpp"
#include "planners/tiles/tile_grid.hpp"
#include "planners/tiles/wall_counts.hpp"

namespace warren {

/// `count` bands of whole columns (or rows) of tiles.
struct TileBands {
  std::uint32_t count = 1;
  bool by_rows = false;

  /// In which a tile is.
  std::uint32_t of(const TileGrid& grid, std::size_t tile) const {
    const std::size_t at = by_rows ? tile / grid.tile_cols : tile % grid.tile_cols;
    return static_cast<std::uint32_t>(at * count / (by_rows ? grid.tile_rows : grid.tile_cols));
  }
  /// Ascending.
  std::vector<std::size_t> tiles(const TileGrid& grid, std::uint32_t band) const;
};

/// wall_bytes: of a wide wall. Asks the memory limit how much is left.
TileBands choose_bands(const WallCounts& counts, const TileGrid& grid, std::size_t wall_bytes,
                       const Execution& execution);

}  // namespace warren
