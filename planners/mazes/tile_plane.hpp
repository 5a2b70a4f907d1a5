// SPDX-License-Identifier: BSD-3-Clause
// The roadmap of one tile as a plane of bytes: a byte a lattice point, a bit for each of its four edges, one for the
// milestone itself. Around the tile lies one ring of the neighbours' points, so that edges over the border are known on
// both sides, and a margin that is never looked at, so that writers need no bounds checks. About one byte a cell:
// plane, walls and results of a tile stay in the second-level cache.
//
// Which milestones and edges of it do the walls block? Asked wall by wall: a wall looks up the few edges that
// its surroundings hold and clears those that it comes too near to; edges that no wall has cleared are free. So a tile
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
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "planners/mazes/tile_grid.hpp"
#include "planners/mazes/tile_source.hpp"

namespace warren {

/// Bits of a point. Directions d are 0 right, 1 up, 2 left, 3 down; the opposite of d is d ^ 2.
namespace plane_bit {
inline constexpr std::uint8_t right = 1, up = 2, left = 4, down = 8;
inline constexpr std::uint8_t edges = 15;      ///< the four edges
inline constexpr std::uint8_t milestone = 16;  ///< stands free
inline constexpr std::uint8_t kept =
    32;  ///< must survive the reduction: an edge leaves the tile, or start or goal joins
inline constexpr std::uint8_t key = 64;  ///< vertex of the overlay
}  // namespace plane_bit

constexpr std::uint8_t opposite_bit(unsigned direction) { return static_cast<std::uint8_t>(1U << (direction ^ 2)); }
constexpr unsigned first_direction(unsigned bits) { return static_cast<unsigned>(std::countr_zero(bits)); }

class TilePlane {
 public:
  /// margin: points around the tile that writers may touch; at least 1.
  TilePlane(const TileGrid& grid, int margin)
      : grid_(grid),
        margin_(margin),
        stride_(static_cast<int>(grid.side()) + 2 * margin),
        bytes_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(stride_)) {}

  /// Every lattice point of the tile and its ring stands free, with all edges to lattice points. Points outside `box`
  /// don't stand.
  void reset(std::size_t tile, const Box& box);

  const TileGrid& grid() const { return grid_; }
  std::size_t tile() const { return tile_; }
  int width() const { return static_cast<int>(grid_.width(tile_)); }
  int height() const { return static_cast<int>(grid_.height(tile_)); }
  int margin() const { return margin_; }
  int stride() const { return stride_; }
  /// Of the point (col, row) of the tile; the ring has -1 and width() or height().
  std::uint8_t* at(int col, int row) { return bytes_.data() + index(col, row); }
  const std::uint8_t* at(int col, int row) const { return bytes_.data() + index(col, row); }
  /// Where a point's neighbours lie.
  std::array<int, 4> offsets() const { return {1, stride_, -1, -stride_}; }

 private:
  std::ptrdiff_t index(int col, int row) const {
    return static_cast<std::ptrdiff_t>(row + margin_) * stride_ + (col + margin_);
  }
  TileGrid grid_;
  int margin_;
  int stride_;
  std::size_t tile_ = 0;
  std::vector<std::uint8_t> bytes_;
};

/// A row of a plane, the rows above and below it, and a row of scratch with a free byte before and after it.
struct PlaneRow {
  std::uint8_t* row;
  std::uint8_t* above;
  std::uint8_t* below;
  std::uint8_t* found;
  int width;
};

/// What is done to every point of a row of a tile's plane, many points an instruction. Integers only, so every
/// instruction set gives the same bytes; which one is used is asked of the processor once. The same work for one
/// instruction set.
struct PlaneRowWork {
  const char* name;
  /// Takes the row's dead ends off (points with one edge that are not kept become 0), and their edges from the
  /// neighbours in it, above and below. Of two dead ends that are all of their component the left one keeps standing
  /// without edges.
  void (*peel)(const PlaneRow&);
  /// found[i] becomes nonzero where point i is a dead end, else 0.
  void (*find_dead_ends)(const PlaneRow&);
  /// found[i] becomes nonzero where point i stands but for those with two edges that are not kept, else 0.
  void (*find_keys)(const PlaneRow&);
};

/// What this processor can run, the fastest last; the first needs nothing special.
std::vector<PlaneRowWork> plane_row_variants();

/// The fastest.
const PlaneRowWork& plane_row_work();

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
