// SPDX-License-Identifier: BSD-3-Clause
// Nearest points are ends of one or the other, or lie on a line through the centre that is square to the segment; or
// they are one point.
#include "verify/exact/arc_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/trigonometry.hpp"
#include "verify/exact/exact_segments.hpp"

namespace warren {
namespace {

/// Does the arc have a point in this direction from its centre?
bool sweeps(const Arc& arc, Vec2 direction) {
  const Vec2 first = arc.from - arc.center;
  double angle =
      portable::atan2(first.x * direction.y - first.y * direction.x, first.x * direction.x + first.y * direction.y);
  if (arc.turn < 0.0) angle = -angle;
  if (angle < 0.0) angle += 2.0 * std::numbers::pi;
  return angle <= std::abs(arc.turn);
}

/// Does the segment cross the arc?
bool crosses(const Arc& arc, const Segment& s, Vec2 along, double foot, double height_sq, double radius_sq) {
  if (height_sq > radius_sq) return false;
  const double half = std::sqrt((radius_sq - height_sq) / (along.x * along.x + along.y * along.y));
  for (const double t : {foot - half, foot + half}) {
    if (t >= 0.0 && t <= 1.0 && sweeps(arc, s.a + t * along - arc.center)) return true;
  }
  return false;
}

}  // namespace

Vec2 Arc::at(double angle) const {
  const auto [s, c] = portable::sin_and_cos(angle);
  const Vec2 v = from - center;
  return center + Vec2{c * v.x - s * v.y, s * v.x + c * v.y};
}

double distance(const Arc& arc, const Segment& s) noexcept {
  const Vec2 last = arc.at(arc.turn);
  double least = std::min(exact::distance({arc.from, arc.from}, s), exact::distance({last, last}, s));
  const double radius = portable::hypot(arc.from.x - arc.center.x, arc.from.y - arc.center.y);
  for (const Vec2 end : {s.a, s.b}) {
    const Vec2 off = end - arc.center;
    if (sweeps(arc, off)) least = std::min(least, std::abs(portable::hypot(off.x, off.y) - radius));
  }
  const Vec2 along = s.b - s.a;
  const double square = along.x * along.x + along.y * along.y;
  if (!(square > 0.0)) return least;
  const Vec2 to_center = arc.center - s.a;
  const double foot = (to_center.x * along.x + to_center.y * along.y) / square;
  const double area = along.x * to_center.y - along.y * to_center.x;
  const double height = std::abs(area) / std::sqrt(square);
  if (crosses(arc, s, along, foot, height * height, radius * radius)) return 0.0;
  if (foot > 0.0 && foot < 1.0 && height >= radius && sweeps(arc, s.a + foot * along - arc.center)) {
    least = std::min(least, height - radius);
  }
  return least;
}

}  // namespace warren
