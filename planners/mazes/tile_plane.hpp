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
#include <span>
#include <vector>

#include "core/base/packed_values.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
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

// The exact reduction of a tile's roadmap that shortest paths allow. A dead end (a vertex with one edge that is neither
// start nor goal) lies on no shortest path but its own, so dead ends are peeled off until none is left; what lies
// between two vertices that remain and offers no choice (vertices with two edges) becomes one chain. Vertices with an
// edge over the border, and those that start or goal join, are kept. The number of components doesn't change under
// either.
//
// Peeling follows each dead end inwards as far as it goes, so one pass over the plane is enough: O(points). What is
// left in a maze is a few per cent of the vertices, in open space nearly all. Lengths are counted in steps between
// lattice points. planners/graph/roadmap_search.hpp does the same to a graph, which would have to be made first: 20
// bytes a point, where the plane has one.

/// A way between two keys of a tile, over vertices without choice.
struct Chain {
  std::uint16_t from;  ///< key number; different from `to`
  std::uint16_t to;
  std::uint32_t first_step;  ///< in TileSummary::steps
  std::uint32_t length;      ///< in steps, >= 1
};

/// What a tile says to the rest: all that a search needs, and how to find the vertices of a chain again. Values only,
/// so that it can come from another process.
struct TileSummary {
  std::vector<std::uint16_t> keys;  ///< vertices that are left: row * side + col, ascending
  std::vector<Chain> chains;        ///< ascending by `from`
  std::vector<std::uint8_t> steps;  ///< directions of the chains, from -> to
  /// Keys with a free edge over the right, upper, left, lower border, ascending along it: the same number, in the same
  /// order, as the neighbour has on its side.
  std::array<std::vector<std::uint16_t>, 4> crossings;
  std::uint64_t milestones = 0;         ///< free lattice points of the tile
  std::uint64_t candidate_edges = 0;    ///< pairs of free neighbours whose lower left end is in the tile
  std::uint64_t free_edges = 0;         ///< those of them that no wall blocks
  std::uint64_t closed_components = 0;  ///< components that have no key: they lie inside the tile

  std::size_t bytes() const {
    std::size_t total = sizeof(*this) + keys.size() * 2 + chains.size() * sizeof(Chain) + steps.size();
    for (const auto& side : crossings) total += side.size() * 2;
    return total;
  }
};

/// Scratch of one thread.
class TileReduction {
 public:
  explicit TileReduction(const TilePlane& plane);
  /// Reduces the plane, which is used up.
  TileSummary reduce(TilePlane& plane);

 private:
  void peel(TilePlane& plane);
  void follow_dead_end(std::uint8_t* at) const;
  void number_keys(TilePlane& plane, TileSummary& summary);
  void cut_crossings(TilePlane& plane, TileSummary& summary);
  void chain_keys(TilePlane& plane);
  void follow(std::uint8_t* from, unsigned direction, const TilePlane& plane);
  void close_rings(TilePlane& plane, TileSummary& summary) const;

  static constexpr int bulk_passes = 4;

  std::array<int, 4> offset_;        // where a point's neighbours lie
  std::vector<std::uint8_t> found_;  // scratch for a row
  RawVector<std::uint16_t> number_;  // of a key, by place in the plane; of others none
  std::vector<std::uint16_t> keys_;
  std::vector<std::int32_t> places_;  // of the keys, in the plane
  std::vector<Chain> chains_;
  RawVector<std::uint8_t> steps_;  // room for all edges of a tile
  std::uint32_t step_count_ = 0;
};

/// Tile summaries as bytes, for files and other processes.
void pack_summary(const TileSummary& tile, ValuePacker& to);
/// Throws InputError where the bytes are no summary of a tile of this side.
TileSummary unpack_summary(ValueUnpacker& from, std::uint32_t side);

/// Do neighbouring tiles that were reduced elsewhere, or at another time, say the same of the border between them?
/// Compares the points with a free edge over each border. Throws InputError where they differ, Stopped.
void check_borders(const TileGrid& grid, std::span<const TileSummary> tiles, const Execution& execution);

}  // namespace warren
