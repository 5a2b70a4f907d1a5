// SPDX-License-Identifier: BSD-3-Clause
// The distance of a circular arc from a segment, in closed form: what the verification of cars is made of. Where a body
// turns about a point, its corners follow arcs, and in the body's eyes so do the corners of what stands around.
#pragma once

#include "core/base/types.hpp"

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
