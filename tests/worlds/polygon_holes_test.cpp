// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/polygon_holes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/error.hpp"
#include "core/polygon_distance.hpp"
#include "core/rng.hpp"
#include "worlds/plane_obstacles.hpp"

namespace warren {
namespace {

using Ring = std::vector<Vec2>;

Ring star(std::uint64_t seed, std::uint64_t number, Vec2 center, double reach, int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const auto index = number * 100 + static_cast<std::uint64_t>(i);
    const double angle = 2.0 * std::numbers::pi * (i + 0.7 * uniform(seed, index, 0)) / corners;
    const double r = reach * (0.4 + 0.6 * uniform(seed, index, 1));
    ring.push_back({center.x + r * std::cos(angle), center.y + r * std::sin(angle)});
  }
  return ring;
}

double area(const Ring& ring) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) doubled += cross(ring[i], ring[(i + 1) % ring.size()]);
  return doubled / 2;
}

/// The pieces are simple, touch at most, and cover the polygon but for its holes.
void check_pieces(const Ring& outer, const std::vector<Ring>& holes, std::uint64_t seed) {
  const std::vector<Ring> pieces = without_holes(outer, holes, {});
  ASSERT_FALSE(pieces.empty());
  Scene scene;
  double covered = 0.0;
  for (const Ring& piece : pieces) {
    scene.polygons.push_back({piece, 1});
    covered += area(piece);
  }
  EXPECT_NO_THROW(plane_obstacles(scene, {}));
  double expected = std::abs(area(outer));
  for (const Ring& hole : holes) expected -= std::abs(area(hole));
  EXPECT_NEAR(covered, expected, 1e-9);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Vec2 p{12.0 * uniform(seed, i, 5) - 1.0, 12.0 * uniform(seed, i, 6) - 1.0};
    bool solid = contains(outer, p);
    for (const Ring& hole : holes) solid = solid && !contains(hole, p);
    int in = 0;
    for (const Ring& piece : pieces) in += contains(piece, p) ? 1 : 0;
    EXPECT_EQ(in, solid ? 1 : 0) << p.x << ' ' << p.y;
  }
}

TEST(PolygonHoles, PiecesCoverThePolygonButNotItsHoles) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Ring outer{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    std::vector<Ring> holes;
    for (std::uint64_t cell = 0; cell < 9; ++cell) {
      if (uniform(seed, cell, 9) < 0.3) continue;
      const Vec2 center{2.0 + 3.0 * static_cast<double>(cell % 3), 2.0 + 3.0 * static_cast<double>(cell / 3)};
      holes.push_back(star(seed, cell, center, 1.4, 3 + static_cast<int>(cell % 5)));
      if (cell % 2 == 0) std::reverse(holes.back().begin(), holes.back().end());
    }
    if (seed % 2 == 0) std::reverse(outer.begin(), outer.end());
    check_pieces(outer, holes, seed);
  }
}

TEST(PolygonHoles, SquaresInARowAndAboveEachOtherAreCutToo) {
  std::vector<Ring> holes;
  for (const double x : {1.0, 4.0, 7.0}) {
    for (const double y : {1.0, 4.0, 7.0}) holes.push_back({{x, y}, {x + 2, y}, {x + 2, y + 2}, {x, y + 2}});
  }
  check_pieces({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, holes, 1);
  EXPECT_EQ(without_holes({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, std::span(holes).first(1), {}).size(), 2U);
}

TEST(PolygonHoles, ThatAreMisplacedAreRefused) {
  const Ring outer{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_TRUE(without_holes(outer, std::vector<Ring>{{{1, 1}, {2, 2}, {3, 3}}}, {}).empty()) << "no area";
  EXPECT_TRUE(without_holes(outer, std::vector<Ring>{{{20, 1}, {22, 1}, {22, 3}}}, {}).empty()) << "outside";
  // A hole that crosses the outline: refused here or by the check of the pieces.
  const std::vector<Ring> pieces = without_holes(outer, std::vector<Ring>{{{8, 1}, {12, 1}, {12, 3}, {8, 3}}}, {});
  Scene scene;
  for (const Ring& piece : pieces) scene.polygons.push_back({piece, 7});
  if (!pieces.empty()) {
    EXPECT_THROW(plane_obstacles(scene, {}), InputError);
  }
}

}  // namespace
}  // namespace warren
