// SPDX-License-Identifier: BSD-3-Clause
// Convex polygons: Minkowski sums of them, {a + b}, and simple polygons cut into them. A body that does not turn meets
// an obstacle exactly when its reference point is in the sum of the obstacle and the body mirrored at that point; sums
// of polygons that aren't convex are the unions of the sums of their convex pieces.
#pragma once

#include <span>
#include <vector>

#include "core/base/types.hpp"

namespace warren {

/// The sides of both, merged by their directions: O(n + m). Corners are rounded to the next double, nothing else is.
/// Convex sets with one corner (a point), two (a segment) or more, counter-clockwise. The sum runs counter-clockwise
/// too, without corners on straight sides; it has three or more unless both lie on parallel lines.
std::vector<Vec2> minkowski_sum(std::span<const Vec2> a, std::span<const Vec2> b);

/// A regular polygon around the disc of this radius at the origin, whose sides touch it; counter-clockwise.
std::vector<Vec2> polygon_around_disc(double radius, std::size_t corners);

/// Clips ears, corners whose triangle is inside, off a simple polygon that runs counter-clockwise, and gives their
/// triangles in that order. What is left has three corners, or no ear: such corners lie in a row.
std::vector<std::vector<Vec2>> clip_ears(std::vector<Vec2>& ring, bool drops_straight_corners);

/// Ears are clipped (every decision by the exact orientation), then triangles are joined across diagonals wherever the
/// union stays convex (Hertel, Mehlhorn 1983: at most four times the fewest pieces). A convex polygon stays whole.
/// O(n^2) time for n corners, more only where few corners are ears. polygon: simple, three or more corners, either
/// orientation. The pieces run counter-clockwise, their corners are the polygon's (those on straight sides may be left
/// out), their interiors are disjoint and their union is the polygon.
std::vector<std::vector<Vec2>> convex_pieces(std::span<const Vec2> polygon);

}  // namespace warren
