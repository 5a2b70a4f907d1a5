// SPDX-License-Identifier: BSD-3-Clause
// Vertical (trapezoidal) cells of the free plane among polygons and walls in a box: from every corner a vertical line
// runs up and down through free space to the next obstacle, and what lies between these lines is a cell.
//
// A sweep line passes the corners from left to right, those of one x from bottom to top (as if the plane were sheared
// by an infinitesimal amount: x + eps y, so that no two corners are above each other and nothing is vertical). It keeps
// the segments that it meets in order, and each free gap between two of them is an open cell (de Berg et al.,
// Computational Geometry, ch. 6). Every decision is the sign of an exact orientation of input points, which the shear
// does not change; no point is constructed. Time O(n log n) for n corners, one thread; a corner with one segment on
// each side costs O(1), so sorting dominates. Memory: 150 bytes a corner.
//
// Obstacles may touch: share corners and parts of sides, end on each other; walls may lie inside polygons. What crosses
// or overlaps is refused (ObstacleClash). A corner on the box's side is taken as if the box were larger by nothing: the
// cells and doors are the same as of a larger box. The door between corner and side has no length; it is shut if the
// box is that of the bounds, which are walls. Where the box only confines, it is open (paths run along polygons on the
// box) unless a wall lies there on the box. So k disjoint simple polygons with V corners have exactly V + k + 1 cells
// and V + 2k doors, and a wall counts as a polygon of two corners.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// Thrown where two obstacles cross or overlap, or one reaches out of the bounds or crosses itself.
class ObstacleClash : public InputError {
 public:
  static constexpr std::size_t bounds = static_cast<std::size_t>(-1);  ///< in place of an obstacle's number

  /// Obstacles are numbered: polygons from 0 on, then walls.
  ObstacleClash(std::size_t obstacle, std::size_t other, std::size_t polygon_count);
  std::size_t obstacle() const { return obstacle_; }
  std::size_t other() const { return other_; }  ///< may be the same one

 private:
  std::size_t obstacle_;
  std::size_t other_;
};

/// What the sweep does where polygons overlap.
enum class Overlaps : std::uint8_t { refused, united };

/// In place of a cell, a corner, a door or a polygon.
inline constexpr std::uint32_t no_number = 0xffffffffU;

/// Closed trapezoid between two segments and two vertical lines; a triangle, or flat, where they meet.
struct VerticalCell {
  std::uint32_t lower, upper;          ///< segments; `floor_segment`, `ceiling_segment`: the box
  std::uint32_t left, right;           ///< corners through which its vertical sides run; no_number: the box
  std::array<std::uint32_t, 4> doors;  ///< left lower, left upper, right lower, right upper; no_number: none
};

/// The vertical line from a corner to the next segment above or below it: the border between two cells.
struct Door {
  std::uint32_t left, right;  ///< cells
  std::uint32_t corner;       ///< one end of the door
  bool above;                 ///< is the door above its corner?
  bool shut;                  ///< of length zero, between a corner and the box's side that it lies on
};

/// Where a point lies.
struct CellPlace {
  bool blocked = false;         ///< strictly inside a polygon, or outside the box
  std::vector<VertexId> cells;  ///< that contain it, ascending: several on their borders; may be empty where it touches
};

/// Immutable after decompose().
struct CellDecomposition {
  static constexpr std::uint32_t floor_segment = 0xfffffffeU;
  static constexpr std::uint32_t ceiling_segment = 0xffffffffU;

  Box box;
  std::vector<Vec2> corners;      ///< of the polygons, then both ends of each wall
  std::vector<Segment> segments;  ///< polygons' sides, each from the corner of its number on, then walls; a before b
  std::vector<VerticalCell> cells;
  std::vector<Door> doors;
  std::vector<CellPlace> places;  ///< of the points that were asked about

  /// The cell on the other side.
  std::uint32_t beyond(std::uint32_t door, std::uint32_t cell) const {
    return doors[door].left == cell ? doors[door].right : doors[door].left;
  }
  /// The cell that two doors have in common.
  std::uint32_t shared_cell(std::uint32_t door, std::uint32_t other) const {
    const Door& d = doors[door];
    const Door& o = doors[other];
    return d.left == o.left || d.left == o.right ? d.left : d.right;
  }
  /// The segment of the cells below or above, where the door ends.
  std::uint32_t far_segment(std::uint32_t door) const {
    const Door& d = doors[door];
    return d.above ? cells[d.right].upper : cells[d.right].lower;
  }
  /// Does p lie above (+1), on (0) or below (-1) the segment's line? Exact.
  int side(std::uint32_t segment, Vec2 p) const noexcept;
  /// Height of the segment, or of the box's side, at x; rounded.
  double height(std::uint32_t segment, double x) const noexcept;
  /// The door's ends for drawing, lower first; rounded.
  Segment door_line(std::uint32_t door) const;
};

