// SPDX-License-Identifier: BSD-3-Clause
// Which sides of unit cells a body with clearance can cross, asked wall by wall: a side is closed where both of its
// ends are nearer than the clearance to one wall, for then all of it is. Walls that do not run along the cells close
// nothing. O(walls + cells), a byte a cell; a long wall takes some tens of steps in each cell that it passes.
#pragma once

#include <cstddef>

#include "core/plane/cell_sides.hpp"
#include "parallel/execution.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren {

/// Of the cells that meet the box. Nothing where they are more than most_cells, where the clearance is below a
/// thousandth of a cell, or coordinates are beyond 10^9: then a point's cell may not be told for sure. Throws Stopped.
CellSides open_sides(const WallIndex& walls, const Box& box, double clearance, std::size_t most_cells,
                     const Execution& execution);

}  // namespace warren
