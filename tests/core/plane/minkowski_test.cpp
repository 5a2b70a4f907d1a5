// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/convex_polygons.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"

namespace warren {
namespace {

std::vector<Vec2> star(std::uint64_t seed, std::uint64_t corners) {
  std::vector<Vec2> polygon;
  for (std::uint64_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    const double radius = 0.2 + 0.8 * uniform(seed, i, 0);
    polygon.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  if (seed % 2 == 0) return {polygon.rbegin(), polygon.rend()};
  return polygon;
}

double area(const std::vector<Vec2>& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += cross(p[i], p[(i + 1) % p.size()]);
  return 0.5 * sum;
}

bool is_convex(const std::vector<Vec2>& p) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (orient2d(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) <= 0) return false;
  }
  return true;
}

std::vector<Vec2> hull_of_sums(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  std::vector<Vec2> points;
  for (const Vec2 p : a) {
    for (const Vec2 q : b) points.push_back(p + q);
  }
  const auto less = [](Vec2 p, Vec2 q) { return p.x != q.x ? p.x < q.x : p.y < q.y; };
  std::sort(points.begin(), points.end(), less);
  std::vector<Vec2> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t base = hull.size();
    for (const Vec2 p : points) {
      while (hull.size() >= base + 2 && orient2d(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

TEST(ConvexPieces, AreConvexDisjointAndMakeUpThePolygon) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Vec2> polygon = star(seed, 3 + seed % 17);
    const auto pieces = convex_pieces(polygon);
    double sum = 0.0;
    for (const auto& piece : pieces) {
      EXPECT_TRUE(is_convex(piece));
      sum += area(piece);
    }
    EXPECT_NEAR(sum, std::abs(area(polygon)), 1e-12);
    for (std::uint64_t i = 0; i < 500; ++i) {
      const Vec2 p{2.0 * uniform(seed, i, 1) - 1.0, 2.0 * uniform(seed, i, 2) - 1.0};
      bool inside = false;
      for (const auto& piece : pieces) inside = inside || contains(piece, p);
      EXPECT_EQ(inside, contains(polygon, p)) << i;
    }
  }
}

/// Some points of a grid in their order around its middle: many lie on lines through others.
std::vector<Vec2> grid_star(std::uint64_t seed) {
  constexpr std::uint64_t side = 6;
  const Vec2 middle{2.503, 2.511};
  std::vector<Vec2> polygon;
  for (std::uint64_t i = 0; i < side * side; ++i) {
    if (uniform(seed, i, 0) < 0.5) polygon.push_back({static_cast<double>(i % side), static_cast<double>(i / side)});
  }
  const auto angle = [&](Vec2 p) { return std::atan2(p.y - middle.y, p.x - middle.x); };
  std::sort(polygon.begin(), polygon.end(), [&](Vec2 p, Vec2 q) { return angle(p) < angle(q); });
  return polygon;
}

TEST(ConvexPieces, MakeUpPolygonsWhoseCornersLieOnLinesThroughOthers) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Vec2> polygon = grid_star(seed);
    double sum = 0.0;
    for (const auto& piece : convex_pieces(polygon)) {
      EXPECT_TRUE(is_convex(piece));
      sum += area(piece);
    }
    EXPECT_DOUBLE_EQ(sum, area(polygon));
  }
}

TEST(ConvexPieces, LeaveConvexPolygonsWhole) {
  const std::vector<Vec2> hexagon = {{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}, {-1, 1}};
  EXPECT_EQ(convex_pieces(hexagon), std::vector<std::vector<Vec2>>{hexagon});
  const std::vector<Vec2> straight = {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}};
  ASSERT_EQ(convex_pieces(straight).size(), 1U);
  EXPECT_EQ(convex_pieces(straight).front().size(), 4U);
  const std::vector<Vec2> hook = {{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {0, 1}};
  EXPECT_EQ(convex_pieces(hook).size(), 2U);
}

TEST(MinkowskiSum, IsTheHullOfAllSums) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const auto a = convex_pieces(star(seed, 9)).front();
    const auto b = convex_pieces(star(seed + 100, 7)).front();
    const auto sum = minkowski_sum(a, b);
    const auto hull = hull_of_sums(a, b);
    EXPECT_NEAR(area(sum), area(hull), 1e-12);
    for (const Vec2 p : hull) EXPECT_LE(distance(sum, Segment{p, p}), 1e-12);
    for (const Vec2 p : sum) EXPECT_LE(distance(hull, Segment{p, p}), 1e-12);
  }
}

TEST(MinkowskiSum, TakesPointsSegmentsAndParallelSides) {
  const std::vector<Vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(minkowski_sum(square, std::vector<Vec2>{{2, 3}}), (std::vector<Vec2>{{2, 3}, {3, 3}, {3, 4}, {2, 4}}));
  EXPECT_EQ(minkowski_sum(square, square), (std::vector<Vec2>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  EXPECT_EQ(minkowski_sum(std::vector<Vec2>{{0, 0}, {3, 0}}, square),
            (std::vector<Vec2>{{0, 0}, {4, 0}, {4, 1}, {0, 1}}));
  EXPECT_DOUBLE_EQ(area(minkowski_sum(std::vector<Vec2>{{0, 0}, {1, 2}}, square)), 1.0 + 1.0 + 2.0);
}

TEST(PolygonAroundDisc, HoldsTheDisc) {
  const std::vector<Vec2> polygon = polygon_around_disc(2.0, 32);
  double least = 10.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    least = std::min(least, distance(Vec2{}, polygon_side(polygon, i)));
    EXPECT_LE(norm(polygon[i]), 2.0 * 1.005);
  }
  EXPECT_NEAR(least, 2.0, 1e-14);
}

}  // namespace
}  // namespace warren
