// SPDX-License-Identifier: BSD-3-Clause
// How far two convex solids are apart, as the judge of arms measures it: between a plane that parts them and two of
// their points. Whatever finds the plane, what is said of it comes from supports alone, the farthest that a solid goes
// in a direction: were the search wrong, the bounds would be wide, never false.
//
// A solid is a core and a radius around it: a ball's core is a point, a capsule's a segment. From points and segments
// to boxes, cylinders and segments the way is written out; for all else Wolfe's algorithm looks for the point nearest
// to 0 in the difference of the cores (P. Wolfe, Finding the nearest point in a polytope, 1976): a corral of at most
// four differences of corners, whose plane is moved until no corner lies beyond it. Some supports of either solid, each
// one look at all corners of a hull.
#pragma once

#include <array>
#include <vector>

#include "scenes/scene/scene.hpp"

namespace warren {

/// A rigid frame: its axes and its origin.
struct SolidFrame {
  std::array<Vec3, 3> axes{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  Vec3 at = Vec3::Zero();

  Vec3 turned(const Vec3& v) const { return v.x() * axes[0] + v.y() * axes[1] + v.z() * axes[2]; }
  Vec3 point(const Vec3& p) const { return at + turned(p); }
  Vec3 seen(const Vec3& v) const { return {axes[0].dot(v), axes[1].dot(v), axes[2].dot(v)}; }
  /// Of a frame that is given in this one.
  SolidFrame frame(const SolidFrame& inner) const {
    return {{turned(inner.axes[0]), turned(inner.axes[1]), turned(inner.axes[2])}, point(inner.at)};
  }
};

/// What a solid is made of, in its own frame, whose origin is its middle. A ball is a sphere with half = 0.
struct SolidCore {
  SolidKind kind = SolidKind::sphere;
  Vec3 half = Vec3::Zero();        ///< as Solid::half, without the radius of spheres and capsules
  double radius = 0.0;             ///< around the core
  double far = 0.0;                ///< no point of the core is farther from its middle
  std::vector<Vec3> corners = {};  ///< of hulls

  Vec3 support(const Vec3& direction) const;  ///< a point that goes farthest
};

/// The solid's core; its frame is moved to its middle.
SolidCore core_of(const Solid& solid, SolidFrame& frame);

/// A core where it is.
struct PlacedCore {
  const SolidCore& core;
  const SolidFrame& frame;

  /// How far the core goes in a direction of any length.
  double reach(const Vec3& direction) const;
};

/// Between cores: their radii are not taken off.
struct SolidGap {
  double least = 0.0;           ///< not less than 0
  double most = 0.0;            ///< the distance is between the two, but for rounding
  Vec3 towards = Vec3::Zero();  ///< of length 1, from the first to the second: square to the plane that says `least`
};

/// Measured until the bounds are no more than `close` apart, or `least` is `enough`, or more can't be told.
SolidGap gap_between(const PlacedCore& a, const PlacedCore& b, double close, double enough);

}  // namespace warren
