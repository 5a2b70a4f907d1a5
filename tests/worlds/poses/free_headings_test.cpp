// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/free_headings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/plane/geometry.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

using namespace body_scenes;

constexpr double full_turn = 2.0 * std::numbers::pi;

std::vector<Segment> sides_of(const std::vector<Vec2>& corners) {
  std::vector<Segment> sides;
  for (std::size_t i = 0; i < corners.size(); ++i) sides.push_back({corners[i], corners[(i + 1) % corners.size()]});
  return sides;
}

/// Of all sides, pair by pair.
double plain_room(const Scene& scene, const std::vector<Vec2>& outline, const Se2& pose) {
  std::vector<Segment> obstacles = bounds_walls(scene);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) obstacles.push_back(scene.walls.segment(i));
  for (const ScenePolygon& polygon : scene.polygons) {
    for (const Segment& side : sides_of(polygon.corners)) obstacles.push_back(side);
  }
  double least = 1e9;
  for (const Segment& side : sides_of(corners_at(outline, pose))) {
    for (const Segment& obstacle : obstacles) least = std::min(least, distance(side, obstacle));
  }
  return least;
}

/// How far a heading is inside of an interval; below 0: outside of all.
double depth_in(const std::vector<HeadingInterval>& intervals, double theta) {
  double most = -1.0;
  for (const HeadingInterval& free : intervals) {
    if (free.width >= full_turn) return full_turn;
    const double behind = std::fmod(theta - free.low + 2.0 * full_turn, full_turn);
    most = std::max(most, std::min(behind, free.width - behind));
  }
  return most;
}

TEST(FreeHeadings, AreThoseAtWhichNoSideIsNear) {
  constexpr int headings = 720;
  std::size_t mixed = 0;
  for (const std::uint64_t seed : test::seeds(20)) {
    const Scene scene = scattered(seed, 12);
    for (std::uint64_t i = 0; i < test::share(20, 8); ++i) {
      const Vec2 place = random_pose(seed, i).position();
      const std::vector<Vec2>& outline = i % 2 == 0 ? kite : hook;
      const double room = i % 3 == 0 ? 0.0 : 0.05 * static_cast<double>(i % 3);
      const std::vector<HeadingInterval> free = free_headings(scene, outline, place, room, {});
      mixed += !free.empty() && free.front().width < full_turn ? 1U : 0U;
      for (int k = 0; k < headings; ++k) {
        const double theta = wrapped_angle(full_turn * (k + 0.37) / headings);
        const double least = plain_room(scene, outline, {place.x, place.y, theta});
        const double depth = depth_in(free, theta);
        if (depth > 1e-6) {
          ASSERT_GT(least, room - 1e-9) << seed << ' ' << i << ' ' << theta;
        } else if (depth < 0.0) {
          ASSERT_LT(least, room + 1e-6) << seed << ' ' << i << ' ' << theta;
        }
      }
    }
  }
  EXPECT_GT(mixed, test::share(20, 4)) << "places at which some headings are free";
}

TEST(FreeHeadings, OfAMapAreThoseAmongItsBorders) {
  Scene scene;
  scene.map.emplace();
  scene.map->cell = 0.5;
  scene.map->origin = {3.0, -2.0};
  scene.map->yaw_rad = 0.4;
  scene.map->blocked = Bitmap(12, 9);
  for (const auto& [x, y] : {std::pair{3U, 4U}, {8U, 4U}, {5U, 6U}, {6U, 6U}}) scene.map->blocked.set(x, y);
  Scene walls = scene;
  add_map_walls(walls, {});
  walls.map.reset();
  const std::vector<Vec2> bar{{-1, -0.1}, {1, -0.1}, {1, 0.1}, {-1, 0.1}};
  for (const Vec2 in_cells : {Vec2{5.0, 4.5}, Vec2{2.0, 2.0}, Vec2{10.5, 8.0}}) {
    const Vec2 place = world_point(*scene.map, in_cells);
    const auto of_map = free_headings(scene, bar, place, 0.01, {});
    const auto of_walls = free_headings(walls, bar, place, 0.01, {});
    ASSERT_EQ(of_map.size(), of_walls.size());
    for (std::size_t i = 0; i < of_map.size(); ++i) {
      EXPECT_NEAR(of_map[i].low, of_walls[i].low, 1e-9);
      EXPECT_NEAR(of_map[i].width, of_walls[i].width, 1e-9);
    }
  }
}

}  // namespace
}  // namespace warren
