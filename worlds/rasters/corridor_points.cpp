// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/corridor_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/rng.hpp"
#include "core/base/whole.hpp"

namespace warren {
namespace {

constexpr std::uint64_t first_axis = 8;  // of the random numbers; those below are the uniform sample's

/// A way from the middle of a ridge cell towards a random one beside it, half a cell at most in each coordinate.
Vec2 along(const CorridorCells& cells, Cell cell, std::uint64_t seed, std::uint64_t index) {
  std::array<Vec2, 8> ways;
  std::size_t count = 0;
  for (const auto& [dx, dy] : cell_steps) {
    if (cells.holds(std::int64_t{cell.x} + dx, std::int64_t{cell.y} + dy)) {
      ways[count++] = {static_cast<double>(dx), static_cast<double>(dy)};
    }
  }
  if (count == 0) return {};
  const auto chosen = bounded_whole<std::size_t>(uniform(seed, index, first_axis + 1) * static_cast<double>(count));
  return 0.5 * uniform(seed, index, first_axis + 2) * ways[chosen];
}

}  // namespace

CorridorPoints::CorridorPoints(const OccupancyMap& map, const DistanceField& field, double reach,
                               const Execution& execution)
    : cells_(field, reach, execution), reach_(reach) {
  place_.cell = map.cell;
  place_.origin = map.origin;
  place_.yaw_rad = map.yaw_rad;
}

Vec2 CorridorPoints::at(std::uint64_t seed, std::uint64_t index) const {
  constexpr double golden = 0.6180339887498949;
  constexpr double most_aside = 0.1;  // cells, in each coordinate
  const double turn = uniform(seed, 0, first_axis) + golden * static_cast<double>(index % (std::uint64_t{1} << 40));
  const CorridorCells::Place place = cells_.at(turn - std::floor(turn));
  const double aside = std::clamp(0.5 * (place.distance - reach_), 0.0, most_aside);
  const Vec2 way = along(cells_, place.cell, seed, index);
  const auto coordinate = [&](std::uint32_t cell, double along_it, std::uint64_t axis) {
    return cell + 0.5 + along_it + aside * (2.0 * uniform(seed, index, first_axis + axis) - 1.0);
  };
  return world_point(place_, {coordinate(place.cell.x, way.x, 3), coordinate(place.cell.y, way.y, 4)});
}

}  // namespace warren
