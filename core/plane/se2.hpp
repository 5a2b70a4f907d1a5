// SPDX-License-Identifier: BSD-3-Clause
// Poses of a body in the plane: where its reference point is and how it is turned. Angles are radians and mean the same
// modulo a full turn; between two poses a body turns the shorter way.
#pragma once

#include <cmath>
#include <numbers>

#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"

namespace warren {

/// Beyond this, radians, rounding would leave too little of what a heading means modulo a full turn.
inline constexpr double largest_heading = 1000.0;

/// A pose: the body's point p is at (x, y) + p turned by theta, counter-clockwise.
struct Se2 {
  double x = 0.0;      ///< of the body's reference point
  double y = 0.0;      ///< of the same
  double theta = 0.0;  ///< radians, within +-largest_heading; turns modulo 2 pi

  /// Without the heading.
  constexpr Vec2 position() const { return {x, y}; }
  friend constexpr bool operator==(const Se2&, const Se2&) = default;
};

/// The angle from `from` to `to` the shorter way, in [-pi, pi]; exactly half a turn goes the way that the numbers go.
inline double turn_between(double from, double to) { return std::remainder(to - from, 2.0 * std::numbers::pi); }

/// The same angle in [-pi, pi].
inline double wrapped_angle(double theta) { return std::remainder(theta, 2.0 * std::numbers::pi); }

/// A rotation, its sine and cosine taken once.
class Rotation {
 public:
  /// By theta radians, counter-clockwise.
  explicit Rotation(double theta) : of_(portable::sin_and_cos(theta)) {}
  /// The point turned about the origin.
  Vec2 operator()(Vec2 p) const { return {of_.cosine * p.x - of_.sine * p.y, of_.sine * p.x + of_.cosine * p.y}; }

 private:
  portable::SineAndCosine of_;
};

/// The point of the body that is p where the body stands at the origin.
inline Vec2 placed(const Se2& pose, Vec2 p) { return pose.position() + Rotation(pose.theta)(p); }

/// The pose a share t of the way from a to b: straight on, turning evenly the shorter way. The ends are exact.
inline Se2 interpolate(const Se2& a, const Se2& b, double t) {
  if (t <= 0.0) return a;
  if (t >= 1.0) return b;
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), wrapped_angle(a.theta + t * turn_between(a.theta, b.theta))};
}

}  // namespace warren
