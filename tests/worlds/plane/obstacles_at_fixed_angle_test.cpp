// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/polygon_world.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/plane/polygon.hpp"
#include "tests/worlds/poses/body_scenes.hpp"

namespace warren {
namespace {

using body_scenes::corners_at;

/// The reference point is blocked exactly where the body, placed there, overlaps an obstacle or leaves the bounds.
TEST(TranslationObstacles, BlockThePointWhereTheBodyCollides) {
  constexpr double room = 1e-7;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = body_scenes::scattered(seed);
    const auto& outline = seed % 2 == 0 ? body_scenes::kite : body_scenes::hook;
    const double theta = 6.0 * uniform(seed, 0, 50);
    const PlaneObstacles obstacles = translation_obstacles(scene, outline, theta, room);
    for (std::uint64_t i = 0; i < 500; ++i) {
      const Vec2 p{10.0 * uniform(seed, i, 0), 10.0 * uniform(seed, i, 1)};
      const std::vector<Vec2> body = corners_at(outline, {p.x, p.y, theta});
      double least = 1e9;
      for (const ScenePolygon& polygon : scene.polygons) least = std::min(least, distance(body, polygon.corners));
      for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        least = std::min(least, distance(body, scene.walls.segment(w)));
      }
      for (const Vec2 c : body) least = std::min({least, c.x, c.y, 10.0 - c.x, 10.0 - c.y});
      bool blocked = !obstacles.bounds->contains(p);
      for (std::size_t k = 0; k < obstacles.polygons.size(); ++k) {
        blocked = blocked || contains(obstacles.polygons[k], p);
      }
      if (least <= 0.5 * room) {
        EXPECT_TRUE(blocked) << i;
      }
      if (least > 1.01 * room) {
        EXPECT_FALSE(blocked) << i;
      }
    }
  }
}

// An L is two convex pieces, not the four triangles that it can be cut into.
TEST(TranslationObstacles, AreSumsOfTheFewestPieces) {
  const std::vector<Vec2> square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  Scene scene;
  scene.polygons.push_back({{{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {0, 1}}, 0});
  EXPECT_EQ(translation_obstacles(scene, square, 0.0, 1e-9).polygons.size(), 2U);
}

TEST(TranslationObstacles, RefuseABodyThatIsTooLargeForTheBounds) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {0.2, 5}};
  EXPECT_THROW(translation_obstacles(scene, body_scenes::kite, 0.0, 1e-9), InputError);
}

}  // namespace
}  // namespace warren
