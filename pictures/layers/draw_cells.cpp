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

PictureLayer map_layer(const OccupancyMap& map, const Execution& execution) {
  return cells_layer(
      "blocked", "blocked cells", map.blocked, [&](Vec2 p) { return world_point(map, p); }, execution);
}

}  // namespace warren
