// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/scene/occupancy_map.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/plane/se2.hpp"

namespace warren {
namespace {

Vec2 turned(Vec2 p, double angle_rad) { return angle_rad == 0.0 ? p : Rotation(angle_rad)(p); }

}  // namespace

Vec2 world_point(const OccupancyMap& map, Vec2 in_cells) {
  return map.origin + turned(map.cell * in_cells, map.yaw_rad);
}

Vec2 map_point(const OccupancyMap& map, Vec2 in_world) {
  const Vec2 p = turned(in_world - map.origin, -map.yaw_rad);
  return {p.x / map.cell, p.y / map.cell};
}

Vec2 cell_centre(const OccupancyMap& map, Cell cell) { return world_point(map, {cell.x + 0.5, cell.y + 0.5}); }

Box world_box(const OccupancyMap& map, const Box& in_cells) {
  Box box;
  for (const Vec2 corner : in_cells.corners()) box.include(world_point(map, corner));
  return box;
}

Box world_box(const OccupancyMap& map) { return world_box(map, {{0.0, 0.0}, {1.0 * map.width(), 1.0 * map.height()}}); }

std::optional<Cell> cell_at(const OccupancyMap& map, Vec2 in_world) {
  const Vec2 p = map_point(map, in_world);
  if (!(p.x >= 0.0 && p.y >= 0.0 && p.x < map.width() && p.y < map.height())) return std::nullopt;
  return Cell{static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y)};
}

Bitmap cell_bitmap(std::uint32_t width, std::uint32_t height, const Execution& execution) {
  execution.reserve(Bitmap::bytes_for(width, height));
  return {width, height, false, [&] { execution.check(); }};
}

void check_map_size(const std::string& where, std::uint64_t width, std::uint64_t height) {
  constexpr std::uint64_t side_end = std::uint64_t{1} << 31;
  constexpr std::uint64_t cells_end = std::uint64_t{1} << 32;
  if (width < 1 || height < 1 || width >= side_end || height >= side_end || width * height >= cells_end) {
    throw InputError(where, "a map has 1 to 2^32 - 1 cells", fmt::format("{} x {}", width, height));
  }
}

}  // namespace warren
