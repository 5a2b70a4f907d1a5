// SPDX-License-Identifier: BSD-3-Clause
// The verification's own geometry: it shares nothing with core/plane/geometry, so that a mistake there can't confirm
// itself. A double evaluation with an error bound answers first; what it leaves open is decided without rounding, with
// Boost.Multiprecision's whole numbers. Exact for coordinates within core/base/types.hpp's limits.
//
// The distance of a circular arc from a segment is in closed form: what the verification of cars is made of. Where a
// body turns about a point, its corners follow arcs, and in the body's eyes so do the corners of what stands around.
#pragma once

#include <algorithm>
#include <span>

#include "core/base/types.hpp"

namespace warren::exact {

/// The side of an outline that begins at corner i.
inline Segment outline_side(std::span<const Vec2> corners, std::size_t i) {
  return {corners[i], corners[i + 1 == corners.size() ? 0 : i + 1]};
}

/// +1 when c lies left of the line a -> b, -1 right of it, 0 on it.
int side_of(Vec2 a, Vec2 b, Vec2 c) noexcept;

/// Does p lie on the closed segment?
bool contains(const Segment& s, Vec2 p) noexcept;

/// Do the closed segments share a point?
bool touch(const Segment& s, const Segment& t) noexcept;

/// Do they cross in one point that is no end of either?
bool cross_inside(const Segment& s, const Segment& t) noexcept;

/// Is some point of s nearer than r (> 0) to some point of t?
bool closer_than(const Segment& s, const Segment& t, double r) noexcept;

/// The least part of a distance by which distance() may be off, and more.
inline constexpr double distance_error = 1e-8;

/// Distance of the closed segments, 0 where they touch, else above 0. Its error is below 1e-14 of the coordinate
/// differences and below distance_error of itself, and it is never below the distance of the segments' boxes: so
/// whatever leaves out pairs by boxes, or by that much more than a distance that it has, misses no lesser one, and a
/// least distance is the same bits in whatever order and with whatever index it is found.
double distance(const Segment& s, const Segment& t) noexcept;

/// Square of the distance of two boxes.
inline double gap_sq(const Box& a, const Box& b) noexcept {
  const double dx = std::max(std::max(0.0, a.min.x - b.max.x), b.min.x - a.max.x);
  const double dy = std::max(std::max(0.0, a.min.y - b.max.y), b.min.y - a.max.y);
  return dx * dx + dy * dy;
}

}  // namespace warren::exact

namespace warren {

/// From `from`, around `center`, by `turn` radians (anticlockwise, at most a half turn either way).
struct Arc {
  Vec2 center;
  Vec2 from;
  double turn = 0.0;

  Vec2 at(double angle) const;  ///< the point after so much of the turn
};

/// 0 where they touch; error below 1e-14 of radius and coordinate differences.
double distance(const Arc& arc, const Segment& s) noexcept;

}  // namespace warren
