// SPDX-License-Identifier: BSD-3-Clause
// Minkowski sums of convex sets: {a + b}. The sides of both, merged by their directions: O(n + m) for n and m corners.
// A body that does not turn meets an obstacle exactly when its reference point is in the sum of the obstacle and the
// body mirrored at that point; sums of polygons that aren't convex are the unions of the sums of their convex pieces.
// Corners are rounded to the next double, nothing else is.
#pragma once

#include <span>
#include <vector>

#include "core/base/types.hpp"

namespace warren {

/// Convex sets with one corner (a point), two (a segment) or more, counter-clockwise. The sum runs counter-clockwise
/// too, without corners on straight sides; it has three or more unless both lie on parallel lines.
std::vector<Vec2> minkowski_sum(std::span<const Vec2> a, std::span<const Vec2> b);

/// A regular polygon around the disc of this radius at the origin, whose sides touch it; counter-clockwise.
std::vector<Vec2> polygon_around_disc(double radius, std::size_t corners);

}  // namespace warren
