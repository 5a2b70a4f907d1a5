// SPDX-License-Identifier: BSD-3-Clause
// Distances in space between a straight segment, the spine of a capsule, and a point, a box, another segment: exact up
// to rounding, without iteration. A capsule of radius r keeps d from something when its spine keeps d + r.
#pragma once

#include <algorithm>
#include <cmath>

#include "scenes/scene/scene.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {

/// From a over the whole of `way`; may have length zero.
struct Spine {
  Vec3 a;
  Vec3 way;
  double inverse_square;  ///< of its length; 0 where that is too short to divide by

  Spine(const Vec3& from, const Vec3& to) : a(from), way(to - from) {
    constexpr double shortest_square = 1e-200;
    const double square = way.squaredNorm();
    inverse_square = square > shortest_square ? 1.0 / square : 0.0;
  }
  Vec3 nearest(const Vec3& p) const { return a + std::clamp((p - a).dot(way) * inverse_square, 0.0, 1.0) * way; }
};

/// Square of the distance from a point.
inline double distance_square(const Spine& spine, const Vec3& p) {
  const Vec3 to = p - spine.a;
  const double t = std::clamp(to.dot(spine.way) * spine.inverse_square, 0.0, 1.0);
  return (to - t * spine.way).squaredNorm();
}

/// From a closed box with faces square to the axes; 0 where they meet. The square is convex and piecewise quadratic
/// along the segment, with its breaks where a coordinate passes a face: the piece in which its slope turns is solved.
double distance_square(const Spine& spine, const SolidBox& box);

/// From another segment; 0 where they cross.
double distance_square(const Spine& s, const Spine& t);

}  // namespace warren
