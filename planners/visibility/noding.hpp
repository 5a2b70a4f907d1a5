// SPDX-License-Identifier: BSD-3-Clause
// Segments and polygons cut so that they share nothing but ends: segments on an integer grid for an exact Voronoi
// diagram, and outlines that may overlap for the union of polygons.
//
// Segments between integer points are cut at ends that lie inside another one (exact), and at crossings, which are
// rounded to integers. Rounding can bend pieces into new crossings, so that is repeated until nothing is left: a few
// rounds. Every decision is exact (integers below 2^53 in core/plane/geometry's predicates); a round moves points by
// at most 0.71 units. Time O(n + pairs that share a square of a grid with about as many squares as pieces) a round;
// one thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"

namespace warren {

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
