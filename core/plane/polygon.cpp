// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/polygon.hpp"

#include <limits>

#include "core/plane/geometry.hpp"

namespace warren {
namespace {

enum class Place { outside, on_a_side, inside };

Place place_of(std::span<const Vec2> polygon, Vec2 p) noexcept {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Segment side = polygon_side(polygon, i);
    if (on_segment(p, side)) return Place::on_a_side;
    // A half-open rule: a side counts where it crosses the height of p going right of it, shared corners once.
    if ((side.a.y <= p.y) == (side.b.y <= p.y)) continue;
    const int left = orient2d(side.a, side.b, p);
    if (side.b.y > side.a.y ? left > 0 : left < 0) inside = !inside;
  }
  return inside ? Place::inside : Place::outside;
}

}  // namespace

/// Asked at the leftmost corner, the lowest of these: there it is convex.
bool runs_clockwise(std::span<const Vec2> outline) noexcept {
  const std::size_t n = outline.size();
  std::size_t at = 0;
  for (std::size_t i = 1; i < n; ++i) {
    if (is_before(outline[i], outline[at])) at = i;
  }
  std::size_t next = 1;
  while (next < n && outline[(at + next) % n] == outline[at]) ++next;
  std::size_t last = 1;
  while (last < n && outline[(at + n - last) % n] == outline[at]) ++last;
  return orient2d(outline[(at + n - last) % n], outline[at], outline[(at + next) % n]) < 0;
}

bool contains(std::span<const Vec2> polygon, Vec2 p) noexcept { return place_of(polygon, p) != Place::outside; }

bool strictly_inside(std::span<const Vec2> polygon, Vec2 p) noexcept { return place_of(polygon, p) == Place::inside; }

bool strictly_inside(const PolygonSet& polygons, Vec2 p) noexcept {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (strictly_inside(polygons[i], p)) return true;
  }
  return false;
}

double distance(std::span<const Vec2> polygon, const Segment& s) noexcept {
  if (contains(polygon, s.a)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size() && least > 0.0; ++i) {
    least = std::min(least, distance(polygon_side(polygon, i), s));
  }
  return least;
}

double distance(std::span<const Vec2> a, std::span<const Vec2> b) noexcept {
  if (contains(a, b.front()) || contains(b, a.front())) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size() && least > 0.0; ++j) {
      least = std::min(least, distance(polygon_side(a, i), polygon_side(b, j)));
    }
  }
  return least;
}

}  // namespace warren
