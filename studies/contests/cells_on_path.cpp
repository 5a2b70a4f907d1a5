// SPDX-License-Identifier: BSD-3-Clause
#include "studies/contests/cells_on_path.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace warren::studies {

std::uint64_t cells_passed(std::span<const Vec2> path, const Raster& raster) {
  if (path.empty()) return 0;
  const auto index = [&](double at, double from) {
    return static_cast<std::int64_t>(std::llround((at - from) / raster.cell));
  };
  std::int64_t steps = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const std::int64_t dx = index(path[i].x, raster.origin.x) - index(path[i - 1].x, raster.origin.x);
    const std::int64_t dy = index(path[i].y, raster.origin.y) - index(path[i - 1].y, raster.origin.y);
    steps += std::max(std::abs(dx), std::abs(dy));
  }
  return static_cast<std::uint64_t>(steps) + 1;
}

std::uint64_t cells_passed(std::span<const Vec2> path, const OccupancyMap& map) {
  std::vector<Vec2> in_cells;
  for (const Vec2 p : path) in_cells.push_back(map_point(map, p));
  return cells_passed(in_cells, Raster{{0.5, 0.5}, 1.0});
}

}  // namespace warren::studies
