// SPDX-License-Identifier: BSD-3-Clause
#include "tests/matrix/matrix_worlds.hpp"

#include <cmath>
#include <sstream>

namespace warren::test {
namespace {

constexpr double width = 8.0;
constexpr double height = 6.0;
const Ring whole{{0, 0}, {width, 0}, {width, height}, {0, height}};

std::string text_of(const Ring& ring) {
  std::ostringstream text;
  for (const PlanePoint p : ring) text << ' ' << p.x << ' ' << p.y;
  return text.str();
}

/// Everything that a world holds, as a scene; its regions are polygons without holes.
std::string scene_of(const MatrixWorld& world) {
  std::ostringstream text;
  if (!world.plane.rim.empty()) text << "bounds 0 0 " << width << ' ' << height << '\n';
  for (const auto& [a, b] : world.plane.walls) text << a.x << ' ' << a.y << ' ' << b.x << ' ' << b.y << '\n';
  for (const Region& region : world.plane.regions) text << "polygon" << text_of(region.front()) << '\n';
  for (const auto& [x, y, z, r] : world.space.spheres) {
    text << "sphere " << x << ' ' << y << ' ' << z << ' ' << r << '\n';
  }
  for (const auto& box : world.space.boxes) {
    text << "box";
    for (const double x : box) text << ' ' << x;
    text << '\n';
  }
  return text.str();
}

std::string json_of(const Ring& ring) {
  std::ostringstream text;
  text << '[';
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    const PlanePoint p = ring[i % ring.size()];
    text << (i == 0 ? "" : ", ") << '[' << p.x << ", " << p.y << ']';
  }
  text << ']';
  return text.str();
}

/// The regions as GeoJSON, which can say holes.
std::string geojson_of(const MatrixWorld& world) {
  std::string text = R"({"type": "FeatureCollection", "features": [)";
  for (std::size_t i = 0; i < world.plane.regions.size(); ++i) {
    text += i == 0 ? "" : ",\n ";
    text += R"({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [)";
    const Region& region = world.plane.regions[i];
    for (std::size_t k = 0; k < region.size(); ++k) text += (k == 0 ? "" : ", ") + json_of(region[k]);
    text += "]}}";
  }
  if (!world.plane.rim.empty()) {
    text +=
        R"(, {"type": "Feature", "properties": {"role": "bounds"}, "geometry": {"type": "Polygon", "coordinates": [)" +
        json_of(world.plane.rim) + "]}}";
  }
  return text + "]}\n";
}

/// Rows from the top: `.` is free, all else is blocked; `?` unknown.
using MapRows = std::vector<std::string>;

struct MapPlace {
  double cell = 1.0;
  PlanePoint origin;
  double yaw = 0.0;

  PlanePoint at(double column, double row) const {
    const double x = column * cell;
    const double y = row * cell;
    return {origin.x + std::cos(yaw) * x - std::sin(yaw) * y, origin.y + std::sin(yaw) * x + std::cos(yaw) * y};
  }
};

PlaneObstacles cells_of(const MapRows& rows, const MapPlace& place) {
  PlaneObstacles plane;
  const auto square = [&](double x, double y, double w, double h) {
    return Ring{place.at(x, y), place.at(x + w, y), place.at(x + w, y + h), place.at(x, y + h)};
  };
  const std::size_t count = rows.size();
  plane.rim = square(0, 0, static_cast<double>(rows.front().size()), static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      if (rows[i][k] == '.') continue;
      plane.regions.push_back({square(static_cast<double>(k), static_cast<double>(count - 1 - i), 1, 1)});
    }
  }
  return plane;
}

std::string moving_ai_of(const MapRows& rows) {
  std::ostringstream text;
  text << "type octile\nheight " << rows.size() << "\nwidth " << rows.front().size() << "\nmap\n";
  for (const std::string& row : rows) text << row << '\n';
  return text.str();
}

std::string pgm_of(const MapRows& rows) {
  std::ostringstream text;
  text << "P2\n" << rows.front().size() << ' ' << rows.size() << "\n255\n";
  for (const std::string& row : rows) {
    for (const char c : row) text << (c == '.' ? "254 " : c == '?' ? "205 " : "0 ");
    text << '\n';
  }
  return text.str();
}

std::string yaml_of(const std::string& image, const MapPlace& place) {
  std::ostringstream text;
  text << "image: " << image << "\nresolution: " << place.cell << "\norigin: [" << place.origin.x << ", "
       << place.origin.y << ", " << place.yaw << "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  return text.str();
}

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
  return {walls_world(),
          bounds_world(),
          polygons_world(),
          holes_world(),
          maze_world(),
          moving_ai_world(),
          ros_world("map_with_unknown_cells", half_known, half),
          ros_world("map_with_yaw", rooms, turned),
          space_world("spheres", {.spheres = {{0.55, 0.0, 0.1, 0.12}, {0.0, 0.5, -0.3, 0.1}}}),
          space_world("boxes", {.boxes = {{0.45, -0.1, -0.2, 0.6, 0.1, 0.25}, {-0.6, -0.6, -0.6, -0.5, 0.6, 0.4}}}),
          mixed_world(),
          empty_world()};
}

}  // namespace warren::test
