// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/map_borders.hpp"

#include <bit>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "spatial/maps/free_cells.hpp"
#include "worlds/rasters/convex_pieces.hpp"
#include "worlds/rasters/polygons_on_lattice.hpp"

namespace warren {
namespace {

/// Calls add(y, from, to) for each longest run of borders between rows y - 1 and y.
template <class Add>
void for_borders_between_rows(const Bitmap& blocked, const Execution& execution, const Add& add) {
  const std::size_t words = blocked.empty() ? 0 : blocked.row(0).size();
  const auto solid = [&](std::int64_t y, std::size_t w) {
    if (y < 0 || y >= blocked.height()) return ~std::uint64_t{0};
    const std::uint64_t beyond =
        w + 1 == words && blocked.width() % 64 != 0 ? ~std::uint64_t{0} << blocked.width() % 64 : 0;
    return blocked.row(as_whole<std::uint32_t>(y))[w] | beyond;
  };
  for (std::int64_t y = 0; y <= blocked.height(); ++y) {
    if (y % 16 == 0) execution.check();
    std::int64_t first = -1;  // of the run that is open
    for (std::size_t w = 0; w < words; ++w) {
      std::uint64_t differs = solid(y - 1, w) ^ solid(y, w);
      const auto base = as_whole<std::int64_t>(64 * w);
      std::int64_t x = 0;
      while (x < 64) {
        const auto next = as_whole<std::int64_t>(first < 0 ? std::countr_zero(differs) : std::countr_one(differs));
        if (x + next >= 64) break;
        x += next;
        differs >>= next;
        if (first < 0) {
          first = base + x;
        } else {
          add(y, first, base + x);
          first = -1;
        }
      }
    }
    if (first >= 0) add(y, first, std::int64_t{blocked.width()});
  }
}

}  // namespace

std::vector<Segment> border_walls(const OccupancyMap& map, const Execution& execution) {
  std::vector<Segment> walls;
  const auto point = [&](std::int64_t x, std::int64_t y) {
    return world_point(map, {static_cast<double>(x), static_cast<double>(y)});
  };
  for_borders_between_rows(map.blocked, execution, [&](std::int64_t y, std::int64_t from, std::int64_t to) {
    walls.push_back({point(from, y), point(to, y)});
  });
  for_borders_between_rows(transposed(map.blocked, execution), execution,
                           [&](std::int64_t x, std::int64_t from, std::int64_t to) {
                             walls.push_back({point(x, from), point(x, to)});
                           });
  return walls;
}

void add_map_walls(Scene& scene, const Execution& execution) {
  if (scene.map && scene.walls.size() == 0) scene.walls = WallSet::narrowest(border_walls(*scene.map, execution));
}

OccupancyMap map_of_scene(const Scene& scene, double cell, const Execution& execution) {
  if (!(cell > 0.0) || !std::isfinite(cell)) throw InputError("cell", "must be above 0", std::to_string(cell));
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene, execution);
  if (box.empty()) throw InputError("world", "has neither walls nor bounds: nothing to draw as cells");
  constexpr double rounding = 1e-9;
  const double width = std::max(1.0, std::ceil(box.width() / cell - rounding));
  const double height = std::max(1.0, std::ceil(box.height() / cell - rounding));
  constexpr double too_many = 4294967295.0;
  if (!(width < too_many && height < too_many)) throw InputError("cell", "is too small for this world");
  check_map_size("cell", bounded_whole<std::uint64_t>(width), bounded_whole<std::uint64_t>(height));
  execution.reserve(bounded_whole<std::size_t>(width * height / 8));
  OccupancyMap map;
  map.source = scene.source;
  map.cell = cell;
  map.origin = box.min;
  // A cell is the square around its middle, and the middles are the lattice.
  LatticeMarking marking(box.min + Vec2{cell / 2, cell / 2}, cell, bounded_whole<std::uint32_t>(width),
                         bounded_whole<std::uint32_t>(height));
  const double half = cell / 2;
  const ConvexPiece square{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  const auto mark = [&](const Segment& s) { marking.mark_near(touching_positions(square, s), 0.0); };
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    if (i % 64 == 0) execution.check();
    mark(scene.walls.segment(i));
  }
  for (const ScenePolygon& polygon : scene.polygons) {
    execution.check();
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      mark({polygon.corners[i], polygon.corners[(i + 1) % polygon.corners.size()]});
    }
    marking.mark_inside(polygon.corners, {0.0, 0.0}, execution);
  }
  map.blocked = marking.take();
  map.occupied = map.blocked.count();
  map.free = map.blocked.size() - map.occupied;
  return map;
}

}  // namespace warren
