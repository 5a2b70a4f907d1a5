// SPDX-License-Identifier: BSD-3-Clause
// The medial axis of the free plane: the points that have two nearest obstacles, as a graph of curves. It is the
// Voronoi diagram of walls, polygons' sides and the frame (the bounds' sides; without bounds, those of the obstacles'
// box), pruned to what lies inside the frame and outside all polygons.
//
// The diagram is exact for ends snapped to a grid of 2^-29 of half the world (snap_segments()); clearances are computed
// anew at each curve's narrowest point, as distances to the obstacles that were given. Gaps narrower than `resolution`
// (a few units of the grid) count as closed. Polygons must not overlap, which decompose() finds; both stand in
// planners/vertical_cells/cell_decomposition.hpp.
//
// Below it, the Voronoi diagram of segments with integer ends, as plain arrays: Boost.Polygon's (Fortune's sweep,
// exact predicates), of which only finite edges between different obstacles are kept. Topology is exact; vertices are
// right to 64 units in the last place. Time O(n log n), 20 to 25 microseconds a segment (bench/cells_bench.cpp), one
// thread; memory about 1 kB a segment while it is built. Boost asks for nothing but predicates in between, so they look
// at the deadline.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// A site of the diagram is a point, or an open segment, whose ends are sites of their own.
inline bool is_point(const Segment& site) { return site.a == site.b; }

/// An edge of the diagram: the points with the same distance to two sites. Straight between two points or two segments;
/// between a point and a segment an arc of the parabola with that focus and directrix. Arcs are kept as arcs: place,
/// length and narrowest point are closed formulas of the parameter, which is the coordinate along the line or along the
/// directrix. Rounding aside, all is exact. Every operation is O(1), polylines O(points).
class AxisCurve {
 public:
  /// Between `from` and `to`, both as far from one site as from the other.
  AxisCurve(const Segment& one, const Segment& other, Vec2 from, Vec2 to);

  double first() const { return first_; }  ///< parameters of `from` and `to`, in either order
  double last() const { return last_; }
  Vec2 from() const { return from_; }
  Vec2 to() const { return to_; }
  Vec2 at(double parameter) const;
  /// The parameter of the curve's point beside p: at its foot on the line or the directrix.
  double parameter_beside(Vec2 p) const { return dot(p - origin_, along_); }
  /// The parameter at which the curve, continued at both ends, is nearest to its sites; `first` where there is no such.
  double waist() const { return waist_; }
  /// From one parameter to another, in this order, both between this curve's. `from` and `to`: its points there, but
  /// for rounding.
  AxisCurve part(double first, double last, Vec2 from, Vec2 to) const;
  double length() const;
  /// Appends the points after `from` up to `to` of a polyline along the curve. An arc's polyline is made of tangents,
  /// so it lies on the directrix's side, where the distance to the directrix is that to the nearest site: it comes no
  /// nearer to the sites than the arc does. Tangents are 1/32 radians apart at most: 1e-4 of the length more than the
  /// arc's.
  void append_polyline(std::vector<Vec2>& path) const;

 private:
  Vec2 origin_;           // of the parameter: `from`, or the focus' foot on the directrix
  Vec2 along_, upwards_;  // units; upwards_ only for arcs: from the directrix to the focus
  double focal_ = 0.0;    // distance of focus and directrix; 0: straight
  double first_ = 0.0, last_ = 0.0, waist_ = 0.0;
  Vec2 from_, to_;
};

/// A segment without its ends, or an end.
struct VoronoiSite {
  Segment shape;          ///< snapped; world units
  std::uint32_t segment;  ///< the number of an obstacle that it belongs to
};

/// A curve of the axis between two of its vertices.
struct AxisEdge {
  VertexId from, to;
  std::uint32_t site, other;  ///< what it lies between
  double length;              ///< along the curve
  double clearance;           ///< least distance of the curve to its two obstacles
};

/// Immutable after construction; any number of threads may read.
struct MedialAxis {
  /// Throws ObstacleClash where polygons overlap; InputError where the frame has no inside; Stopped at the deadline.
  /// There must be an obstacle or bounds.
  MedialAxis(const PlaneObstacles& plane, const Execution& execution);

  AxisCurve curve(const AxisEdge& edge) const {
    return {sites[edge.site].shape, sites[edge.other].shape, vertices[edge.from], vertices[edge.to]};
  }
  /// Least distance of the curve to the two obstacles that it lies between.
  double least_clearance(const AxisEdge& edge, const AxisCurve& curve) const;

  Box frame;                            ///< the bounds; without them, the obstacles' box
  std::vector<Segment> obstacles;       ///< walls, polygons' sides, and the frame's four sides
  std::size_t true_obstacle_count = 0;  ///< the first of them: bounds are obstacles, a mere box isn't
  std::vector<Vec2> vertices;           ///< of the diagram, in free space or not
  std::vector<VoronoiSite> sites;       ///< of each, its segment is one of the obstacles
  std::vector<AxisEdge> edges;          ///< in free space
  double resolution = 0.0;              ///< curves with less clearance are closed to everybody
};

}  // namespace warren
