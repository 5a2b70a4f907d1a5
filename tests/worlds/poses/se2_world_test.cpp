// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/se2_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "core/base/error.hpp"
#include "core/plane/polygon.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "verify/judges/verify_turning.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

using body_scenes::corners_at;
using body_scenes::hook;
using body_scenes::kite;
using body_scenes::random_pose;
using body_scenes::scattered;

/// Distance of the body to everything, pair by pair with the exact predicates; negative outside the bounds.
double plain_clearance(const Scene& scene, const std::vector<Vec2>& outline, const Se2& pose) {
  const std::vector<Vec2> body = corners_at(outline, pose);
  double least = std::numeric_limits<double>::infinity();
  for (const ScenePolygon& polygon : scene.polygons) least = std::min(least, distance(body, polygon.corners));
  for (std::size_t i = 0; i < scene.walls.size(); ++i) least = std::min(least, distance(body, scene.walls.segment(i)));
  if (!scene.bounds) return least;
  for (const Vec2 p : body) {
    least = std::min({least, p.x - scene.bounds->min.x, scene.bounds->max.x - p.x, p.y - scene.bounds->min.y,
                      scene.bounds->max.y - p.y});
  }
  return least;
}

TEST(Se2World, ClearanceIsTheDistanceToTheNearestObstacle) {
  for (const std::uint64_t seed : test::seeds(20)) {
    SCOPED_TRACE(seed);
    const Scene scene = scattered(seed, seed % 5 == 0 ? 60 : 12);
    for (const auto& outline : {kite, hook}) {
      const Se2World world(scene, outline, {});
      auto query = world.make_query();
      for (std::uint64_t i = 0; i < 300; ++i) {
        const Se2 pose = random_pose(seed, i);
        const double plain = plain_clearance(scene, outline, pose);
        const double fast = world.clearance(pose, 1e9, query);
        if (plain <= 0.0) {
          EXPECT_LE(fast, 0.0) << i;
        } else {
          EXPECT_LE(fast, plain + 1e-14) << i;  // a lower bound, and a tight one
          EXPECT_GE(fast, plain - 2e-12) << i;
        }
        const double enough = 0.3 * uniform(seed, i, 9);
        if (plain > enough + 1e-12) {
          EXPECT_GT(world.clearance(pose, enough, query), enough) << i;
        }
        EXPECT_EQ(world.is_free(pose, query), plain > 1e-12) << i;
      }
    }
  }
}

TEST(Se2World, ConvexObstaclesMayHaveCornersInTheirSidesAndGoEitherWayRound) {
  const std::vector<Vec2> split = {{0, 0}, {0.5, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 0.3}};
  for (const bool clockwise : {false, true}) {
    for (std::size_t first = 0; first < split.size(); ++first) {
      SCOPED_TRACE(std::to_string(first) + (clockwise ? " clockwise" : " anticlockwise"));
      std::vector<Vec2> corners = split;
      if (clockwise) std::reverse(corners.begin(), corners.end());
      std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first), corners.end());
      Scene scene;
      scene.bounds = Box{{-3, -3}, {5, 5}};
      scene.polygons.push_back({corners});
      const Se2World world(scene, kite, {});
      auto query = world.make_query();
      for (std::uint64_t i = 0; i < 200; ++i) {
        const Se2 pose = uniform_state(world, first, i);
        const double plain = plain_clearance(scene, kite, pose);
        EXPECT_EQ(world.is_free(pose, query), plain > 1e-12) << i;
        EXPECT_NEAR(std::max(0.0, world.clearance(pose, 1e9, query)), std::max(0.0, plain), 1e-11) << i;
      }
    }
  }
}

