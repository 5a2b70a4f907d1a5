// SPDX-License-Identifier: BSD-3-Clause
// The hash of a maze's world from its cells: that of all its walls in the course's order, of which no more than a strip
// of columns a thread is made at once. By it whoever has a maze as bits knows that it is the world that it should be.
#pragma once

#include <cstddef>
#include <string>

#include "core/plane/cell_walls.hpp"
#include "parallel/execution.hpp"

namespace warren {

struct HashedCells {
  std::string hash;       ///< scene_hash() of the walls
  std::size_t walls = 0;  ///< how many they are
};

/// Of the walls that maze_walls() makes, not merged, of the same cells: the outline's are the course's. Some ns a cell.
/// Throws Stopped.
HashedCells hash_of_cells(const CellWallSource& cells, const Execution& execution);

}  // namespace warren
