// SPDX-License-Identifier: BSD-3-Clause
// Start and goal in a lattice: are they free, and which lattice points are they joined to? Those within one step of
// them by a free edge; where there is none, the nearest of the 256 nearest milestones that a free edge reaches. Cost:
// the walls of the tile around them, or all walls where they stand outside the tiles or need the wider look.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.hpp"
#include "planners/tiles/tile_grid.hpp"
#include "planners/tiles/tile_source.hpp"

namespace warren {

/// A free edge from start or goal to a lattice point.
struct EndLink {
  std::uint32_t col;
  std::uint32_t row;
  double length;
};

struct EndLinks {
  Vec2 at;
  bool free = false;
  std::vector<EndLink> links;
  std::uint64_t queries = 0;  ///< neighbour queries that the plain pipeline counts for it
  std::uint64_t checked = 0;  ///< edges put to the walls
};

/// What the look-up needs to know of the world.
struct LatticeWorld {
  const TileGrid& grid;
  const TileSource& tiles;
  Box box;           ///< the reference point stays in it
  double clearance;  ///< of planning
};

EndLinks end_links(const LatticeWorld& world, Vec2 at);

/// May start and goal be joined directly: are they within one step?
bool is_direct_candidate(Vec2 a, Vec2 b);

/// Is the direct edge between them free?
bool is_direct_edge_free(const LatticeWorld& world, Vec2 a, Vec2 b);

}  // namespace warren
