// SPDX-License-Identifier: BSD-3-Clause
// The only predicates. Orientation is exact: a filtered double evaluation, decided by exact expansion arithmetic when
// the filter is in doubt (Shewchuk, Discrete & Computational Geometry 18, 1997). Everything that decides "touches" or
// "crosses" is made of it alone, so it is exact for all coordinates with smallest_coordinate <= |c| <=
// largest_coordinate or c = 0. Distances are plain doubles, relative error below 1e-14 of the coordinate differences.
#pragma once

#include <array>

#include "core/base/types.hpp"

namespace warren {

/// Sign of the doubled area of a, b, c: +1 when c lies left of the line a -> b, -1 right, 0 on it. Exact.
int orient2d(Vec2 a, Vec2 b, Vec2 c) noexcept;

/// By x, then by y.
constexpr bool is_before(Vec2 p, Vec2 q) noexcept { return p.x < q.x || (p.x == q.x && p.y < q.y); }

/// Both ends of a segment, whichever is its first: the one that is_before() the other comes first.
constexpr std::array<double, 4> ordered_ends(Vec2 a, Vec2 b) noexcept {
  return is_before(b, a) ? std::array{b.x, b.y, a.x, a.y} : std::array{a.x, a.y, b.x, b.y};
}

/// Does p lie on the closed segment? Exact.
bool on_segment(Vec2 p, const Segment& s) noexcept;

/// Do the closed segments share a point (ends, collinear overlap and points included)? Exact.
bool segments_touch(const Segment& s, const Segment& t) noexcept;

/// Do the open segments cross in one inner point of both? Exact.
bool segments_cross(const Segment& s, const Segment& t) noexcept;

/// The point of the closed segment that is nearest to p.
Vec2 nearest_point(Vec2 p, const Segment& s) noexcept;

double distance_sq(Vec2 p, const Segment& s) noexcept;
double distance(Vec2 p, const Segment& s) noexcept;

/// Distance between closed segments; exactly 0 where they touch.
double distance(const Segment& s, const Segment& t) noexcept;

}  // namespace warren
