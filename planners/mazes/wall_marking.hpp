// SPDX-License-Identifier: BSD-3-Clause
// Which milestones and edges of a tile do the walls block? Asked wall by wall: a wall looks up the few edges that its
// surroundings hold and clears those that it comes too near to; edges that no wall has cleared are free. So a tile
// needs no index of its walls, and an edge that is blocked already costs nothing more.
//
// Any segment is right: near ones of its candidates are put to the plain predicates (core/plane/geometry.hpp,
// segments_keep_distance), in double and in the world's coordinates. Where milestones repeat from cell to cell, walls
// of the same shape and the same place relative to their cell block the same edges relative to it: differences of
// multiples of 1/128 are exact, so the predicate returns the same bits. A NarrowWall therefore first looks for its
// shape in a small table of shapes seen before; only a shape that comes a second time is entered. Unit walls have two
// shapes, merged ones a dozen; where every wall is different, the table is of no use and costs 2 ns a wall. Cost: about
// 2 ns a wall of a known shape; 10 to 20 ns a candidate otherwise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "planners/mazes/tile_plane.hpp"
#include "planners/mazes/tile_source.hpp"

namespace warren {

/// Does the wall block the edge (or the milestone, an edge of length zero)? clearance 0: where they touch; else where
/// they are nearer than that. The same answer as WallIndex::keeps_clearance.
bool blocks_edge(const Segment& wall, const Segment& edge, double clearance) noexcept;

/// Scratch of one thread; may be used for one tile after the other.
class WallMarker {
 public:
  /// clearance: that of planning, from 0 to largest_clearance.
  explicit WallMarker(double clearance);
  static constexpr double largest_clearance = 8.0;

  /// The margin that a plane needs.
  int margin() const { return longest_shape + 2 * reach_ + 4; }
  /// Clears in the plane what the tile's walls block.
  void mark(const TileWalls& walls, TilePlane& plane);

 private:
  static constexpr int longest_shape = 16;     // walls of up to so many cells are remembered
  static constexpr unsigned most_clears = 40;  // and if they change no more points than that
  static constexpr std::size_t slot_count = 256;
  static constexpr std::uint64_t no_key = ~std::uint64_t{0};

  /// What walls of one shape clear, as places relative to the cell of their lower left corner.
  struct Shape {
    unsigned count;  // above most_clears: too many
    std::array<std::int16_t, most_clears> offset;
    std::array<std::uint8_t, most_clears> keep_bits;
  };

  void mark_narrow(std::span<const NarrowWall> walls, TilePlane& plane);
  void mark_shape(std::uint64_t key, const NarrowWall& wall, std::uint8_t* cell, TilePlane& plane);
  void learn(std::uint64_t key, Shape& shape, int stride) const;
  void mark_one(const Segment& wall, TilePlane& plane) const;

  struct Slot {
    std::uint64_t known = no_key;  ///< of the shape
    std::uint64_t seen = no_key;   ///< that came last, known or not
    Shape* shape = nullptr;
  };

  double clearance_;
  int reach_;       // cells that the clearance reaches, rounded up
  int stride_ = 0;  // that the shapes' offsets are for
  std::vector<Slot> slots_;
  RawVector<Shape> shapes_;  // room for one a slot; the first of them are taken, side by side
  std::size_t taken_ = 0;
};

}  // namespace warren
