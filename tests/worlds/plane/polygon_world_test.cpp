// SPDX-License-Identifier: BSD-3-Clause
// Polygon worlds, checked by the verifier's geometry, which shares nothing with theirs.
#include "worlds/plane/polygon_world.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/scene/polygon_generator.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"
#include "verify/exact/exact_segments.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {
namespace {

Scene scene_of(std::vector<std::vector<Vec2>> polygons) {
  Scene scene;
  scene.source = "test.scene";
  std::size_t line = 1;
  for (auto& corners : polygons) scene.polygons.push_back({std::move(corners), line++});
  return scene;
}

std::vector<Vec2> square_at(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

/// Triangles and quadrangles on a small grid: they touch, overlap and share corners and sides.
Scene crowd(std::uint64_t seed) {
  Scene scene = scene_of({});
  for (std::uint64_t k = 0; scene.polygons.size() < 14; ++k) {
    const auto coordinate = [&](std::uint64_t axis) { return std::floor(14 * uniform(seed, k, axis)); };
    const Vec2 at{coordinate(0), coordinate(1)};
    std::vector<Vec2> corners = square_at(at.x, at.y, 1 + std::floor(3 * uniform(seed, k, 2)));
    if (k % 2 == 0) corners.pop_back();
    if (k % 3 == 0) corners[1] = corners[1] + Vec2{2, -1};
    if (k % 5 == 0) std::reverse(corners.begin(), corners.end());
    scene.polygons.push_back({corners, 0});
  }
  const Segment walls[] = {{{0, 0}, {5, 5}}, {{3, 9}, {3, 12}}, {{7, 7}, {7, 7}}};
  scene.walls = WallSet::narrowest(walls);
  return scene;
}

bool plain_free_motion(const Obstacles& obstacles, Vec2 a, Vec2 b, double r) {
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Segment s{a, b};
    if (r > 0 ? exact::closer_than(s, obstacles.segment(i), r) : exact::touch(s, obstacles.segment(i))) return false;
  }
  return true;
}

bool plain_free(const Obstacles& obstacles, Vec2 p, double r) {
  if (!plain_free_motion(obstacles, p, p, r)) return false;
  for (const Ring& ring : obstacles.rings()) {
    if (ring.polygon != Ring::none && strictly_inside(ring, p)) return false;
  }
  return true;
}

TEST(PolygonWorld, StatesAndMotionsAreFreeAsTheVerifiersGeometrySays) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene = seed % 2 == 0 ? crowd(seed) : polygon_scene({.count = 20, .corners = {}, .seed = seed}, {});
    if (seed % 3 == 0) scene.bounds = Box{{-1, -1}, {60, 60}};
    const double r = seed % 4 < 2 ? 0.0 : 0.3;
    const PolygonWorld world(scene, r, {});
    const Obstacles obstacles(scene);
    auto query = world.make_query();
    std::size_t free_states = 0;
    std::size_t free_motions = 0;
    std::vector<Vec2> standing;
    for (std::uint64_t i = 0; i < 600; ++i) {
      Vec2 p = uniform_state(world, seed, i);
      if (i % 2 == 0) p = {std::round(p.x), std::round(p.y)};  // corners and sides of the small grid
      const bool plain = world.box().contains(p) && plain_free(obstacles, p, world.planning_clearance());
      ASSERT_EQ(world.is_free(p, query), plain) << p.x << ' ' << p.y;
      free_states += plain ? 1 : 0;
      if (plain) standing.push_back(p);
    }
    for (std::size_t i = 1; i < standing.size(); ++i) {
      const bool plain = plain_free_motion(obstacles, standing[i - 1], standing[i], world.planning_clearance());
      ASSERT_EQ(world.is_free_motion(standing[i - 1], standing[i], query), plain) << i;
      free_motions += plain ? 1 : 0;
    }
    EXPECT_GT(free_states, 50U);
    EXPECT_LT(free_states, 600U);
    EXPECT_GT(free_motions, 0U);
  }
}

TEST(PolygonWorld, CornersSidesAndInsidesAreBlockedAndWhatLiesBetweenTouchingPolygonsToo) {
  const Scene scene = scene_of({square_at(0, 0, 2), square_at(2, 0, 2), square_at(4, 2, 2)});
  const PolygonWorld world(scene, 0.0, {});
  auto query = world.make_query();
  for (const Vec2 p : {Vec2{1, 1}, Vec2{2, 1}, Vec2{4, 2}, Vec2{0, 0}, Vec2{5, 4}}) {
    EXPECT_FALSE(world.is_free(p, query)) << p.x << ' ' << p.y;
  }
  EXPECT_TRUE(world.is_free({1, 3}, query));
  EXPECT_FALSE(world.is_free_motion({3, 3}, {5, 1}, query)) << "through the common corner";
  EXPECT_FALSE(world.is_free_motion({0, 2.0}, {4, 2.0}, query)) << "along a side";
  EXPECT_TRUE(world.is_free_motion({0, 2.5}, {3.5, 2.5}, query));
}

