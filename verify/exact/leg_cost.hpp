// SPDX-License-Identifier: BSD-3-Clause
// The verification's own integral of what nearness costs along a straight piece. The squared distance to each thing is
// a quadratic of the arc length; where any two of them cross, and where one is at the reach, the piece is cut, and in
// each interval the one that is least in its middle counts.
#pragma once

#include <span>
#include <vector>

#include "core/base/types.hpp"

namespace warren::exact {

/// a t^2 + b t + c, the squared distance where the piece has gone t from its begin; never below 0.
struct SquaredDistance {
  double a;
  double b;
  double c;
  double apart_sq;       ///< of a place: of the line that the piece is on
  bool is_line = false;  ///< is the distance itself a straight line, off - slope t?
  double off = 0.0;
  double slope = 0.0;

  /// To a place that lies so far off the piece's begin; u: the piece's direction, of length 1.
  static SquaredDistance to_place(Vec2 off, Vec2 u) {
    const double apart = cross(u, off);
    return {1.0, -2.0 * dot(off, u), dot(off, off), apart * apart};
  }
  /// To a straight line that is so far off at the begin, and nears by so much.
  static SquaredDistance to_line(double off, double slope) {
    return {slope * slope, -2.0 * off * slope, off * off, 0.0, true, off, slope};
  }
  double at(double t) const { return (a * t + b) * t + c; }
};

/// The integral of (1 - d / reach)^2, where the least distance d is below the reach, over t = 0 .. length. Scratch of
/// one thread.
class NearnessCost {
 public:
  double over(std::span<const SquaredDistance> things, double length, double reach);

 private:
  std::vector<SquaredDistance> near_;
  std::vector<double> cuts_;
};

}  // namespace warren::exact
