// SPDX-License-Identifier: BSD-3-Clause
// Into which tiles a wall goes, and in which form: every tile that its box, grown by the halo, meets; where it is long
// or no multiple of 1/128, row of tiles by row of tiles those that it passes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/plane/wall_set.hpp"
#include "planners/tiles/tile_grid.hpp"
#include "planners/tiles/wall_in_band.hpp"
#include "planners/tiles/wall_steps.hpp"

namespace warren {

/// Refers to the grid.
class WallFiler {
 public:
  WallFiler(const TileGrid& grid, double halo)
      : grid_(grid),
        halo_(halo),
        tile_log2_(static_cast<int>(narrow_bits + grid.side_log2)),
        halo_steps_(static_cast<std::int32_t>(std::ceil(halo * narrow_unit))),
        narrow_fits_(std::max(grid.cols, grid.rows) <= (1U << 22)) {}

  /// Calls narrow(tile, steps) or wide(tile) for each tile that w goes to, ascending.
  template <class Wall, class Narrow, class Wide>
  void file(const Wall& w, const Narrow& narrow, const Wide& wide) const {
    const detail::WallSteps steps(w);
    if (!steps.exact() || !steps.is_short(64 * narrow_unit) || !narrow_fits_) return file_wide(w.segment(), wide);
    constexpr std::int32_t origin = narrow_unit / 2;
    const detail::TileCorner first = steps.first(origin + halo_steps_, tile_log2_);
    const detail::TileCorner last = steps.last(halo_steps_ - origin, tile_log2_);
    if (first.col == last.col && first.row == last.row) {
      if (inside(first.col, grid_.tile_cols) && inside(first.row, grid_.tile_rows)) {
        narrow(tile(first.col, first.row), steps);
      }
      return;
    }
    const std::int32_t end_col = std::min(last.col + 1, static_cast<std::int32_t>(grid_.tile_cols));
    const std::int32_t end_row = std::min(last.row + 1, static_cast<std::int32_t>(grid_.tile_rows));
    for (std::int32_t row = std::max(first.row, 0); row < end_row; ++row) {
      for (std::int32_t col = std::max(first.col, 0); col < end_col; ++col) narrow(tile(col, row), steps);
    }
  }

 private:
  static bool inside(std::int32_t i, std::uint32_t count) { return static_cast<std::uint32_t>(i) < count; }
  std::size_t tile(std::int32_t col, std::int32_t row) const {
    return static_cast<std::size_t>(row) * grid_.tile_cols + static_cast<std::size_t>(col);
  }

  template <class Wide>
  void file_wide(const Segment& w, const Wide& wide) const {
    const Box box = box_of(w).grown(halo_);
    if (!box.meets(grid_.area())) return;
    const auto index = [&](double x, std::uint32_t count) {
      const double place = std::floor((x - 0.5) / grid_.side());
      return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
    };
    const std::size_t last_row = index(box.max.y, grid_.tile_rows);
    for (std::size_t row = index(box.min.y, grid_.tile_rows); row <= last_row; ++row) {
      const double low = 0.5 + static_cast<double>(row * grid_.side());
      const BandInterval x = x_range_in_band(w, low - halo_, low + grid_.side() + halo_);
      if (x.high + halo_ < 0.5 || x.low - halo_ > grid_.area().max.x) continue;
      const std::size_t last_col = index(x.high + halo_, grid_.tile_cols);
      for (std::size_t col = index(x.low - halo_, grid_.tile_cols); col <= last_col; ++col) {
        wide(row * grid_.tile_cols + col);
      }
    }
  }

  const TileGrid& grid_;
  const double halo_;
  const int tile_log2_;  // in steps
  const std::int32_t halo_steps_;
  const bool narrow_fits_;
};

}  // namespace warren
