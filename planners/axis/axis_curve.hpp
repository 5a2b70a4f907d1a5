// SPDX-License-Identifier: BSD-3-Clause
// A piece of a medial axis: the points with the same distance to two sites, each a point or a segment. Straight between
// two points or two segments; between a point and a segment an arc of the parabola with that focus and directrix. Arcs
// are kept as arcs: place, length and narrowest point are closed formulas of the parameter, which is the coordinate
// along the line or along the directrix. Rounding aside, all is exact. Every operation is O(1), polylines O(points).
#pragma once

#include <vector>

#include "core/base/types.hpp"

namespace warren {

/// A point (a == b) or an open segment, whose ends are sites of their own.
struct AxisSite {
  Vec2 a, b;
  bool is_point() const { return a == b; }
};

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

}  // namespace warren
