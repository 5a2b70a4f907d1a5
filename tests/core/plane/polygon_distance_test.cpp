// SPDX-License-Identifier: BSD-3-Clause
#include "core/plane/polygon.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

const std::vector<Vec2> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
const std::vector<Vec2> hook = {{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {0, 1}};

TEST(PolygonDistance, IsThatOfTheNearestFeatures) {
  const std::vector<Vec2> right = {{5, 0}, {6, 1}, {5, 2}};
  EXPECT_DOUBLE_EQ(distance(square, right), 3.0);
  EXPECT_DOUBLE_EQ(distance(right, square), 3.0);
  const std::vector<Vec2> corner = {{3, 3}, {4, 3}, {4, 4}};
  EXPECT_DOUBLE_EQ(distance(square, corner), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(distance(square, Segment{{-1, 3}, {5, 3}}), 1.0);
}

TEST(PolygonDistance, IsZeroWhereTheyTouchOverlapOrHoldEachOther) {
  EXPECT_EQ(distance(square, std::vector<Vec2>{{2, 2}, {3, 2}, {3, 3}}), 0.0);
  EXPECT_EQ(distance(square, std::vector<Vec2>{{1, 1}, {3, 1}, {3, 3}}), 0.0);
  EXPECT_EQ(distance(square, std::vector<Vec2>{{0.5, 0.5}, {1, 0.5}, {1, 1}}), 0.0);
  EXPECT_EQ(distance(std::vector<Vec2>{{0.5, 0.5}, {1, 0.5}, {1, 1}}, square), 0.0);
  EXPECT_EQ(distance(square, Segment{{0.5, 0.5}, {1, 1}}), 0.0);
}

TEST(PolygonDistance, OfASegmentIsThatOfTheNearestSide) {
  EXPECT_DOUBLE_EQ(distance(square, Segment{{0.5, -3}, {1.5, -1}}), 1.0);
  EXPECT_DOUBLE_EQ(distance(square, Segment{{5, 0.5}, {3, 1.5}}), 1.0);
  EXPECT_DOUBLE_EQ(distance(square, Segment{{0.5, 3}, {1.5, 5}}), 1.0);
  EXPECT_DOUBLE_EQ(distance(square, Segment{{-1, 0.5}, {-3, 1.5}}), 1.0);  // the side back to the first corner
}

TEST(PolygonDistance, KnowsTheInsideOfAHookFromItsBay) {
  EXPECT_TRUE(contains(hook, {3.5, 2}));
  EXPECT_FALSE(contains(hook, {1, 2}));
  EXPECT_TRUE(contains(hook, {3, 2}));
  EXPECT_DOUBLE_EQ(distance(hook, std::vector<Vec2>{{1, 2}, {2, 2}, {2, 2.5}}), 1.0);
}

/// No pair of points is nearer than the distance, and some pair of sampled boundary points is hardly farther.
TEST(PolygonDistance, BoundsTheDistanceOfSampledPoints) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const auto triangle = [&](std::uint64_t index, double shift) {
      std::vector<Vec2> corners;
      for (std::uint64_t i = 0; i < 3; ++i) {
        corners.push_back({shift + uniform(seed, index, 2 * i), uniform(seed, index, 2 * i + 1)});
      }
      return corners;
    };
    const std::vector<Vec2> a = triangle(0, 0.0);
    const std::vector<Vec2> b = triangle(1, 1.2);
    const double d = distance(a, b);
    double least = 10.0;
    constexpr int pieces = 60;
    const auto boundary_point = [](const std::vector<Vec2>& polygon, int i) {
      const Segment side = polygon_side(polygon, static_cast<std::size_t>(i / pieces));
      return side.a + (static_cast<double>(i % pieces) / pieces) * (side.b - side.a);
    };
    for (int i = 0; i < 3 * pieces; ++i) {
      for (int j = 0; j < 3 * pieces; ++j) {
        least = std::min(least, distance(boundary_point(a, i), boundary_point(b, j)));
      }
    }
    EXPECT_GE(least, d - 1e-12);
    EXPECT_LE(least, d + 2.0 * 1.5 / pieces);
  }
}

}  // namespace
}  // namespace warren
