// SPDX-License-Identifier: BSD-3-Clause
// What nearness costs along a straight stretch: the integral of (1 - d / reach)^2 where d < reach, d being the distance
// to the nearest of several things. Each of them is, by arc length, a side (its distance is a straight line) or a
// corner (a hyperbola). The stretch is cut where any two are equally far, and where one is at the reach; in each
// interval the one that is least in its middle counts. That decides no ties: where two are equal they give the same
// integral.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "core/base/types.hpp"

namespace warren {

/// The distance to one thing, where the stretch has gone `t` from its begin.
struct StretchDistance {
  bool is_side = true;    ///< which of the pairs below means something
  double at_begin = 0.0;  ///< side: distance at t = 0
  double slope = 0.0;     ///< side: what it grows by, -1 .. 1; the distance is never below 0 on the stretch
  double foot = 0.0;      ///< corner: t where it is nearest
  double apart_sq = 0.0;  ///< corner: its squared distance there

  /// The corner `c` as seen from a stretch that begins at `a` in the direction `u` of length 1.
  static StretchDistance corner(Vec2 c, Vec2 a, Vec2 u) {
    const double apart = cross(u, c - a);
    return {false, 0.0, 0.0, dot(u, c - a), apart * apart};
  }
  /// A side whose distance is so much at the begin and grows so.
  static StretchDistance side(double at_begin, double slope) { return {true, at_begin, slope, 0.0, 0.0}; }

  double operator()(double t) const {
    return is_side ? at_begin + slope * t : std::sqrt((t - foot) * (t - foot) + apart_sq);
  }
};

/// Sums such integrals; keeps its scratch, so one a thread.
class NearnessSum {
 public:
  /// Over the stretch from t = `from` to `to`; reach > 0. Of nothing: 0. Off by some 1e-15 * (1 + to - from).
  double integral(std::span<const StretchDistance> things, double from, double to, double reach);

 private:
  std::vector<StretchDistance> near_;
  std::vector<double> cuts_;
};

}  // namespace warren
