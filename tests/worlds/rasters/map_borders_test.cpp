// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/lattice_polygons.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"

namespace warren {
namespace {

OccupancyMap speckled_map(std::uint64_t seed) {
  OccupancyMap map;
  const std::uint64_t columns = seed % 6 == 5 ? 64 : 1 + random_bits(seed, 0, 0) % 140;  // a row of whole words, too
  const auto width = static_cast<std::uint32_t>(columns);
  const auto height = static_cast<std::uint32_t>(1 + random_bits(seed, 0, 1) % 9);
  map.blocked = Bitmap(width, height);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      if (uniform(seed, 1 + x, y) < uniform(seed, 0, 2)) map.blocked.set(x, y);
    }
  }
  return map;
}

using UnitSide = std::tuple<int, int, bool>;  // lower left end, upright?

/// By definition: every side between a blocked and a free cell.
std::multiset<UnitSide> unit_sides(const OccupancyMap& map) {
  std::multiset<UnitSide> sides;
  const auto solid = [&](int x, int y) {
    return x < 0 || y < 0 || x >= static_cast<int>(map.width()) || y >= static_cast<int>(map.height()) ||
           map.blocked.holds(x, y);
  };
  for (int y = 0; y <= static_cast<int>(map.height()); ++y) {
    for (int x = 0; x <= static_cast<int>(map.width()); ++x) {
      if (x < static_cast<int>(map.width()) && solid(x, y) != solid(x, y - 1)) sides.emplace(x, y, false);
      if (y < static_cast<int>(map.height()) && solid(x, y) != solid(x - 1, y)) sides.emplace(x, y, true);
    }
  }
  return sides;
}

TEST(BorderWalls, AreTheBordersOfFreeCellsInLongestRuns) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = speckled_map(seed);
    std::multiset<UnitSide> covered;
    std::set<std::tuple<double, double, bool>> begins;
    std::set<std::tuple<double, double, bool>> ends;
    for (const Segment& s : border_walls(map, {})) {
      const bool upright = s.a.x == s.b.x;
      ASSERT_TRUE(upright || s.a.y == s.b.y);
      const double length = distance(s.a, s.b);
      ASSERT_GE(length, 1.0);
      for (int i = 0; i < static_cast<int>(length); ++i) {
        covered.emplace(static_cast<int>(s.a.x) + (upright ? 0 : i), static_cast<int>(s.a.y) + (upright ? i : 0),
                        upright);
      }
      begins.emplace(s.a.x, s.a.y, upright);
      ends.emplace(s.b.x, s.b.y, upright);
    }
    EXPECT_EQ(covered, unit_sides(map));
    for (const auto& end : ends) EXPECT_FALSE(begins.contains(end)) << "two walls in a row could be one";
  }
}

TEST(BorderWalls, StandWhereTheMapStands) {
  OccupancyMap map;
  map.blocked = Bitmap(2, 1);
  map.blocked.set(0, 0);
  map.cell = 0.5;
  map.origin = {10, 20};
  map.yaw_rad = std::acos(0.0);
  for (const Segment& s : border_walls(map, {})) {
    for (const Vec2 p : {s.a, s.b}) {
      EXPECT_GE(p.x, 9.5 - 1e-9);
      EXPECT_LE(p.x, 10.0 + 1e-9);
      EXPECT_GE(p.y, 20.5 - 1e-9);  // the free cell is the second along x, which points up
      EXPECT_LE(p.y, 21.0 + 1e-9);
    }
  }
  Scene scene;
  scene.map = map;
  add_map_walls(scene, {});
  EXPECT_EQ(scene.walls.size(), 4U);
}

TEST(MapOfScene, BlocksTheCellsWhoseClosedSquaresAreTouched) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {10, 6}};
  const std::vector<Segment> walls{{{2, 1}, {2, 3}}, {{4.5, 0.5}, {7.25, 0.5}}};
  scene.walls = WallSet::narrowest(walls);
  scene.polygons.push_back({{{5.5, 2.5}, {9.5, 2.5}, {9.5, 5.5}, {5.5, 5.5}}, 0});
  const OccupancyMap map = map_of_scene(scene, 1.0, {});
  ASSERT_EQ(map.width(), 10U);
  ASSERT_EQ(map.height(), 6U);
  for (std::uint32_t y = 0; y < 6; ++y) {
    for (std::uint32_t x = 0; x < 10; ++x) {
      const bool first = (x == 1 || x == 2) && y <= 3;  // on the border of two columns, and touching at the ends
      const bool second = x >= 4 && x <= 7 && y == 0;
      const bool polygon = x >= 5 && y >= 2;
      EXPECT_EQ(map.blocked.test(x, y), first || second || polygon) << x << " " << y;
    }
  }
  EXPECT_EQ(map.free + map.occupied, 60U);
  EXPECT_THROW(map_of_scene(scene, 0.0, {}), InputError);
  EXPECT_THROW(map_of_scene(scene, 1e-9, {}), InputError);
  EXPECT_THROW(map_of_scene(Scene{}, 1.0, {}), InputError);
}

}  // namespace
}  // namespace warren