TEST(Se2World, BodyInAPolygonAndAWallInTheBodyAreBlocked) {
  Scene scene;
  scene.bounds = Box{{-10, -10}, {10, 10}};
  scene.polygons.push_back({{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}});
  auto is_free = [&](const Scene& s, const Se2& pose) {
    const Se2World world(s, hook, {});
    auto query = world.make_query();
    return world.is_free(pose, query);
  };
  EXPECT_FALSE(is_free(scene, {0, 0, 0}));
  EXPECT_TRUE(is_free(scene, {-8, 0, 0}));
  Scene wall;
  wall.bounds = scene.bounds;
  wall.walls = WallSet::narrowest(std::vector<Segment>{{{0.35, 0.0}, {0.45, 0.1}}});
  EXPECT_FALSE(is_free(wall, {0, 0, 0}));          // wholly in the hook's arm
  EXPECT_TRUE(is_free(wall, {0.35, 0.0, 0}));      // in its bay
  EXPECT_FALSE(is_free(wall, {0.05, 0.0, 0.05}));  // across its boundary
}

/// Nothing comes near the body's outline: only what lies inside tells.
TEST(Se2World, WhatHoldsTheOtherWhollyBlocksPosesAndMotions) {
  const auto scaled = [](std::vector<Vec2> corners, double by) {
    for (Vec2& p : corners) p = by * p;
    return corners;
  };
  const std::vector<Vec2> square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const std::vector<Vec2> arrow = {{-1, -1}, {0.5, 0.2}, {1, 1}, {0.2, 0.5}};
  const auto polygon = [](std::vector<Vec2> corners) {
    Scene scene;
    scene.polygons.push_back({std::move(corners)});
    return scene;
  };
  Scene wall;
  wall.walls = WallSet::narrowest(std::vector<Segment>{{{-0.1, 0.0}, {0.1, 0.1}}});
  const std::vector<Scene> scenes = {wall, polygon(scaled(square, 0.1)), polygon(scaled(arrow, 0.1)),
                                     polygon(scaled(square, 5.0)),
                                     polygon({{-9, -9}, {9, -9}, {9, 9}, {0, 6}, {-9, 9}})};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    SCOPED_TRACE(i);
    Scene scene = scenes[i];
    scene.bounds = Box{{-20, -20}, {20, 20}};
    const Se2World world(scene, square, {});
    auto query = world.make_query();
    EXPECT_FALSE(world.is_free({0, 0, 0}, query));
    EXPECT_LE(world.clearance({0, 0, 0}, 1e9, query), 0.0);
    EXPECT_FALSE(world.is_free_motion({0, 0, 0}, {0.2, 0, 0}, query));
    EXPECT_FALSE(world.is_free_motion({0, 0, 0}, {0, 0.1, 0.2}, query));
  }
}

TEST(Se2World, TouchingIsBlockedAndClearanceIsKept) {
  const std::vector<Vec2> square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  Scene scene;
  scene.bounds = Box{{-10, -10}, {10, 10}};
  scene.polygons.push_back({{{2, -3}, {4, -3}, {4, 3}, {2, 3}}});
  const Se2World plain(scene, square, {});
  const Se2World wide(scene, square, 0.5);
  auto query = plain.make_query();
  EXPECT_FALSE(plain.is_free({1, 0, 0}, query));
  EXPECT_TRUE(plain.is_free({1 - 1e-9, 0, 0}, query));
  EXPECT_FALSE(plain.is_free({-9, 0, 0}, query));  // touches the bounds
  EXPECT_TRUE(plain.is_free({-9 + 1e-9, 0, 0}, query));
  EXPECT_FALSE(wide.is_free({0.5, 0, 0}, query));
  EXPECT_TRUE(wide.is_free({0.5 - 1e-6, 0, 0}, query));
}

