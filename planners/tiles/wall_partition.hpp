// SPDX-License-Identifier: BSD-3-Clause
// The walls of a world, filed by tile: each tile holds every wall whose box, grown by the halo, meets the tile, so that
// a tile can be worked on without looking elsewhere.
//
// Two streaming passes over the walls: count, then scatter; chunk borders depend on the number of walls alone and each
// chunk has its own places, so there are no atomics and the order is the walls' order. A wall that is a multiple of
// 1/128 in every coordinate and at most 64 long along each axis is filed in 8 bytes (NarrowWall), whatever it came as;
// any other is copied as it is (wide). A long wall is filed in the tiles that it passes, row of tiles by row of tiles,
// not in all that its box meets: memory is at most 8 bytes a short wall (16 or 32 where it is wide), a few per cent
// for walls near borders, and one copy a tile passed for long ones; asked of the memory limit before it is taken.
// Cost: 2 to 3 ns a wall to count, 4 to 6 to scatter (bench/tiled_phases.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/raw_vector.hpp"
#include "core/plane/wall_set.hpp"
#include "parallel/execution.hpp"
#include "planners/tiles/tile_grid.hpp"

namespace warren {

/// All that a tile needs to know of the walls: each list holds walls of its own.
struct TileWalls {
  std::span<const NarrowWall> narrow;
  std::span<const FloatWall> floats;
  std::span<const DoubleWall> doubles;
  std::span<const Segment> more;  ///< the same for every tile: may lie anywhere

  /// Calls visit(const Segment&) for each wall, as the exact segment that it is in the world.
  template <class Visit>
  void for_each(const TileGrid& grid, std::size_t tile, const Visit& visit) const {
    for (const NarrowWall& w : narrow) visit(grid.segment(tile, w));
    for_each_wide(visit);
  }
  template <class Visit>
  void for_each_wide(const Visit& visit) const {
    for (const FloatWall& w : floats) visit(w.segment());
    for (const DoubleWall& w : doubles) visit(w.segment());
    for (const Segment& w : more) visit(w);
  }
};

/// Immutable after construction; any number of threads may read.
class WallPartition {
 public:
  /// `more` are a few walls beside the set (bounds), kept by reference. halo >= 0, in the world's unit. Throws Stopped
  /// at the deadline or before memory would pass its limit, InputError where walls and tiles make 2^32 entries or more.
  WallPartition(const WallSet& walls, std::span<const Segment> more, const TileGrid& grid, double halo,
                const Execution& execution);

  TileWalls of(std::size_t tile) const;
  /// Of the set's walls.
  const Box& box() const { return box_; }

 private:
  Box box_;
  RawVector<std::uint32_t> first_narrow_;  // places of tile t: first_narrow_[t] .. first_narrow_[t + 1] - 1
  RawVector<std::uint32_t> first_wide_;
  RawVector<NarrowWall> narrow_;
  RawVector<FloatWall> floats_;    // wide walls, if the set holds floats
  RawVector<DoubleWall> doubles_;  // wide walls, if the set holds doubles
  std::span<const Segment> more_;
};

}  // namespace warren
