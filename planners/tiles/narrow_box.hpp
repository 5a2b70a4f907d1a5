// SPDX-License-Identifier: BSD-3-Clause
// Which walls of a tile come near a place? Two at once, in whole steps: a look at all walls of a tile costs some
// instructions a wall.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/base/types.hpp"
#include "planners/tiles/tile_grid.hpp"

namespace warren {

/// A box in the steps of a tile's narrow walls.
class NarrowBox {
 public:
  /// Holds what narrow walls of the tile can reach of `box`; some steps wider, for rounding.
  NarrowBox(const TileGrid& grid, std::size_t tile, const Box& box) {
    const Vec2 middle = grid.middle_of(tile);
    const auto steps = [](double x, double more) {
      return static_cast<std::int16_t>(std::clamp(x * narrow_unit + more, -32768.0, 32767.0));
    };
    const std::int16_t low_x = steps(box.min.x - middle.x, -2);
    const std::int16_t low_y = steps(box.min.y - middle.y, -2);
    const std::int16_t high_x = steps(box.max.x - middle.x, 2);
    const std::int16_t high_y = steps(box.max.y - middle.y, 2);
    low_ = Ends{low_x, low_y, low_x, low_y, low_x, low_y, low_x, low_y};
    high_ = Ends{high_x, high_y, high_x, high_y, high_x, high_y, high_x, high_y};
  }

  /// Bit 0: the box of the first wall meets this one; bit 1: that of the second one, if there are two.
  unsigned meets(const NarrowWall* walls, bool single) const {
    Ends ends{};
    std::memcpy(&ends, walls, single ? sizeof(NarrowWall) : sizeof ends);
    const Ends others = __builtin_shufflevector(ends, ends, 2, 3, 0, 1, 6, 7, 4, 5);
    const Ends least = ends < others ? ends : others;
    const Ends most = ends > others ? ends : others;
    const Ends off = (least > high_) | (most < low_);
    std::uint64_t parts[2];
    std::memcpy(parts, &off, sizeof parts);
    return (parts[0] == 0 ? 1U : 0U) | (parts[1] == 0 ? 2U : 0U);
  }

 private:
  using Ends = std::int16_t __attribute__((vector_size(16)));  // x1 y1 x2 y2 of two walls

  Ends low_;
  Ends high_;
};

}  // namespace warren
