// SPDX-License-Identifier: BSD-3-Clause
// Do neighbouring tiles that were reduced elsewhere, or at another time, say the same of the border between them?
#pragma once

#include <span>

#include "parallel/execution.hpp"
#include "planners/tiles/lattice_tile_reduction.hpp"
#include "planners/tiles/tile_grid.hpp"

namespace warren {

/// Compares the points with a free edge over each border. Throws InputError where they differ, Stopped.
void check_borders(const TileGrid& grid, std::span<const TileSummary> tiles, const Execution& execution);

}  // namespace warren
