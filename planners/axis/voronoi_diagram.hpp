// SPDX-License-Identifier: BSD-3-Clause
// The Voronoi diagram of segments with integer ends, as plain arrays: Boost.Polygon's (Fortune's sweep, exact
// predicates), of which only finite edges between different obstacles are kept. Topology is exact; vertices are right
// to 64 units in the last place. Time O(n log n), memory about 1 kB a segment while it is built, one thread;
// about 25 microseconds a segment of polygons. Boost asks for nothing but predicates in between, so they look at the
// deadline.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "planners/axis/axis_curve.hpp"
#include "planners/pieces/snapped_segments.hpp"

namespace warren {

/// A segment without its ends, or an end; a == b for points. Coordinates in grid units.
struct VoronoiSite {
  AxisSite shape;
  std::uint32_t segment;  ///< the number of a segment that it belongs to
};

/// Between two vertices, and between two sites that share no point (or are two segments that share an end).
struct VoronoiEdge {
  std::uint32_t from, to;
  std::uint32_t site, other;
};

struct VoronoiDiagram {
  std::vector<Vec2> vertices;  ///< in grid units
  std::vector<VoronoiSite> sites;
  std::vector<VoronoiEdge> edges;
};

/// segments meet at their ends only, as snap_segments leaves them. Throws Stopped; for memory only before it
/// begins.
VoronoiDiagram voronoi_diagram(std::span<const SnappedSegment> segments, const Execution& execution);

}  // namespace warren
