// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/judged_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

/// What of a scene can be in a body's way.
struct SceneParts {
  bool walls, polygons, bounds, map, spheres, boxes, solids;

  explicit SceneParts(const Scene& scene) {
    // Every member by its name, so that one more in Scene does not compile before it is said here what it means.
    const auto& [scene_walls, scene_polygons, seams, scene_spheres, scene_boxes, scene_solids, scene_bounds, clearance,
                 maze, formula, packed, robot, arm, start, goal, other_goals, named_start, named_goals, goal_pose, grid,
                 prices, scene_map, source] = scene;
    walls = scene_walls.size() > 0;      // where they are left out there are none: judged by verify_among_cells alone
    polygons = !scene_polygons.empty();  // the seams lie between them
    bounds = scene_bounds.has_value();
    map = scene_map.has_value();
    spheres = !scene_spheres.empty();
    boxes = !scene_boxes.empty();
    solids = !scene_solids.empty();
  }
};

[[noreturn]] void refuse(const Scene& scene, std::string_view what) {
  throw InputError(scene.source.empty() ? "world" : scene.source, what);
}

/// Is there a blocked cell on one side of the piece of the wall from (x, y) one cell further, or the rim of the map?
bool borders_blocked(const OccupancyMap& map, std::int64_t x, std::int64_t y, bool level) {
  const auto blocked = [&](std::int64_t column, std::int64_t row) {
    if (column < 0 || row < 0 || column >= map.width() || row >= map.height()) return true;
    return map.blocked.holds(column, row);
  };
  return blocked(x, y) || (level ? blocked(x, y - 1) : blocked(x - 1, y));
}

/// Does the wall run along sides of blocked cells, where a judge of the cells sees it?
bool runs_along_blocked(const OccupancyMap& map, const Segment& wall) {
  const double most = 2.0 + std::max(map.width(), map.height());
  std::int64_t ends[2][2];
  int number = 0;
  for (const Vec2 end : {wall.a, wall.b}) {
    const Vec2 p = map_point(map, end);
    const double rounding = 1e-6 + 4e-15 * (norm(end) + norm(map.origin)) / map.cell;  // cells
    if (!(std::abs(p.x) <= most && std::abs(p.y) <= most)) return false;
    if (std::abs(p.x - std::round(p.x)) > rounding || std::abs(p.y - std::round(p.y)) > rounding) return false;
    ends[number][0] = bounded_whole<std::int64_t>(std::round(p.x));
    ends[number++][1] = bounded_whole<std::int64_t>(std::round(p.y));
  }
  const bool level = ends[0][1] == ends[1][1];
  if (!level && ends[0][0] != ends[1][0]) return false;
  const int axis = level ? 0 : 1;
  const auto [first, last] = std::minmax(ends[0][axis], ends[1][axis]);
  for (std::int64_t i = first; i < last; ++i) {
    if (!(level ? borders_blocked(map, i, ends[0][1], true) : borders_blocked(map, ends[0][0], i, false))) return false;
  }
  return true;
}

/// Walls beside a map are its borders and no obstacles more (worlds/rasters/lattice_polygons.hpp).
void check_walls_of_map(const Scene& scene, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 12;
  const std::size_t count = scene.walls.size();
  const std::size_t i = first_that(count, grain, execution.quiet(), [&](std::size_t wall) {
    return !runs_along_blocked(*scene.map, scene.walls.segment(wall));
  });
  if (i < count) refuse(scene, fmt::format("wall {} runs over free cells of the map: the map is judged alone", i));
}

}  // namespace

void check_plane_scene(const Scene& scene, const Execution& execution) {
  const SceneParts parts(scene);
  const char* high = parts.spheres ? "spheres" : parts.boxes ? "boxes" : parts.solids ? "solids" : nullptr;
  if (high != nullptr) {
    refuse(scene, fmt::format("has {}, which only arms can meet: bodies in the plane are not judged among them", high));
  }
  if (parts.map && (parts.polygons || parts.bounds)) {
    refuse(scene, parts.polygons ? "has polygons beside a map: the map is judged alone"
                                 : "has bounds beside a map: the map is judged alone");
  }
  if (parts.map && parts.walls) check_walls_of_map(scene, execution);
  if (parts.walls || parts.polygons || parts.bounds || parts.map) return;
  refuse(scene, "has neither obstacles nor bounds: nothing confines the body");
}

void check_space_scene(const Scene& scene) {
  const SceneParts parts(scene);
  const char* flat = parts.walls      ? "walls"
                     : parts.polygons ? "polygons"
                     : parts.bounds   ? "bounds"
                     : parts.map      ? "a map"
                                      : nullptr;
  if (flat == nullptr) return;
  refuse(scene, fmt::format("has {}, which have no height: arms are judged among spheres and boxes", flat));
}

void check_not_negative(std::string_view name, double value) {
  if (value >= 0.0 && value <= largest_coordinate) return;
  throw InputError(name, "must be a number from 0 to 1e60", fmt::format("{}", value));
}

void check_outline(std::span<const Vec2> outline) {
  if (!outline.empty() && outline.size() < 3) throw InputError("robot", "a polygon needs three corners or more");
  for (const Vec2 p : outline) {
    if (std::abs(p.x) <= largest_coordinate && std::abs(p.y) <= largest_coordinate) continue;
    throw InputError("robot", "must have corners of at most 1e60", fmt::format("{} {}", p.x, p.y));
  }
}

}  // namespace warren