/// 1000 accepted motions, 100 places each against everything: none collides.
TEST(Se2World, AcceptedMotionsAreFreeEverywhere) {
  for (const std::uint64_t seed : test::seeds(20)) {
    SCOPED_TRACE(seed);
    const Scene scene = scattered(seed);
    const auto& outline = seed % 2 == 0 ? kite : hook;
    const Se2World world(scene, outline, seed % 3 == 0 ? 0.05 : 0.0);
    const double room = seed % 3 == 0 ? 0.05 : 0.0;
    auto query = world.make_query();
    int accepted = 0;
    for (std::uint64_t i = 0; i < 2000 && accepted < 50; ++i) {
      const Se2 a = random_pose(seed, 2 * i);
      const Se2 far = random_pose(seed, 2 * i + 1);
      const Se2 b = world.interpolate(a, far, 0.3);
      if (!world.is_free_motion(a, b, query)) continue;
      ++accepted;
      for (int step = 0; step <= 100; ++step) {
        const double t = step / 100.0;
        const double turn = std::remainder(b.theta - a.theta, 2.0 * std::numbers::pi);
        const Se2 pose{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.theta + t * turn};
        ASSERT_GE(plain_clearance(scene, outline, pose), room) << i << " at " << t;
      }
    }
    EXPECT_EQ(accepted, 50);
  }
}

/// What keeps a hundredth of the body's radius is accepted, always; what collides at a sampled place never.
TEST(Se2World, RefusesNothingThatHasAHundredthOfTheRadiusToSpare) {
  std::uint64_t spared = 0;
  for (const std::uint64_t seed : test::seeds(20)) {
    SCOPED_TRACE(seed);
    const Scene scene = scattered(seed);
    const Se2World world(scene, kite, {});
    auto query = world.make_query();
    for (std::uint64_t i = 0; i < 400; ++i) {
      const Se2 a = random_pose(seed, 2 * i);
      const Se2 b = world.interpolate(a, random_pose(seed, 2 * i + 1), 0.3);
      double least = std::numeric_limits<double>::infinity();
      for (int step = 0; step <= 64 && least > 0.0; ++step) {
        least = std::min(least, plain_clearance(scene, kite, world.interpolate(a, b, step / 64.0)));
      }
      const double turn = std::abs(turn_between(a.theta, b.theta));
      const double between_samples = (distance(a.position(), b.position()) + world.radius() * turn) / 128.0;
      const bool accepted = world.is_free_motion(a, b, query);
      if (least <= 0.0) {
        EXPECT_FALSE(accepted) << i;
      }
      if (least - between_samples > 0.01 * world.radius()) {
        EXPECT_TRUE(accepted) << i;
        ++spared;
      }
    }
  }
  EXPECT_GT(spared, test::share(1000));
}

TEST(Se2World, TurnsTheShorterWayThroughTheWrap) {
  Scene scene;
  scene.bounds = Box{{-10, -10}, {10, 10}};
  const Se2World world(scene, kite, {});
  const Se2 a{0, 0, 3.0};
  const Se2 b{0, 0, -3.0};
  const double turn = 2.0 * std::numbers::pi - 6.0;
  EXPECT_NEAR(world.distance(a, b), world.radius() * turn, 1e-14);
  EXPECT_NEAR(std::abs(world.interpolate(a, b, 0.5).theta), std::numbers::pi, 1e-14);
  EXPECT_NEAR(world.distance(a, world.interpolate(a, b, 0.25)), 0.25 * world.radius() * turn, 1e-14);
  EXPECT_EQ(world.interpolate(a, b, 1.0), b);
  EXPECT_NEAR(world.distance({0, 0, 0.1}, {0, 0, 0.1 + 8.0 * std::numbers::pi}), 0.0, 1e-13);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Se2 p = random_pose(1, 2 * i);
    const Se2 q = random_pose(1, 2 * i + 1);
    const auto u = world.embed(p);
    const auto v = world.embed(q);
    double chord = 0.0;
    for (std::size_t axis = 0; axis < 4; ++axis) chord += (u[axis] - v[axis]) * (u[axis] - v[axis]);
    EXPECT_LE(std::sqrt(chord), world.distance(p, q) * (1.0 + 1e-12));
    EXPECT_NEAR(world.distance(p, q), world.distance(q, p), 1e-12);
  }
}

