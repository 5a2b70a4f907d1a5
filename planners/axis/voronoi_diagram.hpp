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
#include "core/run/execution.hpp"
#include "planners/visibility/noding.hpp"

namespace warren {

/// A point (a == b) or an open segment, whose ends are sites of their own.
struct AxisSite {
  Vec2 a, b;
  bool is_point() const { return a == b; }
};

/// An edge of the diagram: the points with the same distance to two sites. Straight between two points or two segments;
/// between a point and a segment an arc of the parabola with that focus and directrix. Arcs are kept as arcs: place,
/// length and narrowest point are closed formulas of the parameter, which is the coordinate along the line or along the
/// directrix. Rounding aside, all is exact. Every operation is O(1), polylines O(points).
class AxisCurve {
 public:
  /// Between `from` and `to`, both as far from one site as from the other.
  AxisCurve(const AxisSite& one, const AxisSite& other, Vec2 from, Vec2 to);

  double first() const { return first_; }  ///< parameters of `from` and `to`, in either order
  double last() const { return last_; }
  Vec2 from() const { return from_; }
  Vec2 to() const { return to_; }
  Vec2 at(double parameter) const;
  /// The parameter of the curve's point beside p: at its foot on the line or the directrix.
  double parameter_beside(Vec2 p) const { return dot(p - origin_, along_); }
  /// The parameter at which the curve, continued at both ends, is nearest to its sites; `first` where there is no such.
  double waist() const { return waist_; }
  /// From one parameter to another, in this order. Both within [first, last], or the reverse.
  AxisCurve part(double from, double to) const;
  /// The same curve between points that are its ends but for rounding.
  AxisCurve between(Vec2 from, Vec2 to) const;
  double length() const;
  /// Appends the points after `from` up to `to` of a polyline along the curve. An arc's polyline is made of tangents,
  /// so it lies on the directrix's side, where the distance to the directrix is that to the nearest site: it comes no
  /// nearer to the sites than the arc does. Tangents are 1/32 radians apart at most: 1e-4 of the length more than the
  /// arc's.
  void append_polyline(std::vector<Vec2>& path) const;

 private:
  double slope_angle(double parameter) const;

  Vec2 origin_;           // of the parameter: `from`, or the focus' foot on the directrix
  Vec2 along_, upwards_;  // units; upwards_ only for arcs: from the directrix to the focus
  double focal_ = 0.0;    // distance of focus and directrix; 0: straight
  double first_ = 0.0, last_ = 0.0, waist_ = 0.0;
  Vec2 from_, to_;
};

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
