// SPDX-License-Identifier: BSD-3-Clause
#include "tests/matrix/matrix_worlds.hpp"

#include <cstdlib>

#include "tests/matrix/world_files.hpp"

namespace warren::test {
namespace {

constexpr double width = 8.0;
constexpr double height = 6.0;
const Ring whole{{0, 0}, {width, 0}, {width, height}, {0, height}};

MatrixWorld plane_world(const std::string& name) {
  MatrixWorld world;
  world.name = name;
  world.kind = "plane";
  world.start = {1.0, 1.0, 0.0};
  world.goal = {6.8, 5.0, 0.6};
  return world;
}

MatrixWorld walls_world() {
  MatrixWorld world = plane_world("walls");
  world.plane.walls = {{{0, 0}, {0.5, 0}},   {{8, 6}, {7.5, 6}},     {{2.5, 0}, {2.5, 3.5}}, {{2.5, 3.5}, {1.5, 4.2}},
                       {{5, 6}, {5, 2}},     {{3.2, 4.5}, {4, 4.5}}, {{6, 1}, {6, 1}},       {{6.2, 2}, {7.5, 3}},
                       {{7.5, 2}, {7.5, 3}}, {{3, 1}, {4, 1}},       {{4, 1}, {4.5, 1.5}}};
  world.files = {{"walls.txt", scene_of(world)}};
  return world;
}

MatrixWorld bounds_world() {
  MatrixWorld world = plane_world("bounds");
  world.plane.rim = whole;
  world.clearance = 0.05;
  world.files = {{"bounds.scene", scene_of(world)}};
  return world;
}

MatrixWorld polygons_world() {
  MatrixWorld world = plane_world("polygons");
  world.plane.rim = whole;
  world.plane.regions = {{{{2, 0}, {3, 0}, {3, 3}, {4, 3}, {4, 4}, {2, 4}}},
                         {{{5, 2}, {6, 2}, {6, 6}, {5, 6}}},
                         {{{6, 2}, {7, 2.5}, {6, 3}}},
                         {{{4, 0.2}, {5, 0.8}, {4.2, 1.4}}}};
  world.files = {{"polygons.scene", scene_of(world)}};
  return world;
}

/// A room is the hole of a block, and two pillars stand in it, one with a court.
MatrixWorld holes_world() {
  MatrixWorld world = plane_world("holes");
  world.plane.regions = {
      {whole, {{0.3, 0.3}, {7.7, 0.3}, {7.7, 5.7}, {4, 5.7}, {4, 4.5}, {3.5, 4.5}, {3.5, 5.7}, {0.3, 5.7}}},
      {{{2, 1.2}, {4.4, 1.2}, {4.4, 3.2}, {2, 3.2}}, {{2.4, 1.6}, {4, 1.6}, {4, 2.8}, {2.4, 2.8}}},
      {{{5.5, 1.5}, {6.3, 1.5}, {6.0, 3.2}}}};
  world.clearance = 0.02;
  world.files = {{"holes.geojson", geojson_of(world)}};
  return world;
}

MatrixWorld maze_world() {
  MatrixWorld world = plane_world("maze");
  world.start = {1.0, 1.0, 0.0};
  world.goal = {4.0, 3.0, 0.6};
  world.body_scale = 0.4;
  world.plane.walls = {{{0.5, 0.5}, {4.5, 0.5}}, {{4.5, 0.5}, {4.5, 3.5}}, {{4.5, 3.5}, {0.5, 3.5}},
                       {{0.5, 3.5}, {0.5, 0.5}}, {{1.5, 0.5}, {1.5, 2.5}}, {{2.5, 1.5}, {2.5, 3.5}},
                       {{3.5, 1.5}, {4.5, 1.5}}, {{3.5, 2.5}, {3.5, 3.5}}};
  world.files = {{"maze.scene", "maze 3 4\n" + scene_of(world)}};
  return world;
}

const MapRows rooms{"................", "................", "....@@.....@....", "....@@.....@....",
                    "....@......@....", "....@......@....", "....@......@....", "....@...@@@@....",
                    "....@...@.......", "....@...@.......", "........@.......", "................"};
const MapRows half_known{"????............", "????......@@....", "....@@....@@....", "....@@....@@....",
                         "....@@....@@....", "....??....@@....", "....??....@@....", "....??..........",
                         "....??..........", "....??....?@....", "..........??....", "..........??...."};

MatrixWorld moving_ai_world() {
  MatrixWorld world = plane_world("map");
  world.kind = "map";
  world.start = {2.0, 2.0, 0.0};
  world.goal = {13.6, 10.0, 0.6};
  world.plane = cells_of(rooms, {});
  world.files = {{"rooms.map", moving_ai_of(rooms)}};
  return world;
}

MatrixWorld ros_world(const std::string& name, const MapRows& rows, const MapPlace& place) {
  MatrixWorld world = plane_world(name);
  world.kind = "map";
  const PlanePoint start = place.at(2, 2);
  const PlanePoint goal = place.at(13.6, 10);
  world.start = {start.x, start.y, 0.0};
  world.goal = {goal.x, goal.y, 0.6};
  world.plane = cells_of(rows, place);
  world.clearance = 0.03;
  world.files = {{"map.yaml", yaml_of("map.pgm", place)}, {"map.pgm", pgm_of(rows)}};
  return world;
}

/// Between an arm's start and its goal.
MatrixWorld space_world(const std::string& name, const SpaceObstacles& solids) {
  MatrixWorld world = plane_world(name);
  world.kind = "space";
  world.space = solids;
  world.files = {{name + ".scene", scene_of(world)}};
  return world;
}

/// The file is MoveIt's.
MatrixWorld moveit_world() {
  MatrixWorld world =
      space_world("moveit", {.spheres = {{0.55, 0.0, 0.1, 0.12}}, .boxes = {{-0.6, -0.6, -0.6, -0.5, 0.6, 0.4}}});
  world.files = {{"moveit.yaml", moveit_of(world)}};
  return world;
}

MatrixWorld mixed_world() {
  MatrixWorld world = polygons_world();
  world.name = "boxes_and_polygons";
  world.kind = "mixed";
  world.space.boxes = {{3.5, 0.5, 0, 4.5, 5.5, 1}};
  world.files = {{"mixed.scene", scene_of(world)}};
  return world;
}

MatrixWorld empty_world() {
  MatrixWorld world = plane_world("empty");
  world.kind = "empty";
  world.files = {{"empty.scene", "start 1 1 0\n"}};
  return world;
}

}  // namespace

std::vector<MatrixWorld> matrix_worlds() {
  const MapPlace half{.cell = 0.5, .origin = {-1.0, 2.0}, .yaw = 0.0};
  const MapPlace turned{.cell = 0.5, .origin = {3.0, -1.0}, .yaw = 0.7};
  std::vector<MatrixWorld> worlds{
      walls_world(),
      bounds_world(),
      polygons_world(),
      holes_world(),
      maze_world(),
      moving_ai_world(),
      ros_world("map_with_unknown_cells", half_known, half),
      ros_world("map_with_yaw", rooms, turned),
      space_world("spheres", {.spheres = {{0.55, 0.0, 0.1, 0.12}, {0.0, 0.5, -0.3, 0.1}}}),
      space_world("boxes", {.boxes = {{0.45, -0.1, -0.2, 0.6, 0.1, 0.25}, {-0.6, -0.6, -0.6, -0.5, 0.6, 0.4}}}),
      moveit_world(),
      mixed_world(),
      empty_world()};
  const char* seeds = std::getenv("WARREN_MATRIX_SEEDS");
  const std::uint64_t count = seeds == nullptr ? 0 : std::strtoull(seeds, nullptr, 10);
  for (std::uint64_t seed = 1; seed <= count; ++seed) worlds.push_back(strange_world(seed));
  return worlds;
}

}  // namespace warren::test
