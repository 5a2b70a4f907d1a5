// SPDX-License-Identifier: BSD-3-Clause
// Distances of closed polygons, convex or not, either orientation: every pair of sides, decided by the exact predicates
// of core/plane/geometry. Exactly 0 where they touch, overlap or one lies in the other; else within 1e-14 of the
// coordinate differences. O(n m): the plain form; worlds/poses/obstacle_tree is the fast one.
#pragma once

#include <cstddef>
#include <span>

#include "core/base/types.hpp"

namespace warren {

/// The side of a polygon from corner i to the next one.
inline Segment polygon_side(std::span<const Vec2> polygon, std::size_t i) {
  return {polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1]};
}

/// Is p in the closed polygon? Exact.
bool contains(std::span<const Vec2> polygon, Vec2 p) noexcept;
/// Is p in the polygon and on no side of it? Exact.
bool strictly_inside(std::span<const Vec2> polygon, Vec2 p) noexcept;

double distance(std::span<const Vec2> polygon, const Segment& s) noexcept;
double distance(std::span<const Vec2> a, std::span<const Vec2> b) noexcept;

}  // namespace warren