TEST(PolygonWorld, ASceneWithoutObstaclesIsRefused) { EXPECT_THROW(PolygonWorld(Scene{}, 0.0, {}), InputError); }

TEST(PlaneObstacles, PolygonsThatAreNoneAreRefusedWithTheirLine) {
  const std::pair<std::vector<Vec2>, const char*> cases[] = {
      {{{0, 0}, {1, 0}, {0, 0}}, "three different corners"},
      {{{3, 3}, {3, 3}, {3, 3}}, "three different corners"},
      {{{0, 0}, {1, 1}, {2, 2}}, "no area"},
      {{{0, 0}, {2, 2}, {1, 1}, {3, 3}}, "no area"},
      {{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, "cross or touch"},
      {{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, "cross or touch"},                   // a corner on a side
      {{{0, 0}, {4, 0}, {4, 4}, {4, 2}, {2, 6}}, "cross or touch"},                   // a side turns back
      {{{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}, "cross or touch"},           // twice the same corner
      {{{0, 0}, {6, 0}, {6, 2}, {6, 2}, {2, 2}, {2, 0}, {0, 3}}, "cross or touch"}};  // along a side
  for (const auto& [corners, said] : cases) {
    const Scene scene = scene_of({square_at(10, 10, 1), corners});
    SCOPED_TRACE(said);
    const std::string text = test::refusal<InputError>([&] { plane_obstacles(scene, {}); });
    EXPECT_EQ(text.rfind("test.scene:2: ", 0), 0U) << text;
    EXPECT_NE(text.find(said), std::string::npos) << text;
  }
}

TEST(PlaneObstacles, RepeatedCornersAreMergedAndAllRunAnticlockwise) {
  const Scene scene = scene_of({{{0, 0}, {0, 0}, {0, 2}, {2, 2}, {2, 2}, {2, 1}, {2, 0}, {0, 0}}});
  const PlaneObstacles obstacles = plane_obstacles(scene, {});
  const std::vector<Vec2> merged(obstacles.polygons[0].begin(), obstacles.polygons[0].end());
  EXPECT_EQ(merged, (std::vector<Vec2>{{2, 0}, {2, 1}, {2, 2}, {0, 2}, {0, 0}})) << "straight corners stay";
}

TEST(PolygonGenerator, PolygonsAreSimpleAndFarFromEachOther) {
  for (const std::uint64_t seed : test::seeds(20, 6, 0)) {
    SCOPED_TRACE(seed);
    PolygonOptions options{.count = 40, .corners = {}, .seed = seed};
    if (seed % 2 == 1) options.corners = static_cast<std::uint32_t>(3 + 2 * seed);
    const Scene scene = polygon_scene(options, {});
    const Obstacles obstacles(scene);
    ASSERT_EQ(scene.polygons.size(), 40U);
    ASSERT_NO_THROW(check_polygons(scene, {}));
    for (std::size_t i = 0; i < obstacles.size(); ++i) {  // bounds included
      for (std::size_t j = i + 1; j < obstacles.size(); ++j) {
        if (obstacles.sides()[i].ring == obstacles.sides()[j].ring) continue;
        ASSERT_GT(exact::distance(obstacles.segment(i), obstacles.segment(j)), 0.1);
      }
    }
    for (const Ring& ring : obstacles.rings()) {
      for (const Ring& other : obstacles.rings()) {
        if (&ring == &other || ring.polygon == Ring::none || other.polygon == Ring::none) continue;
        ASSERT_FALSE(strictly_inside(ring, other.corners[0]));
      }
      if (ring.polygon == Ring::none) continue;
      EXPECT_EQ(ring.corners.size(), options.corners.value_or(static_cast<std::uint32_t>(ring.corners.size())));
      EXPECT_FALSE(strictly_inside(ring, {scene.start[0], scene.start[1]}));
      EXPECT_FALSE(strictly_inside(ring, {scene.goal[0], scene.goal[1]}));
    }
  }
}

TEST(PolygonGenerator, TheSameWorldForAnyNumberOfThreadsAndAnotherForAnotherSeed) {
  const auto hash = [](std::uint64_t seed, unsigned threads) {
    Execution execution;
    execution.threads = threads;
    return scene_hash(polygon_scene({.count = 5000, .corners = {}, .seed = seed}, execution));
  };
  EXPECT_EQ(hash(1, 1), hash(1, 3));
  EXPECT_NE(hash(1, 1), hash(2, 1));
}

TEST(PolygonGenerator, ImpossibleNumbersAreRefused) {
  EXPECT_THROW(polygon_scene({.count = 0, .corners = {}, .seed = 1}, {}), InputError);
  EXPECT_THROW(polygon_scene({.count = 10, .corners = 2, .seed = 1}, {}), InputError);
  EXPECT_THROW(polygon_scene({.count = std::uint64_t{1} << 40, .corners = 5, .seed = 1}, {}), InputError);
}

}  // namespace
}  // namespace warren
