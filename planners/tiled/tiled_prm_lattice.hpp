// SPDX-License-Identifier: BSD-3-Clause
// The lattice roadmap of planners/roadmap/prm.hpp, every edge checked, fused tile by tile: the way for mazes of
// hundreds of millions of cells.
//
//   partition   walls are filed by tile, in streaming passes, band by band                 (wall_partition)
//   tiles       one thread a tile, all in its cache: milestones and edges stand until a    (tile_plane, wall_marking)
//               wall clears them; dead ends are peeled, chains contracted                   (tile_reduction)
//   overlay     what is left of all tiles, peeled again across borders                      (overlay)
//   search      from both ends on the overlay's core; the path's chains are expanded again  (step_search)
//
// The answer is the plain pipeline's: the same milestones and edges, a path of the same length (shortest paths that tie
// may differ in their vertices). Peeling and contraction are exact for any set of walls: mazes with loops, open space,
// crossing and slanted segments; only the gain differs. Borders of tiles and all switches between two ways of working
// follow from counts, so path and counters are the same for any thread count. Cost in a maze, ns of CPU a cell: see
// bench/tiled_phases.cpp; memory beside the walls: 8 bytes a wall of a band (tile_bands) until the tiles are done, then
// a fraction of a byte a cell. In open space every milestone is a vertex of the overlay: about 80 bytes each. A tile is
// a function of its number, its walls and the vertices that start and goal join; tiles share nothing, and what they
// hand back is plain values. So walls need not be held: where they come from a CellWallSource, each tile's are made,
// reduced and forgotten, and what stays is the overlay, 0.3 to 0.5 bytes a cell.
#pragma once

#include <optional>
#include <span>

#include "core/base/kept_parts.hpp"
#include "core/base/path_taker.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/plane/wall_set.hpp"
#include "parallel/execution.hpp"
#include "planners/roadmap/roadmap_options.hpp"
#include "planners/tiled/other_tiles.hpp"

namespace warren {

/// A world of walls, a lattice and a question. Refers to the walls or cells, which must outlive the call.
struct TiledProblem {
  const WallSet& walls;
  std::span<const Segment> more_walls;  ///< a few beside the set: the bounds
  std::optional<Box> box;               ///< the reference point stays in it; if none, in that of the walls
  double clearance = 0.0;               ///< >= 0; planned with r (1 + 1e-9), as MazeWorld does
  Vec2 start;
  Vec2 goal;
  const CellWallSource* cells = nullptr;  ///< walls that are made when they are asked for, instead of the set
  bool forget = false;                    ///< keep of the tiles the overlay alone, and make those of the path again
  PathTaker* taker = nullptr;             ///< where tiles are forgotten: receives the path instead of Solution::path
  KeptParts* kept = nullptr;              ///< where tiles are forgotten: has reduced tiles of an earlier run
  OtherTiles* others = nullptr;           ///< where tiles are forgotten: makes them instead of this process
  std::uint32_t bands = 0;                ///< that the tiles of the set are filed in; 0: as order and memory ask for
};

/// Can tiled_prm give the plain pipeline's answer under these options? The lattice with its own rule of joining (radius
/// 1), a shortest-path search, and a clearance of at most 8 steps of the lattice.
bool tiled_prm_applies(const RoadmapOptions& options, double clearance);

/// Plans as prm() does. Never throws Stopped: a budget's end gives Outcome::stopped, or, once it is known that there is
/// no way, not_connected without a separation. InputError where
/// tiled_prm_applies() is false, for cells and a clearance of half a cell, or for options out of range.
Solution<Vec2> tiled_prm(const TiledProblem& problem, const RoadmapOptions& options, const Execution& execution);

}  // namespace warren
