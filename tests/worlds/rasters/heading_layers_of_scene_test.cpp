// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/heading_layers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/base/rng.hpp"
#include "tests/seeds.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/judges/verify_turning.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

Scene random_scene(std::uint64_t seed) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {12, 9}};
  std::vector<Segment> walls;
  for (std::uint64_t i = 0; i < 4; ++i) {
    const Vec2 a{12 * uniform(seed, i, 0), 9 * uniform(seed, i, 1)};
    walls.push_back({a, a + Vec2{4 * uniform(seed, i, 2) - 2, 4 * uniform(seed, i, 3) - 2}});
  }
  scene.walls = WallSet::narrowest(walls);
  const Vec2 p{2 + 8 * uniform(seed, 9, 0), 2 + 5 * uniform(seed, 9, 1)};
  if (seed % 2 == 0) scene.polygons.push_back({{p, p + Vec2{1.5, 0.1}, p + Vec2{0.4, 1.3}}, 0});
  return scene;
}

RobotSpec polygon_robot(std::uint64_t seed) {
  RobotSpec robot;
  robot.kind = RobotKind::polygon;
  if (seed % 3 == 0) robot.outline = {{-0.6, -0.3}, {0.7, -0.3}, {0.7, 0.2}, {-0.6, 0.2}};
  if (seed % 3 == 1) robot.outline = {{0.2, 0.1}, {0.9, 0.1}, {0.5, 0.6}};
  if (seed % 3 == 2) robot.outline = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {0.1, -0.3}, {-0.5, 0.5}};
  return robot;
}

TEST(OrientationLayers, StandingAgreesWithTheVerificationAndMovesAreSafe) {
  for (const std::uint64_t seed : test::seeds(20, 5, 0)) {
    SCOPED_TRACE(seed);
    const Scene scene = random_scene(seed);
    const RobotSpec robot = polygon_robot(seed);
    const double clearance = seed % 4 == 3 ? 0.15 : 0.0;
    const HeadingLayers layers = orientation_layers(scene, robot, {.grid = {0.5, 12}, .clearance = clearance}, {});
    const auto pose = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
      return Se2{0.5 * i, 0.5 * j, 2 * std::numbers::pi * k / 12};
    };
    const auto judged = [&](const std::vector<Se2>& path) {
      return verify_se2(scene, robot.outline, path, {.clearance = clearance}, {}).verified;
    };
    for (std::uint64_t n = 0; n < 150; ++n) {
      const auto i = static_cast<std::uint32_t>(1 + random_bits(seed, n, 0) % (layers.width - 2));
      const auto j = static_cast<std::uint32_t>(random_bits(seed, n, 1) % (layers.height - 1));
      const auto k = static_cast<std::uint32_t>(random_bits(seed, n, 2) % 12);
      ASSERT_EQ(layers.is_free(i, j, k), judged({pose(i, j, k)})) << i << " " << j << " " << k;
      if (!layers.is_free(i, j, k)) continue;
      const std::uint32_t next = (k + 1) % 12;
      if (layers.is_free(i, j, next) && !layers.bitmaps[layers.turning[k]].test(i, j)) {
        ASSERT_TRUE(judged({pose(i, j, k), pose(i, j, next)})) << i << " " << j << " " << k;
      }
      for (std::size_t s = 0; s < 4; ++s) {
        const auto u = static_cast<std::uint32_t>(static_cast<int>(i) + HeadingLayers::steps[s][0]);
        const auto v = static_cast<std::uint32_t>(static_cast<int>(j) + HeadingLayers::steps[s][1]);
        const bool moves = layers.is_free(u, v, k) && !layers.bitmaps[layers.moving[k][s]].test(i, j);
        ASSERT_EQ(moves, judged({pose(i, j, k), pose(u, v, k)})) << i << " " << j << " " << k << " step " << s;
      }
    }
  }
}

TEST(OrientationLayers, PointsAndDiscsHaveOneHeadingAndCertifiedSteps) {
  for (const std::uint64_t seed : test::seeds(12, 4, 0)) {
    SCOPED_TRACE(seed);
    const Scene scene = random_scene(seed);
    RobotSpec robot;
    robot.kind = seed % 2 == 0 ? RobotKind::point : RobotKind::disc;
    robot.radius = seed % 2 == 0 ? 0.0 : 0.4;
    const HeadingLayers layers = orientation_layers(scene, robot, {{0.5, 72}}, {});
    EXPECT_EQ(layers.angles, 1U);
    for (std::uint32_t j = 0; j + 1 < layers.height; ++j) {
      for (std::uint32_t i = 1; i + 1 < layers.width; ++i) {
        const auto judged = [&](const std::vector<Vec2>& path) {
          return verify_path(scene, path, {.clearance = robot.radius}, {}).verified;
        };
        const Vec2 here{0.5 * i, 0.5 * j};
        ASSERT_EQ(layers.is_free(i, j, 0), judged({here}));
        if (!layers.is_free(i, j, 0)) continue;
        for (std::size_t s = 0; s < 4; ++s) {
          const auto [dx, dy] = HeadingLayers::steps[s];
          const bool moves = !layers.bitmaps[layers.moving[0][s]].test(i, j);
          ASSERT_TRUE(!moves || judged({here, here + Vec2{0.5 * dx, 0.5 * dy}}));
        }
      }
    }
  }
}

TEST(ConvexPieces, CoverAPolygonAndNothingElse) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    std::vector<Vec2> outline = polygon_robot(seed).outline;
    for (const bool turned_round : {false, true}) {
      if (turned_round) std::reverse(outline.begin(), outline.end());
      double area = 0.0;
      for (const ConvexPiece& piece : outline_pieces(outline)) {
        for (std::size_t i = 0; i < piece.size(); ++i) area += cross(piece[i], piece[(i + 1) % piece.size()]) / 2;
      }
      double whole = 0.0;
      for (std::size_t i = 0; i < outline.size(); ++i)
        whole += cross(outline[i], outline[(i + 1) % outline.size()]) / 2;
      EXPECT_NEAR(area, std::abs(whole), 1e-12);
    }
  }
}

TEST(Turned, QuarterTurnsKeepASquaresBits) {
  const std::vector<Vec2> square{{-25, -25}, {25, -25}, {25, 25}, {-25, 25}};
  for (std::uint32_t k = 0; k < 18; ++k) {
    EXPECT_EQ(convex_hull(turned(square, k, 72)), convex_hull(turned(square, k + 18, 72))) << k;
    EXPECT_EQ(convex_hull(turned(square, k, 72)), convex_hull(turned(square, k + 54, 72))) << k;
  }
}

TEST(LatticeMarking, MarksInsidesOfSimplePolygons) {
  LatticeMarking marking({0, 0}, 1.0, 8, 6);
  const std::vector<Vec2> u{{0.5, 0.5}, {6.5, 0.5}, {6.5, 4.5}, {4.5, 4.5},
                            {4.5, 2.5}, {2.5, 2.5}, {2.5, 4.5}, {0.5, 4.5}};
  marking.mark_inside(u, {0, 0}, {});
  const Bitmap marked = marking.take();
  for (std::uint32_t y = 0; y < 6; ++y) {
    for (std::uint32_t x = 0; x < 8; ++x) {
      const bool inside = x >= 1 && x <= 6 && y >= 1 && y <= 4 && !(x >= 3 && x <= 4 && y >= 3);
      EXPECT_EQ(marked.test(x, y), inside) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace warren
