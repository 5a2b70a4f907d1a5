// SPDX-License-Identifier: BSD-3-Clause
// The first stages of the tiled lattice roadmap: each tile's milestones and edges, and its reduction, by all threads.
// Tiles share nothing: any of them may be made here, in an earlier run, or by another process.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/kept_parts.hpp"
#include "core/base/types.hpp"
#include "parallel/chunks.hpp"
#include "parallel/execution.hpp"
#include "planners/tiled/tile_overlay.hpp"
#include "planners/tiles/lattice_tile_reduction.hpp"
#include "planners/tiles/tile_grid.hpp"
#include "planners/tiles/tile_plane.hpp"
#include "planners/tiles/tile_source.hpp"
#include "planners/tiles/wall_marking.hpp"

namespace warren {

/// What the tiles are made of. Refers to grid, source and ends.
class LatticeTiles {
 public:
  /// clearance: of planning. box: the reference point stays in it. grain: tiles that a thread makes at once.
  LatticeTiles(const TileGrid& grid, const TileSource& source, Box box, double clearance, const OverlayEnds& ends,
               std::size_t grain)
      : grid_(grid), source_(source), box_(box), clearance_(clearance), ends_(ends), grain_(grain) {}

  /// The tile's roadmap before its reduction; what start and goal join is marked by keep_linked().
  void make_plane(std::size_t tile, TileReader& reader, WallMarker& marker, TilePlane& plane) const;
  void keep_linked(TilePlane& plane) const;
  /// Fills in summaries[i] of tile tiles.first + i. kept, where given, has those of an earlier run, without steps,
  /// and takes those that are made. Throws Stopped.
  void reduce(Range tiles, bool with_steps, std::span<TileSummary> summaries, KeptParts* kept,
              const Execution& execution) const;
  /// Fills in summaries[i], with steps, of tile tiles[i].
  void reduce(std::span<const std::size_t> tiles, std::span<TileSummary> summaries, const Execution& execution) const;

 private:
  class Maker;

  const TileGrid& grid_;
  const TileSource& source_;
  const Box box_;
  const double clearance_;
  const OverlayEnds& ends_;
  const std::size_t grain_;
};

}  // namespace warren
