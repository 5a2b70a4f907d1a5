// SPDX-License-Identifier: BSD-3-Clause
// How a lattice of milestones is cut into square tiles. Lattice point (col, row), both from 0, stands at
// (col + 1, row + 1); tile t holds side x side of them, fewer at the right and upper rim. The side is a power of two
// that grows with the number of points: large enough that few milestones lie on a border, small enough that a tile
// stays in the second-level cache and that there are many tiles for the cores.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/types.hpp"
#include "core/plane/wall_set.hpp"
#include "planners/graph/roadmap_options.hpp"

namespace warren {

/// A wall as tiles hold it where that is exact: multiples of 1/128 from the middle of the tile. Half the size of a
/// FloatWall, and walls of the same shape at different places differ by a whole number of cells.
struct NarrowWall {
  std::int16_t x1, y1, x2, y2;
};
inline constexpr int narrow_bits = 7;
inline constexpr int narrow_unit = 1 << narrow_bits;  ///< steps between lattice points

struct TileGrid {
  std::uint32_t cols = 0;  ///< of the lattice
  std::uint32_t rows = 0;
  unsigned side_log2 = 6;
  std::uint32_t tile_cols = 0;
  std::uint32_t tile_rows = 0;

  static TileGrid of(LatticeSize lattice) {
    const std::uint64_t points = std::uint64_t{lattice.rows} * lattice.cols;
    const unsigned log2 = points <= (1U << 18) ? 6 : points <= (1U << 22) ? 7 : 8;
    return of(lattice, log2);
  }
  static TileGrid of(LatticeSize lattice, unsigned side_log2) {
    const std::uint32_t side = 1U << side_log2;
    return {lattice.cols, lattice.rows, side_log2, (lattice.cols - 1) / side + 1, (lattice.rows - 1) / side + 1};
  }

  std::uint32_t side() const { return 1U << side_log2; }
  std::size_t count() const { return std::size_t{tile_cols} * tile_rows; }
  std::size_t tile_at(std::uint32_t col, std::uint32_t row) const {
    return std::size_t{row >> side_log2} * tile_cols + (col >> side_log2);
  }
  /// The tile of the lattice point that is nearest to p.
  std::size_t tile_near(Vec2 p) const {
    const auto index = [](double x, std::uint32_t count) {
      return static_cast<std::uint32_t>(std::clamp(std::floor(x - 0.5), 0.0, count - 1.0));
    };
    return tile_at(index(p.x, cols), index(p.y, rows));
  }
  std::uint32_t first_col(std::size_t tile) const { return static_cast<std::uint32_t>(tile % tile_cols) << side_log2; }
  std::uint32_t first_row(std::size_t tile) const { return static_cast<std::uint32_t>(tile / tile_cols) << side_log2; }
  std::uint32_t width(std::size_t tile) const { return std::min(side(), cols - first_col(tile)); }
  std::uint32_t height(std::size_t tile) const { return std::min(side(), rows - first_row(tile)); }

  /// Where a lattice point stands.
  static Vec2 point(std::int64_t col, std::int64_t row) {
    return {static_cast<double>(col + 1), static_cast<double>(row + 1)};
  }
  /// The area that the tiles cover: half a step around the lattice points.
  Box area() const { return {{0.5, 0.5}, {cols + 0.5, rows + 0.5}}; }

  /// Where narrow walls of a tile count from.
  Vec2 middle_of(std::size_t tile) const { return point(first_col(tile) + side() / 2, first_row(tile) + side() / 2); }

  /// The wall that a tile's narrow wall stands for. Exact.
  Segment segment(std::size_t tile, const NarrowWall& w) const {
    constexpr double unit = 1.0 / narrow_unit;
    const Vec2 middle = middle_of(tile);
    return {{middle.x + w.x1 * unit, middle.y + w.y1 * unit}, {middle.x + w.x2 * unit, middle.y + w.y2 * unit}};
  }
};

}  // namespace warren
