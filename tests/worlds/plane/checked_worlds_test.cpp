// SPDX-License-Identifier: BSD-3-Clause
// What every world of polygons assumes of them, it checks, whoever made the scene.
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/refusals.hpp"
#include "worlds/plane/polygon_world.hpp"
#include "worlds/poses/car_world.hpp"
#include "worlds/poses/obstacle_tree.hpp"
#include "worlds/poses/se2_world.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

using Outline = std::vector<Vec2>;

const Outline square{{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}};

std::vector<Outline> bad_outlines() {
  return {{},
          {{1, 1}},
          {{1, 1}, {2, 2}},
          {{1, 1}, {2, 2}, {1, 1}},           // two different corners
          {{1, 1}, {2, 2}, {3, 3}},           // no area
          {{1, 1}, {2, 2}, {2, 1}, {1, 2}},   // crosses itself
          {{1, 1}, {3, 1}, {3, 3}, {2, 1}}};  // touches itself
}

Scene scene_with(const Outline& outline) {
  Scene scene;
  scene.source = "a.scene";
  scene.bounds = Box{{0, 0}, {4, 4}};
  scene.polygons.push_back({outline, 7});
  return scene;
}

/// make() throws an InputError that names the place.
template <class Make>
void expect_refusal(const Make& make, const std::string& place) {
  const std::string said = test::refusal<InputError>(make);
  EXPECT_NE(said.find(place), std::string::npos) << said;
}

TEST(CheckedWorlds, RefuseObstaclesThatAreNoSimplePolygonsByTheirLine) {
  for (const Outline& outline : bad_outlines()) {
    const Scene scene = scene_with(outline);
    SCOPED_TRACE(outline.size());
    expect_refusal([&] { ObstacleTree(scene, 1.0); }, "a.scene:7");
    expect_refusal([&] { Se2World(scene, square, {}); }, "a.scene:7");
    expect_refusal([&] { CarWorld<DubinsCurve>(scene, {.outline = square}); }, "a.scene:7");
    expect_refusal([&] { translation_obstacles(scene, square, 0.0, 0.1); }, "a.scene:7");
  }
}

TEST(CheckedWorlds, RefuseBodiesThatAreNoSimplePolygons) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {4, 4}};
  for (const Outline& outline : bad_outlines()) {
    SCOPED_TRACE(outline.size());
    expect_refusal([&] { Se2World(scene, outline, {}); }, "robot");
    expect_refusal([&] { translation_obstacles(scene, outline, 0.0, 0.1); }, "robot");
    if (outline.empty()) continue;  // a car without an outline is a disc
    expect_refusal([&] { CarWorld<DubinsCurve>(scene, {.outline = outline}); }, "robot");
  }
}

TEST(CheckedWorlds, TakeRepeatedCornersAndCornersOnStraightSides) {
  const Scene scene = scene_with({{1, 1}, {1, 1}, {2, 1}, {3, 1}, {3, 3}, {1, 3}, {1, 1}});
  const Se2World world(scene, square, {});
  auto query = world.make_query();
  EXPECT_FALSE(world.is_free({2.0, 2.0, 0.0}, query));
  EXPECT_FALSE(world.is_free({2.0, 0.95, 0.0}, query));
  EXPECT_TRUE(world.is_free({2.0, 0.5, 0.3}, query));
}

/// Nine cells of side 1, the middle one blocked.
Scene map_with_a_block() {
  Scene scene;
  scene.map.emplace();
  scene.map->blocked = Bitmap(3, 3);
  scene.map->blocked.set(1, 1);
  add_map_walls(scene, {});
  return scene;
}

TEST(CarWorld, InsideOfABlockOfAMapIsNotFree) {
  const Scene scene = map_with_a_block();
  for (const CarOptions& car :
       {CarOptions{.radius = 0.1}, CarOptions{.outline = {{0.2, -0.1}, {0.4, -0.1}, {0.3, 0.1}}}}) {
    const CarWorld<DubinsCurve> world(scene, car);
    auto query = world.make_query();
    EXPECT_FALSE(world.is_free({1.3, 1.5, 0.0}, query)) << "wholly among blocked cells, away from their borders";
    EXPECT_TRUE(world.is_free({0.4, 0.5, 0.0}, query));
    EXPECT_FALSE(world.is_free({4.5, 0.5, 0.0}, query)) << "outside of the map";
  }
}

}  // namespace
}  // namespace warren
