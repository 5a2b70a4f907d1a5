// SPDX-License-Identifier: BSD-3-Clause
// The overlay of some rows of tiles, peeled by itself before it meets the others': what has an edge out of the band
// stays, dead ends that end within it go. What is left is said as summaries again, keys and edges in their order, so
// that the overlay of all bands is that of all tiles but for what its own peeling would have taken away.
#pragma once

#include <cstddef>
#include <span>

#include "parallel/execution.hpp"
#include "planners/tiled/tile_overlay.hpp"
#include "planners/tiles/lattice_tile_reduction.hpp"
#include "planners/tiles/tile_grid.hpp"

namespace warren {

/// tiles: summaries without steps of the tile rows first_row .. last_row - 1; components that are gone are counted as
/// closed in the first of them. ends: what they join stays. As much memory as the band's overlay. Throws Stopped,
/// InputError where the tiles contradict each other.
void peel_band(const TileGrid& grid, std::size_t first_row, std::size_t last_row, const OverlayEnds& ends,
               std::span<TileSummary> tiles, const Execution& execution);

}  // namespace warren
