// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/convex_polygons.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <utility>

#include "core/base/trigonometry.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"

namespace warren {
namespace {

using Ring = std::vector<Vec2>;  // counter-clockwise

/// The corners from the lowest one on, the leftmost of these, and, of two or more, this one again behind the last: the
/// angles of the sides ascend from 0 to below a full turn.
Ring closed_from_lowest(std::span<const Vec2> p) {
  Ring ring(p.begin(), p.end());
  const auto lowest = std::ranges::min_element(ring, {}, [](Vec2 v) { return std::pair(v.y, v.x); });
  std::rotate(ring.begin(), lowest, ring.end());
  if (ring.size() > 1) ring.push_back(ring.front());
  return ring;
}

/// Is the angle of a, in [0, 2 pi), smaller than b's?
bool before(Vec2 a, Vec2 b) {
  const auto upper = [](Vec2 v) { return v.y > 0.0 || (v.y == 0.0 && v.x > 0.0); };
  if (upper(a) != upper(b)) return upper(a);
  return orient2d({}, a, b) > 0;
}

Vec2 at(const Ring& ring, std::size_t i) { return ring[i % ring.size()]; }

void drop_straight_corners(Ring& ring) {
  for (std::size_t i = 0; i < ring.size() && ring.size() > 3;) {
    if (orient2d(at(ring, i + ring.size() - 1), ring[i], at(ring, i + 1)) == 0) {
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
      i = i == 0 ? 0 : i - 1;
    } else {
      ++i;
    }
  }
}

bool is_convex(const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (orient2d(ring[i], at(ring, i + 1), at(ring, i + 2)) <= 0) return false;
  }
  return true;
}

bool is_ear(const Ring& ring, std::size_t i) {
  const Vec2 a = at(ring, i + ring.size() - 1);
  const Vec2 b = ring[i];
  const Vec2 c = at(ring, i + 1);
  if (orient2d(a, b, c) <= 0) return false;
  return std::none_of(ring.begin(), ring.end(), [&](Vec2 p) {
    return !(p == a) && !(p == b) && !(p == c) && orient2d(a, b, p) >= 0 && orient2d(b, c, p) >= 0 &&
           orient2d(c, a, p) >= 0;
  });
}

/// The two rings as one along their common side, or nothing where they have none or the union isn't convex.
Ring joined(const Ring& a, const Ring& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (!(a[i] == at(b, j + 1)) || !(at(a, i + 1) == b[j])) continue;
      Ring ring;
      for (std::size_t k = 0; k < a.size(); ++k) ring.push_back(at(a, i + 1 + k));
      for (std::size_t k = 2; k < b.size(); ++k) ring.push_back(at(b, j + k));
      drop_straight_corners(ring);
      if (is_convex(ring)) return ring;
    }
  }
  return {};
}

void join_pieces(std::vector<Ring>& rings) {
  for (std::size_t i = 0; i < rings.size(); ++i) {
    for (std::size_t j = i + 1; j < rings.size();) {
      Ring ring = joined(rings[i], rings[j]);
      if (ring.empty()) {
        ++j;
        continue;
      }
      rings[i] = std::move(ring);
      rings.erase(rings.begin() + static_cast<std::ptrdiff_t>(j));
      j = i + 1;
    }
  }
}

}  // namespace

std::vector<Vec2> minkowski_sum(std::span<const Vec2> a, std::span<const Vec2> b) {
  const Ring of_a = closed_from_lowest(a);
  const Ring of_b = closed_from_lowest(b);
  const auto side = [](const Ring& ring, std::size_t corner) { return ring[corner + 1] - ring[corner]; };
  // Each corner is a corner of a and one of b: no sums of sums, so rounding doesn't add up.
  std::vector<Vec2> sum;
  std::size_t i = 0;
  std::size_t j = 0;
  do {
    const Vec2 p = of_a[i] + of_b[j];
    if (sum.empty() || !(sum.back() == p)) sum.push_back(p);
    const bool a_ends = i + 1 == of_a.size();
    const bool b_ends = j + 1 == of_b.size();
    const bool a_first = b_ends || (!a_ends && !before(side(of_b, j), side(of_a, i)));
    const bool b_first = a_ends || (!b_ends && !before(side(of_a, i), side(of_b, j)));
    if (a_first && !a_ends) ++i;
    if (b_first && !b_ends) ++j;
  } while (i + 1 < of_a.size() || j + 1 < of_b.size());
  while (sum.size() > 1 && sum.front() == sum.back()) sum.pop_back();
  return sum;
}

std::vector<Vec2> polygon_around_disc(double radius, std::size_t corners) {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(corners);
  const double reach = radius / portable::cos(0.5 * step);
  std::vector<Vec2> polygon;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = (static_cast<double>(i) + 0.5) * step;
    const auto [sine, cosine] = portable::sin_and_cos(angle);
    polygon.push_back({reach * cosine, reach * sine});
  }
  return polygon;
}

std::vector<std::vector<Vec2>> clip_ears(std::vector<Vec2>& ring, bool drops_straight_corners) {
  std::vector<Ring> ears;
  while (ring.size() > 3) {
    std::size_t ear = 0;
    while (ear < ring.size() && !is_ear(ring, ear)) ++ear;
    if (ear == ring.size()) break;
    ears.push_back({at(ring, ear + ring.size() - 1), ring[ear], at(ring, ear + 1)});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
    if (drops_straight_corners) drop_straight_corners(ring);
  }
  return ears;
}

std::vector<std::vector<Vec2>> convex_pieces(std::span<const Vec2> polygon) {
  Ring ring(polygon.begin(), polygon.end());
  if (runs_clockwise(ring)) std::reverse(ring.begin(), ring.end());
  drop_straight_corners(ring);
  if (is_convex(ring)) return {ring};
  std::vector<Ring> pieces = clip_ears(ring, true);
  if (orient2d(ring[0], ring[1], ring[2]) > 0) pieces.push_back(ring);
  join_pieces(pieces);
  return pieces;
}

}  // namespace warren
