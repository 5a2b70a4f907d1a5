// SPDX-License-Identifier: BSD-3-Clause
// Where a tile's walls come from, whether they are held or made when they are asked for. Each tile is given every wall
// that can block an edge of one of its lattice points.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "planners/mazes/tile_grid.hpp"
#include "planners/mazes/wall_partition.hpp"

namespace warren {

/// Gives tiles; belongs to one thread.
class TileReader {
 public:
  TileReader() = default;
  virtual ~TileReader() = default;
  TileReader(const TileReader&) = delete;
  TileReader& operator=(const TileReader&) = delete;
  /// Good until the next one is read.
  virtual TileWalls read(std::size_t tile) = 0;
};

/// Immutable; any number of readers may be at work.
class TileSource {
 public:
  TileSource() = default;
  virtual ~TileSource() = default;
  TileSource(const TileSource&) = delete;
  TileSource& operator=(const TileSource&) = delete;
  /// Tiles are read fastest band by band, each after it was begun.
  virtual std::uint32_t band_count() const { return 1; }
  /// Returns the band's tiles, ascending. No reader may be at work. Throws as WallPartition.
  virtual std::vector<std::size_t> begin_band(std::uint32_t band, const Execution& execution) = 0;
  virtual std::unique_ptr<TileReader> reader() const = 0;
  /// Of all walls.
  virtual Box box() const = 0;
  /// Calls visit with every wall whose box meets `around`, and perhaps others.
  virtual void for_each_near(const Box& around, const std::function<void(const Segment&)>& visit) const = 0;
};

/// Walls that are held, filed by tile (wall_partition.hpp), in so many bands of columns; 0: chosen by their number,
/// order and the memory that is left. A few walls in one tile are filed in one pass, without being counted. Refers to
/// walls, more, grid and execution. Throws as WallPartition.
std::unique_ptr<TileSource> held_tiles(const WallSet& walls, std::span<const Segment> more, const TileGrid& grid,
                                       double halo, std::uint32_t bands, const Execution& execution);

/// Walls on the sides of unit cells, made tile by tile; the grid's tiles are the source's. A tile is given its own
/// sides alone, which is enough for clearances below most_cell_clearance: whatever else stands half a step off its
/// edges.
std::unique_ptr<TileSource> cell_tiles(const CellWallSource& cells, const TileGrid& grid);
inline constexpr double most_cell_clearance = 0.5;

}  // namespace warren
