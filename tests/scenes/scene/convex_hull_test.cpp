// SPDX-License-Identifier: BSD-3-Clause
// What a hull promises is asked of all points and all faces, by planes of its own.
#include "scenes/scene/convex_hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

constexpr std::array<double, 2> ends{-1.0, 1.0};

/// From -half to half.
struct Draws {
  SequentialRng rng;
  double operator()(double half) { return half * (static_cast<double>(rng.next() >> 11U) * 0x1.0p-52 - 1.0); }
};

std::vector<Vec3> cube(double half, const Vec3& middle = Vec3::Zero()) {
  std::vector<Vec3> points;
  for (const double x : ends)
    for (const double y : ends)
      for (const double z : ends) points.emplace_back(middle + half * Vec3(x, y, z));
  return points;
}

/// Closed, convex, and around all points.
void expect_hull_of(const Solid& hull, const std::vector<Vec3>& points, double size) {
  ASSERT_EQ(hull.kind, SolidKind::hull);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& [a, b, c] : hull.faces) {
    for (const auto& side : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) ++sides[side];
    const Vec3 normal = (hull.corners[b] - hull.corners[a]).cross(hull.corners[c] - hull.corners[a]).normalized();
    for (const Vec3& p : points) ASSERT_LE(normal.dot(p - hull.corners[a]), 1e-9 * size);
  }
  for (const auto& [side, count] : sides) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(sides.contains({side.second, side.first}));
  }
  for (const Vec3& corner : hull.corners) ASSERT_NE(std::find(points.begin(), points.end(), corner), points.end());
}

TEST(ConvexHull, OfACubeFullOfPointsIsItsCorners) {
  std::vector<Vec3> points = cube(0.5);
  Draws draw{SequentialRng(1)};
  for (int i = 0; i < 500; ++i) points.emplace_back(draw(0.5), draw(0.5), draw(0.5));
  for (int i = 0; i < 100; ++i) points.emplace_back(draw(0.5), draw(0.5), 0.5);
  points.insert(points.end(), points.begin(), points.begin() + 8);
  const Solid hull = convex_hull(points, "cube", {});
  EXPECT_EQ(hull.corners.size(), 8U);
  EXPECT_EQ(hull.faces.size(), 12U);
  expect_hull_of(hull, points, 1.0);
  EXPECT_NEAR(volume_inside(hull.corners, hull.faces), 1.0, 1e-15);
}

TEST(ConvexHull, HoldsItsPointsWhateverTheirSizeAndPlace) {
  for (const std::uint64_t seed : test::seeds(400, 40)) {
    SCOPED_TRACE(seed);
    Draws draw{SequentialRng(seed)};
    const double size = std::pow(10.0, static_cast<double>(seed % 24) - 12.0);
    const Vec3 middle = size * static_cast<double>(seed % 5) * Vec3(draw(3.0), draw(3.0), draw(3.0));
    std::vector<Vec3> points;
    for (std::uint64_t i = 0; i < 4 + seed % 60; ++i) {
      Vec3 p(draw(3.0), draw(3.0), draw(3.0));
      if (seed % 3 == 1) p.normalize();
      if (seed % 3 == 2) p = (2.0 * p).array().round();  // many in one plane
      points.push_back(middle + size * p);
    }
    const Solid hull = convex_hull(points, "points", {});
    expect_hull_of(hull, points, 20.0 * size);
    std::vector<Vec3> other_way(points.rbegin(), points.rend());
    const Solid again = convex_hull(other_way, "points", {});
    EXPECT_EQ(hull.corners, again.corners);
    EXPECT_EQ(hull.faces, again.faces);
  }
}

TEST(ConvexHull, OfFlatPointsIsThePointsThemselves) {
  EXPECT_EQ(convex_hull(std::vector{Vec3(1, 2, 3)}, "p", {}).corners, std::vector{Vec3(1, 2, 3)});
  std::vector<Vec3> line;
  for (int i = 0; i < 10; ++i) line.emplace_back(i, 2 * i, 3 * i);
  EXPECT_EQ(convex_hull(line, "p", {}).corners.size(), 10U);
  EXPECT_TRUE(convex_hull(line, "p", {}).faces.empty());
  std::vector<Vec3> plane;
  for (int i = 0; i < 36; ++i) plane.emplace_back(0.1 * (i % 6), 0.1 * (i / 6), 0.01 * (i % 6) + 0.7);
  EXPECT_EQ(convex_hull(plane, "p", {}).corners.size(), 36U);
  EXPECT_TRUE(convex_hull(plane, "p", {}).faces.empty());
}

TEST(ConvexHull, OfManyPointsIsMadeChunkByChunk) {
  std::vector<Vec3> points = cube(1.0, {5.0, 0.0, 0.0});
  Draws draw{SequentialRng(3)};
  for (int i = 0; i < 70'000; ++i) points.emplace_back(5.0 + draw(1.0), draw(1.0), draw(1.0));
  for (int i = 0; i < 20'000; ++i) points.emplace_back(4.0, draw(1.0), draw(1.0));
  const Solid hull = convex_hull(points, "cube", {});
  EXPECT_EQ(hull.corners.size(), 8U);
  expect_hull_of(hull, points, 2.0);
}

TEST(ConvexHull, RefusesTooManyCornersAndStopsWhenToldTo) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < most_hull_corners + 1; ++i) points.emplace_back(static_cast<double>(i), 0.0, 0.0);
  EXPECT_THROW(convex_hull(points, "a line", {}), InputError);
  const Deadline over(0.0);
  Execution execution;
  execution.deadline = &over;
  EXPECT_THROW(convex_hull(cube(1.0), "cube", execution), Stopped);
}

}  // namespace
}  // namespace warren