TEST(Se2World, SamplesKeepTheBodyInTheBounds) {
  Scene scene;
  scene.bounds = Box{{-2, -2}, {2, 3}};
  const Se2World world(scene, kite, {});
  auto query = world.make_query();
  for (std::uint64_t i = 0; i < 1000; ++i) EXPECT_TRUE(world.is_free(uniform_state(world, 1, i), query)) << i;
}

TEST(Se2World, WithoutBoundsTheBoxOfTheObstaclesConfinesTheReferencePoint) {
  Scene scene;
  scene.polygons.push_back({{{0, 0}, {1, 0}, {0, 1}}});
  scene.polygons.push_back({{{9, 9}, {10, 9}, {10, 10}}});
  const Se2World world(scene, kite, {});
  auto query = world.make_query();
  EXPECT_TRUE(world.is_free({0.1, 9.9, 0}, query));  // the body sticks out
  EXPECT_FALSE(world.is_free({-0.1, 5, 0}, query));
}

TEST(Se2World, RefusesOptionsThatMakeNoSense) {
  Scene scene;
  scene.bounds = Box{{-2, -2}, {2, 3}};
  const auto message = [&](const Scene& s, const std::vector<Vec2>& outline, double clearance) {
    return test::refusal<InputError>([&] { const Se2World world(s, outline, clearance); });
  };
  EXPECT_NE(message(scene, {{0, 0}, {1, 0}}, {}).find("three different corners"), std::string::npos);
  EXPECT_NE(message(scene, kite, -1.0).find("clearance"), std::string::npos);
  EXPECT_NE(message({}, kite, {}).find("confines"), std::string::npos);
}

/// A map of 12 x 8 cells with a block of 4 x 4, turned and moved, and its borders as walls.
Scene block_map() {
  Scene scene;
  OccupancyMap map;
  map.blocked = Bitmap(12, 8);
  for (std::uint32_t y = 2; y < 6; ++y) map.blocked.set_run(y, 4, 8);
  map.cell = 0.5;
  map.origin = {3.0, -2.0};
  map.yaw_rad = 0.4;
  scene.map = map;
  add_map_walls(scene, {});
  return scene;
}

TEST(Se2World, OnAMapABodyIsFreeOnlyAmongFreeCells) {
  const Scene scene = block_map();
  const std::vector<Vec2> body{{-0.1, -0.2}, {0.3, -0.2}, {0.1, 0.2}};
  const Se2World world(scene, body, {});
  auto query = world.make_query();
  std::uint64_t free = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Se2 pose = i % 3 == 0 ? world.corridor_state(1, i) : uniform_state(world, 1, i);
    // All of the body's corners, and many points of its sides, against the cells.
    bool touches = false;
    for (std::size_t side = 0; side < body.size(); ++side) {
      for (int step = 0; step < 20; ++step) {
        const Vec2 a = body[side];
        const Vec2 b = body[(side + 1) % body.size()];
        const auto cell = cell_at(*scene.map, placed(pose, a + (step / 20.0) * (b - a)));
        touches = touches || !cell || scene.map->blocked.test(cell->x, cell->y);
      }
    }
    const bool is_free = world.is_free(pose, query);
    free += is_free ? 1 : 0;
    ASSERT_FALSE(is_free && touches) << i;
    ASSERT_TRUE(is_free || touches || world.clearance(pose, 0.0, query) < 0.05) << i;
    const Verification judged = verify_se2(scene, body, std::span(&pose, 1), {}, {});
    ASSERT_FALSE(is_free && !judged.verified) << i;
    ASSERT_FALSE(judged.verified && touches) << i;
  }
  EXPECT_GT(free, test::share(500));
}

}  // namespace
}  // namespace warren
