// SPDX-License-Identifier: BSD-3-Clause
// Points among polygons, against plain integer arithmetic: small grids, so that points on sides and corners, corners at
// equal heights, and shared sides are common.
#include "spatial/obstacles/polygon_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/rng.hpp"

namespace warren {
namespace {

using Whole = std::int64_t;
struct Point {
  Whole x, y;
};
Point whole(Vec2 p) { return {static_cast<Whole>(p.x), static_cast<Whole>(p.y)}; }
Whole turn(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

PolygonSide plain_side(std::span<const Vec2> corners, Vec2 at) {
  const Point p = whole(at);
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point a = whole(corners[i]);
    const Point b = whole(corners[(i + 1) % corners.size()]);
    const bool in_box = std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
                        p.y <= std::max(a.y, b.y);
    if (in_box && turn(a, b, p) == 0) return PolygonSide::on_outline;
    if ((a.y <= p.y) == (b.y <= p.y)) continue;
    if ((turn(a, b, p) > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside ? PolygonSide::inside : PolygonSide::outside;
}

/// A star around a grid point: angles ascend, so it is simple; some corners may repeat heights and widths.
std::vector<Vec2> star(std::uint64_t seed, std::uint64_t number, std::size_t n, double radius, Vec2 middle) {
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle =
        6.283185307 * (static_cast<double>(i) + 0.4 * uniform(seed, number, 2 * i)) / static_cast<double>(n);
    const double r = radius * (0.3 + 0.7 * uniform(seed, number, 2 * i + 1));
    corners.push_back({std::round(middle.x + r * std::cos(angle)), std::round(middle.y + r * std::sin(angle))});
  }
  if (number % 2 == 1) std::reverse(corners.begin(), corners.end());
  return corners;
}

TEST(PolygonIndex, KnowsSidesLikePlainIntegers) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    PolygonSet set;
    for (std::uint64_t k = 0; k < 12; ++k) {
      const Vec2 middle{std::floor(40 * uniform(seed, k, 1000)), std::floor(40 * uniform(seed, k, 1001))};
      set.add(star(seed, k, k == 0 ? 300 : 3 + k, k == 0 ? 60.0 : 9.0, middle));
    }
    const PolygonIndex index(set, {});
    for (double x = -20; x <= 60; x += 1) {
      for (double y = -20; y <= 60; y += 3) {
        bool inside_any = false;
        for (std::size_t k = 0; k < set.size(); ++k) {
          const PolygonSide plain = plain_side(set[k], {x, y});
          ASSERT_EQ(index.side_of(k, {x, y}), plain) << "polygon " << k << " at " << x << ' ' << y;
          inside_any = inside_any || plain == PolygonSide::inside;
        }
        const auto found = index.polygon_around({x, y});
        ASSERT_EQ(found.has_value(), inside_any) << x << ' ' << y;
        if (found) {
          ASSERT_EQ(plain_side(set[*found], {x, y}), PolygonSide::inside);
        }
      }
    }
  }
}

TEST(PolygonIndex, FindsEverySideNearABox) {
  PolygonSet set;
  for (std::uint64_t k = 0; k < 5; ++k) set.add(star(7, k, 5 + 70 * k, 40.0, {20.0 * static_cast<double>(k), 0.0}));
  const PolygonIndex index(set, {});
  for (std::uint64_t q = 0; q < 200; ++q) {
    const Vec2 low{140 * uniform(9, q, 0) - 40, 80 * uniform(9, q, 1) - 40};
    const Box box{low, low + Vec2{30 * uniform(9, q, 2), 30 * uniform(9, q, 3)}};
    for (std::size_t k = 0; k < set.size(); ++k) {
      std::vector<std::size_t> found;
      index.for_each_side_near(k, box, [&](std::size_t side) {
        found.push_back(side);
        return true;
      });
      std::vector<std::size_t> plain;
      for (std::size_t i = set.first[k]; i < set.first[k + 1]; ++i) {
        const std::size_t next = i + 1 < set.first[k + 1] ? i + 1 : set.first[k];
        if (box_of({set.corners[i], set.corners[next]}).meets(box)) plain.push_back(i);
      }
      ASSERT_EQ(found, plain);
    }
  }
}

TEST(PolygonIndex, AnEmptySetHoldsNothing) {
  EXPECT_FALSE(PolygonIndex(PolygonSet{}, {}).polygon_around({0, 0}));
  EXPECT_FALSE(PolygonIndex().polygon_around({0, 0}));
}

}  // namespace
}  // namespace warren
