// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/lattice_polygons.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/rng.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren {
namespace {

/// A convex polygon of up to eight corners around a place.
std::vector<Vec2> random_hull(std::uint64_t seed, std::uint64_t index) {
  const Vec2 centre{10.0 * uniform(seed, index, 0), 10.0 * uniform(seed, index, 1)};
  std::vector<Vec2> points;
  for (std::uint64_t i = 0; i < 8; ++i) {
    points.push_back(centre + Vec2{2.0 * uniform(seed, index, 2 * i + 2), 2.0 * uniform(seed, index, 2 * i + 3)});
  }
  return convex_hull(points);
}

Scene scene_of_hulls(std::uint64_t seed) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {12, 9}};
  for (std::uint64_t i = 0; i < 6; ++i) {
    std::vector<Vec2> hull = random_hull(seed, i);
    if (i % 2 == 0) hull = {hull.rbegin(), hull.rend()};
    scene.polygons.push_back({hull});
  }
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{1, 1}, {3, 2}}, {{5, 8}, {5, 6}}, {{7, 2}, {9, 2}}});
  return scene;
}

TEST(FreePlaces, AreThoseOfAConvexBodyAtThatHeading) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const Se2World world(scene_of_hulls(seed), body_scenes::kite, {});
    auto query = world.make_query();
    const Se2 pose{0, 0, 6.0 * uniform(seed, 0, 77)};
    const PlaceGrid free = world.free_places(pose);
    ASSERT_EQ(free.columns, PlaceGrid::most);
    std::size_t count = 0;
    for (std::size_t row = 0; row < free.rows; ++row) {
      for (std::size_t column = 0; column < free.columns; ++column) {
        const Vec2 p = free.at(column, row);
        // On the bounds, and where rounding decides, either answer will do.
        const bool is_inner = row > 0 && column > 0 && row + 1 < free.rows && column + 1 < free.columns;
        const double clearance = world.clearance(world.shifted(pose, p), 1.0, query);
        if (is_inner && clearance == 0.0) {
          EXPECT_FALSE(free.test(column, row)) << p.x << ' ' << p.y;
        }
        if (clearance > 1e-9) {
          EXPECT_TRUE(free.test(column, row)) << p.x << ' ' << p.y;
        }
        count += free.test(column, row) ? 1 : 0;
      }
    }
    EXPECT_GT(count, 0U);
    EXPECT_LT(count, free.rows * free.columns);
  }
}

TEST(FreePlaces, KeepTheClearanceAndTheBounds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Se2World world(scene_of_hulls(seed), body_scenes::kite, 0.2);
    auto query = world.make_query();
    const Se2 pose{0, 0, 6.0 * uniform(seed, 0, 78)};
    const PlaceGrid free = world.free_places(pose);
    for (std::size_t row = 0; row < free.rows; ++row) {
      for (std::size_t column = 0; column < free.columns; ++column) {
        if (!free.test(column, row)) continue;
        EXPECT_GT(world.clearance(world.shifted(pose, free.at(column, row)), 1.0, query), -1e-9);
      }
    }
  }
}

TEST(FreePlaces, AreNoneWhereTheBodyDoesNotFitOrObstaclesAreMany) {
  Scene scene = scene_of_hulls(1);
  scene.bounds = Box{{0, 0}, {0.5, 0.5}};
  EXPECT_EQ(Se2World(scene, body_scenes::kite, {}).free_places({}).columns, 0U);
  scene.bounds.reset();
  std::vector<Segment> walls;
  for (int i = 0; i < 300; ++i) walls.push_back({{0.1 * i, 0.0}, {0.1 * i, 0.05}});
  scene.walls = WallSet::narrowest(walls);
  EXPECT_EQ(Se2World(scene, body_scenes::kite, {}).free_places({}).columns, 0U);
}

TEST(TakeBlockedPlaces, OfAPointIsTheObstacleItself) {
  PlaceGrid free = PlaceGrid::over({{0, 0}, {63, 31}});
  const std::vector<Vec2> triangle{{10.5, 4.5}, {20.5, 4.5}, {10.5, 14.5}};
  take_blocked_places(triangle, std::vector<Vec2>{{0, 0}}, 0.0, free);
  for (std::size_t row = 0; row < free.rows; ++row) {
    for (std::size_t column = 0; column < free.columns; ++column) {
      const bool is_inside = column > 10 && row > 4 && column + row <= 25;
      EXPECT_EQ(free.test(column, row), !is_inside) << column << ' ' << row;
    }
  }
}

}  // namespace
}  // namespace warren
