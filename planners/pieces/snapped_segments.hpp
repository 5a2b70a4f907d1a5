// SPDX-License-Identifier: BSD-3-Clause
// Segments on an integer grid that meet at their ends only: what an exact Voronoi diagram of integers asks for.
//
// Coordinates are scaled by a power of two and rounded to integers of at most 2^29, about the middle of the box; world
// coordinates that are multiples of the grid's unit are exact. Then segments are split where others end on them, cross
// them or lie on them; crossings are rounded, which can bend segments into new crossings, so that is repeated until
// there are none (a few rounds; every round moves points by at most 0.71 units). Doubles are dropped; what has no
// length is a point. Every decision is exact (integers below 2^53 in core/plane/geometry's predicates). Error: no point
// of a segment moves by more than 0.71 + 0.71 rounds units of 2^-29 of half the box. Time O(n + pairs that share a
// square of a grid with about as many squares as segments) a round; one thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"

namespace warren {

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

}  // namespace warren
