// SPDX-License-Identifier: BSD-3-Clause
// Where segments between integer points have to be cut so that they share nothing but ends: at ends that lie inside
// another one (exact), and at crossings, which are rounded to integers. Rounding can bend pieces into new crossings, so
// who cuts must ask again until nothing is left. Every decision is exact; a rounded crossing lies within 0.71 of both.
// Time O(n + pairs that share a square of a grid with about as many squares as pieces).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "parallel/execution.hpp"

namespace warren {

/// How far rounding to the nearest point of a grid moves a point at most, in units of the grid.
inline constexpr double rounding_units = 0.7072;

/// A segment between integers (of at most 2^45, held as doubles).
struct IntegerPiece {
  Vec2 a, b;
  std::uint32_t source;  ///< whatever it is a piece of
};

/// A place where a piece must be cut.
struct Cut {
  std::uint32_t piece;
  Vec2 at;
  friend bool operator==(const Cut&, const Cut&) = default;
};

struct CrossingCuts {
  RawVector<Cut> cuts;   ///< some more than once
  bool crossed = false;  ///< is one of them a rounded crossing?
};

/// What is left to cut. Throws Stopped at the deadline and the memory limit: crowded pieces have many cuts.
CrossingCuts find_cuts(const std::vector<IntegerPiece>& pieces, const Execution& execution);

// Segments on an integer grid that meet at their ends only: what an exact Voronoi diagram of integers asks for.
//
// Coordinates are scaled by a power of two and rounded to integers of at most 2^29, about the middle of the box; world
// coordinates that are multiples of the grid's unit are exact. Then segments are split where others end on them, cross
// them or lie on them; crossings are rounded, which can bend segments into new crossings, so that is repeated until
// there are none (a few rounds; every round moves points by at most 0.71 units). Doubles are dropped; what has no
// length is a point. Every decision is exact (integers below 2^53 in core/plane/geometry's predicates). Error: no point
// of a segment moves by more than 0.71 + 0.71 rounds units of 2^-29 of half the box. Time O(n + pairs that share a
// square of a grid with about as many squares as segments) a round; one thread.

/// A piece of one of the given segments, in grid units; of length zero: a point.
struct SnappedSegment {
  std::int32_t x1, y1, x2, y2;
  std::uint32_t source;  ///< the lowest number of the segments that it is a piece of
};

/// The grid: a world point is origin + unit * (x, y).
struct SnapGrid {
  Vec2 origin;
  double unit = 1.0;  ///< a power of two

  Vec2 at(double x, double y) const { return {origin.x + unit * x, origin.y + unit * y}; }
};

struct SnappedSegments {
  SnapGrid grid;
  std::vector<SnappedSegment> segments;
  double error = 0.0;  ///< world units: how far a piece may lie from its segment, at most
};

/// Throws InputError where the rounding doesn't come to rest, or for 2^31 pieces and more; Stopped at the deadline.
SnappedSegments snap_segments(std::span<const Segment> segments, const Execution& execution);

// Polygons that may overlap, cut so that their sides share nothing but corners: a corner wherever sides cross, end on
// each other or lie on each other. What the polygons cover together then shows at each side: it bounds the union where
// no polygon covers one of its sides (the number of polygons above a side is what a sweep counts).
//
// Crossings are no doubles in general, so all corners are rounded to multiples of a power of two, 2^-45 of the largest
// coordinate, and the cutting is repeated until nothing crosses (planners/visibility/noding); from there on
// everything is exact. No point of an outline moves by more than 0.71 units a round, and a few rounds do: `error`
// tells. Corners move, outlines stay closed, so the count of polygons around a point is right for all points farther
// than `error` from the outlines. Time: O(n + pairs that come near each other) a round; one thread.

struct NodedPolygons {
  PolygonSet polygons;  ///< in the same order; those that vanish when rounded have no corners
  double error = 0.0;   ///< world units: how far a point of an outline may have moved
};

/// Throws InputError where the rounding doesn't come to rest, or for 2^31 sides and more; Stopped at the deadline.
NodedPolygons node_polygons(const PolygonSet& polygons, const Execution& execution);

}  // namespace warren
