// SPDX-License-Identifier: BSD-3-Clause
// The passages of the lattice roadmap among walls: bit for bit the edges that the tiled planner and the plain one with
// the lattice sampler use. The tiles of planners/tiles make them: walls are filed by tile, each tile's plane of bytes
// loses what they block, and its bytes are packed to bits. Cost: that of the tiled planner's first two stages, about 5
// ns of CPU a cell in a maze, and 8 bytes a wall for the time of it.
#pragma once

#include <optional>
#include <span>

#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"
#include "parallel/execution.hpp"
#include "planners/route_trees/lattice_passages.hpp"

namespace warren {

/// A world of walls and the lattice in it: point (col, row), both from 0, stands at (col + 1, row + 1). Refers to the
/// walls.
struct WalledLattice {
  const WallSet& walls;
  std::span<const Segment> more_walls;  ///< a few beside the set: the bounds
  std::optional<Box> box;               ///< the reference point stays in it; if none, in that of the walls
  double clearance = 0.0;               ///< 0 to 8; planned with r (1 + 1e-9), as MazeWorld does
  LatticeSize lattice;
};

/// Throws Stopped, and InputError for a clearance or a lattice out of range.
LatticePassages wall_passages(const WalledLattice& world, const Execution& execution);

}  // namespace warren
