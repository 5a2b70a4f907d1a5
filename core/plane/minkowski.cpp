// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/minkowski.hpp"

#include <cmath>
#include <numbers>

#include "core/base/trigonometry.hpp"
#include "core/plane/geometry.hpp"

namespace warren {
namespace {

std::size_t lowest(std::span<const Vec2> p) {
  std::size_t low = 0;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p[i].y < p[low].y || (p[i].y == p[low].y && p[i].x < p[low].x)) low = i;
  }
  return low;
}

/// The directions of the sides from the lowest corner on: their angles ascend from 0 to below a full turn.
std::vector<Vec2> sides_from_lowest(std::span<const Vec2> p) {
  std::vector<Vec2> sides;
  if (p.size() < 2) return sides;
  const std::size_t low = lowest(p);
  for (std::size_t i = 0; i < p.size(); ++i) {
    sides.push_back(p[(low + i + 1) % p.size()] - p[(low + i) % p.size()]);
  }
  return sides;
}

/// Is the angle of a, in [0, 2 pi), smaller than b's?
bool before(Vec2 a, Vec2 b) {
  const auto upper = [](Vec2 v) { return v.y > 0.0 || (v.y == 0.0 && v.x > 0.0); };
  if (upper(a) != upper(b)) return upper(a);
  return orient2d({}, a, b) > 0;
}

}  // namespace

std::vector<Vec2> minkowski_sum(std::span<const Vec2> a, std::span<const Vec2> b) {
  const std::vector<Vec2> of_a = sides_from_lowest(a);
  const std::vector<Vec2> of_b = sides_from_lowest(b);
  const std::size_t low_a = lowest(a);
  const std::size_t low_b = lowest(b);
  // Each corner is a corner of a and one of b: no sums of sums, so rounding doesn't add up.
  std::vector<Vec2> sum;
  std::size_t i = 0;
  std::size_t j = 0;
  const auto corner = [&] { return a[(low_a + i) % a.size()] + b[(low_b + j) % b.size()]; };
  do {
    const Vec2 p = corner();
    if (sum.empty() || !(sum.back() == p)) sum.push_back(p);
    const bool a_first = j == of_b.size() || (i < of_a.size() && !before(of_b[j], of_a[i]));
    const bool b_first = i == of_a.size() || (j < of_b.size() && !before(of_a[i], of_b[j]));
    if (a_first && i < of_a.size()) ++i;
    if (b_first && j < of_b.size()) ++j;
  } while (i < of_a.size() || j < of_b.size());
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

}  // namespace warren
