// SPDX-License-Identifier: BSD-3-Clause
// Worlds drawn by a seed, on a coarse raster so that they are full of what is rare otherwise: walls of no length, ends
// that meet, sides in line, gaps as wide as the body, ends of the path that are blocked, headings beyond a turn.
#include <algorithm>
#include <cmath>
#include <string>

#include "tests/matrix/matrix_worlds.hpp"
#include "tests/matrix/world_files.hpp"

namespace warren::test {
namespace {

/// SplitMix64.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ULL) {}

  int below(int n) {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return static_cast<int>((z ^ (z >> 31U)) % static_cast<std::uint64_t>(n));
  }
  /// A multiple of a quarter from `low` to `high`, both included.
  double quarter(double low, double high) { return low + 0.25 * below(static_cast<int>((high - low) * 4.0) + 1); }
  bool one_in(int n) { return below(n) == 0; }

 private:
  std::uint64_t state_;
};

/// Walls or a polygon within the slot of side 2 whose lower corner is given, so that no two obstacles cross.
void add_obstacle(Draw& draw, PlanePoint slot, PlaneObstacles& plane) {
  const auto point = [&] { return PlanePoint{slot.x + draw.quarter(0.25, 1.75), slot.y + draw.quarter(0.25, 1.75)}; };
  const PlanePoint p = point();
  switch (draw.below(6)) {
    case 0:
      plane.walls.push_back({p, point()});
      break;
    case 1:
      plane.walls.push_back({p, p});
      break;
    case 2: {  // two that share an end, perhaps in line
      const PlanePoint q = point();
      plane.walls.push_back({p, q});
      plane.walls.push_back({q, {2.0 * q.x - p.x, q.y}});
      if (std::abs(2.0 * q.x - p.x - slot.x - 1.0) > 1.0 || p.y == q.y) plane.walls.pop_back();
      break;
    }
    case 3: {
      const double right = std::min(p.x + 0.25 + 0.25 * draw.below(3), slot.x + 2.0);
      const double high = std::min(p.y + 0.25 + 0.25 * draw.below(3), slot.y + 2.0);
      plane.regions.push_back({{p, {right, p.y}, {right, high}, {p.x, high}}});
      break;
    }
    case 4:  // a hook, with a corner on a straight side
      plane.regions.push_back({{{slot.x, slot.y},
                                {slot.x + 1.0, slot.y},
                                {slot.x + 2.0, slot.y},
                                {slot.x + 2.0, slot.y + 1.5},
                                {slot.x + 1.75, slot.y + 1.5},
                                {slot.x + 1.75, slot.y + 0.25},
                                {slot.x, slot.y + 0.25}}});
      break;
    default:
      break;
  }
}

std::array<double, 3> pose(Draw& draw, double width, double height) {
  constexpr double headings[] = {0.0, 0.6, 3.141592653589793, -3.141592653589793, 1.5707963267948966, 7.0, -2.5};
  return {draw.quarter(0.0, width), draw.quarter(0.0, height), headings[draw.below(std::size(headings))]};
}

MatrixWorld strange_plane(Draw& draw) {
  MatrixWorld world;
  world.kind = "plane";
  if (!draw.one_in(3)) world.plane.rim = {{0, 0}, {8, 0}, {8, 6}, {0, 6}};
  for (int slot = 0; slot < 12; ++slot) add_obstacle(draw, {2.0 * (slot % 4), 2.0 * (slot / 4)}, world.plane);
  world.start = pose(draw, 8, 6);
  world.goal = pose(draw, 8, 6);
  world.clearance = draw.one_in(3) ? 0.05 : 0.0;
  world.body_scale = 0.5 + 0.5 * draw.below(4);
  world.files = {{"strange.scene", scene_of(world)}};
  if (world.plane.walls.empty() && world.plane.regions.empty() && world.plane.rim.empty()) world.kind = "empty";
  return world;
}

MatrixWorld strange_map(Draw& draw) {
  MapRows rows(8 + static_cast<std::size_t>(draw.below(5)), std::string(12, '.'));
  for (std::string& row : rows) {
    for (char& c : row) c = draw.one_in(5) ? (draw.one_in(3) ? '?' : '@') : '.';
  }
  if (draw.one_in(2)) {
    for (std::size_t i = 2; i < 6; ++i) rows[i].replace(3, 4, "@@@@");
  }
  MapPlace place{.cell = 0.5 + 0.25 * draw.below(3), .origin = {-1.0, 2.0}, .yaw = 0.35 * draw.below(5)};
  MatrixWorld world;
  world.kind = "map";
  world.plane = cells_of(rows, place);
  for (auto* end : {&world.start, &world.goal}) {
    *end = pose(draw, 12, static_cast<double>(rows.size()));
    const PlanePoint p = place.at((*end)[0], (*end)[1]);
    *end = {p.x, p.y, (*end)[2]};
  }
  world.clearance = draw.one_in(3) ? 0.05 : 0.0;
  world.body_scale = 0.5 + 0.5 * draw.below(3);
  world.files = {{"map.yaml", yaml_of("map.pgm", place)}, {"map.pgm", pgm_of(rows)}};
  return world;
}

MatrixWorld strange_space(Draw& draw) {
  MatrixWorld world;
  world.kind = "space";
  const auto at = [&] { return draw.quarter(-0.75, 0.75); };
  for (int i = 1 + draw.below(3); i > 0; --i) world.space.spheres.push_back({at(), at(), at(), 0.1});
  for (int i = draw.below(3); i > 0; --i) {
    const std::array<double, 3> low{at(), at(), at()};
    const double side = 0.25 * draw.below(2);
    world.space.boxes.push_back({low[0], low[1], low[2], low[0] + side, low[1] + 0.1, low[2] + side});
  }
  world.clearance = draw.one_in(3) ? 0.02 : 0.0;
  world.files = {{"strange.scene", scene_of(world)}};
  return world;
}

}  // namespace

MatrixWorld strange_world(std::uint64_t seed) {
  Draw draw(seed);
  const int kind = draw.below(5);
  MatrixWorld world = kind == 0 ? strange_space(draw) : kind < 3 ? strange_map(draw) : strange_plane(draw);
  world.name = "strange_" + std::to_string(seed);
  world.is_strange = true;
  return world;
}

}  // namespace warren::test
