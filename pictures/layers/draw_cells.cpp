// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/draw_cells.hpp"

#include <array>
#include <map>
#include <utility>

namespace warren {
namespace {

using CellRun = std::pair<std::uint32_t, std::uint32_t>;  // first column, one past the last

std::vector<CellRun> runs_of(const Bitmap& cells, std::uint32_t y) {
  std::vector<CellRun> runs;
  for (std::uint32_t x = 0; x < cells.width(); ++x) {
    if (!cells.test(x, y)) continue;
    if (runs.empty() || runs.back().second != x) runs.push_back({x, x});
    runs.back().second = x + 1;
  }
  return runs;
}

/// Its blocked cells but the unknown ones.
Bitmap known_of(const OccupancyMap& map, const Execution& execution) {
  execution.reserve(map.blocked.bytes());
  Bitmap known = map.blocked;
  for (std::uint32_t y = 0; y < map.unknown.height(); ++y) {
    execution.check();
    const auto unknown = map.unknown.row(y);
    const auto row = known.row(y);
    for (std::size_t w = 0; w < row.size(); ++w) row[w] &= ~unknown[w];
  }
  return known;
}

}  // namespace

PictureLayer cells_layer(std::string id, std::string label, const Bitmap& cells, const std::function<Vec2(Vec2)>& at,
                         const Execution& execution) {
  PictureLayer layer{.id = std::move(id),
                     .label = std::move(label),
                     .part = Part::world,
                     .width = 0.0,
                     .closed = true,
                     .fill = colors::blocked_cell};
  std::map<CellRun, std::uint32_t> open;  // runs of the rows before, and the row where each began
  const auto close = [&](const CellRun& run, std::uint32_t first, std::uint32_t last) {
    const Vec2 low{static_cast<double>(run.first), static_cast<double>(first)};
    const Vec2 high{static_cast<double>(run.second), static_cast<double>(last)};
    layer.lines.add(std::array{at(low), at({high.x, low.y}), at(high), at({low.x, high.y})});
  };
  for (std::uint32_t y = 0; y < cells.height(); ++y) {
    execution.check();
    std::map<CellRun, std::uint32_t> next;
    for (const CellRun& run : runs_of(cells, y)) {
      const auto found = open.find(run);
      next[run] = found == open.end() ? y : found->second;
    }
    for (const auto& [run, first] : open) {
      if (!next.contains(run)) close(run, first, y);
    }
    open = std::move(next);
  }
  for (const auto& [run, first] : open) close(run, first, cells.height());
  return layer;
}

std::vector<PictureLayer> cells_of_map(const OccupancyMap& map, const Execution& execution) {
  const auto at = [&](Vec2 p) { return world_point(map, p); };
  if (map.format != MapFormat::ros) return {cells_layer("blocked", "blocked cells", map.blocked, at, execution)};
  std::vector<PictureLayer> layers;
  const std::string_view occupied = map.between > 0 ? "occupied cells, and those between" : "occupied cells";
  layers.push_back(cells_layer("occupied", std::string(occupied), known_of(map, execution), at, execution));
  layers.back().fill = colors::occupied_cell;
  if (!map.unknown.empty()) layers.push_back(cells_layer("unknown", "unknown cells", map.unknown, at, execution));
  return layers;
}

}  // namespace warren