/// Decomposes the free part of the bounds; without bounds, of the obstacles' box; without obstacles, of the points'
/// box. Then locates the points. Polygons and walls outside the bounds are left out; walls of length zero too.
/// Throws ObstacleClash; InputError for 2^31 corners and more; Stopped at the deadline.
///
/// united: around the union of polygons that may overlap and reach out of the bounds; there are no walls. Corners are
/// rounded by so little that they share nothing but corners (node_polygons), hence for obstacles that
/// were grown by more. The bounds are made a frame of four polygons. Never throws ObstacleClash.
CellDecomposition decompose(const PlaneObstacles& obstacles, std::span<const Vec2> points, const Execution& execution,
                            Overlaps overlaps = Overlaps::refused);

/// Where a point lies among vertical cells. Every decision is exact. O(cells + corners), a comparison or two for most
/// of them. `cells` are those of decompose() for the same obstacles. Throws Stopped.
CellPlace locate(const CellDecomposition& cells, const PlaneObstacles& obstacles, Vec2 p, const Execution& execution);

/// Is the cell one between the box's side and a segment on it where nobody can move? That is so for the bounds, which
/// are walls. Where the box only confines, paths run along polygons on it, but not between walls and it.
bool is_flat(const CellDecomposition& cells, const PlaneObstacles& obstacles, const VerticalCell& cell);

// Segments and polygons cut so that they share nothing but ends: segments on an integer grid for an exact Voronoi
// diagram, and outlines that may overlap for the union of polygons.
//
// Segments between integer points are cut at ends that lie inside another one (exact), and at crossings, which are
// rounded to integers. Rounding can bend pieces into new crossings, so that is repeated until nothing is left: a few
// rounds. Every decision is exact (integers below 2^53 in core/plane/geometry's predicates); a round moves points by
// at most 0.71 units. Time O(n + pairs that share a square of a grid with about as many squares as pieces) a round;
// one thread.

/// A segment between integers (of at most 2^45, held as doubles); of length zero: a point.
struct IntegerPiece {
  Vec2 a, b;
  std::uint32_t source;  ///< the number of what it is a piece of; the lowest one of what lies on it
};

/// The grid: a world point is origin + unit * (x, y).
struct SnapGrid {
  Vec2 origin;
  double unit = 1.0;  ///< a power of two

  Vec2 at(double x, double y) const { return {origin.x + unit * x, origin.y + unit * y}; }
};

struct SnappedSegments {
  SnapGrid grid;
  std::vector<IntegerPiece> segments;  ///< in grid units
  double error = 0.0;                  ///< world units: how far a piece may lie from its segment, at most
};

/// Segments that meet at their ends only. Coordinates are scaled by a power of two and rounded to integers of at most
/// 2^29, about the middle of the box; world coordinates that are multiples of the grid's unit are exact. Doubles are
/// dropped; what has no length is a point. No point of a segment moves by more than 0.71 + 0.71 rounds units of 2^-29
/// of half the box. Throws InputError where the rounding doesn't come to rest, or for 2^31 pieces and more; Stopped at
/// the deadline.
SnappedSegments snap_segments(std::span<const Segment> segments, const Execution& execution);

/// Polygons whose sides share nothing but corners.
struct NodedPolygons {
  PolygonSet polygons;  ///< in the same order; those that vanish when rounded have no corners
  double error = 0.0;   ///< world units: how far a point of an outline may have moved
};

/// Polygons that may overlap get a corner wherever sides cross, end on each other or lie on each other. What they cover
/// together then shows at each side: it bounds the union where no polygon covers one of its sides (the number of
/// polygons above a side is what a sweep counts). Corners are rounded to multiples of a power of two, 2^-45 of the
/// largest coordinate; outlines stay closed, so the count of polygons around a point is right for all points farther
/// than `error` from the outlines. Throws InputError where the rounding doesn't come to rest, or for 2^31 sides and
/// more; Stopped at the deadline.
NodedPolygons node_polygons(const PolygonSet& polygons, const Execution& execution);

}  // namespace warren
