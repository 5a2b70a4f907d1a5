// SPDX-License-Identifier: BSD-3-Clause
// The lattice roadmap of planners/roadmap/prm.hpp, every edge checked, fused tile by tile: the way for mazes of
// hundreds of millions of cells.
//
//   partition   walls are filed by tile, in streaming passes, band by band                 (tile_source)
//   tiles       one thread a tile, all in its cache: milestones and edges stand until a    (tile_plane)
//               wall clears them; dead ends are peeled, chains contracted
//   overlay     what is left of all tiles, peeled again across borders                      (overlay)
//   search      from both ends on the overlay's core; the path's chains are expanded again  (overlay)
//
// The answer is the plain pipeline's: the same milestones and edges, a path of the same length (shortest paths that tie
// may differ in their vertices). Peeling and contraction are exact for any set of walls: mazes with loops, open space,
// crossing and slanted segments; only the gain differs. Borders of tiles and all switches between two ways of working
// follow from counts, so path and counters are the same for any thread count. Cost in a maze, ns of CPU a cell: see
// bench/tiled_phases.cpp; memory beside the walls: 8 bytes a wall of a band until the tiles are done, then
// a fraction of a byte a cell. In open space every milestone is a vertex of the overlay: about 80 bytes each. A tile is
// a function of its number, its walls and the vertices that start and goal join; tiles share nothing, and what they
// hand back is plain values. So walls need not be held: where they come from a CellWallSource, each tile's are made,
// reduced and forgotten, and what stays is the overlay, 0.3 to 0.5 bytes a cell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/packed_values.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/mazes/overlay.hpp"
#include "planners/mazes/tile_plane.hpp"
#include "planners/mazes/tile_source.hpp"

namespace warren {
// Who makes and reduces the tiles of a lattice where that is not the planner's own process.

/// A chain of a path: places of its ends in the tile (row * side + col), the lower first, and its steps.
struct TileChain {
  std::uint64_t tile;
  std::uint16_t from, to;
  std::uint32_t length;
};

class OtherTiles : NotCopied {
 public:
  virtual ~OtherTiles() = default;
  /// All tiles' summaries without steps. Dead ends of the overlay may be gone from them, the others' keys in their
  /// order; components that are gone with them are counted as closed. Throws Stopped.
  virtual std::vector<TileSummary> reduce_all(const OverlayEnds& ends, const Execution& execution) = 0;
  /// The same with all their keys, where the walk along dead ends matters. Throws Stopped, also where this process
  /// can't hold them.
  virtual std::vector<TileSummary> reduce_whole(const OverlayEnds& ends, const Execution& execution) = 0;
  /// After reduce_all(): do the others search, since this process could not hold the overlay? Then the summaries have
  /// neither keys nor chains, and their counts are those of all tiles together.
  virtual bool searches() const = 0;
  /// What the search over all tiles finds. Throws Stopped.
  virtual ToldRoute search(const OverlayEnds& ends, const Execution& execution) = 0;
  /// The directions of each chain, from its lower end. Throws Stopped.
  virtual std::vector<std::vector<std::uint8_t>> steps_of(std::span<const TileChain> chains,
                                                          const Execution& execution) = 0;
};

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

// The first stages of the tiled lattice roadmap: each tile's milestones and edges, and its reduction, by all threads,
// each of which makes `grain` tiles at once. Tiles share nothing: any of them may be made here, in an earlier run, or
// by another process.

/// Of tiles in a row. kept, where given, has those of an earlier run, without steps, and takes those that are made.
/// Throws Stopped.
std::vector<TileSummary> reduce_tiles(const LatticeWorld& world, const OverlayEnds& ends, std::size_t grain,
                                      Range tiles, bool with_steps, KeptParts* kept, const Execution& execution);
/// Of any tiles, with steps. Throws Stopped.
std::vector<TileSummary> reduce_tiles(const LatticeWorld& world, const OverlayEnds& ends, std::size_t grain,
                                      std::span<const std::size_t> tiles, const Execution& execution);

}  // namespace warren
