// SPDX-License-Identifier: BSD-3-Clause
// The plane cut into unit cells around whole numbers, as mazes are, and which of their sides a motion may cross.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"

namespace warren {

/// Cells row by row from below. No motion of a free body passes from a cell to its neighbour but over a side that is
/// open at both; a side may be open that no motion crosses. Of points that keep off all walls cell_of() is exact.
struct CellSides {
  static constexpr std::uint8_t right = 1, up = 2, left = 4, down = 8, all = 15;

  Vec2 corner;  ///< lower left corner of cell 0: whole numbers and a half
  std::uint32_t cols = 0;
  std::uint32_t rows = 0;
  RawVector<std::uint8_t> open;  ///< a bit a side; empty: nothing is known

  std::size_t cell_of(Vec2 p) const {
    return std::size_t{place(p.y - corner.y, rows)} * cols + place(p.x - corner.x, cols);
  }
  /// The cell on the other side, which is not the rim's.
  std::size_t beyond(std::size_t cell, std::uint8_t side) const {
    return side == right ? cell + 1 : side == left ? cell - 1 : side == up ? cell + cols : cell - cols;
  }
  static constexpr std::uint8_t opposite(std::uint8_t side) {
    return static_cast<std::uint8_t>(side <= up ? side << 2 : side >> 2);
  }
  Box box_of_cell(std::size_t cell) const {
    const Vec2 low = corner + Vec2{static_cast<double>(cell % cols), static_cast<double>(cell / cols)};
    return {low, low + Vec2{1.0, 1.0}};
  }
  /// Between the cell and what lies beyond.
  Segment side_of_cell(std::size_t cell, std::uint8_t side) const {
    const Box box = box_of_cell(cell);
    if (side == right) return {{box.max.x, box.min.y}, box.max};
    if (side == left) return {box.min, {box.min.x, box.max.y}};
    if (side == up) return {{box.min.x, box.max.y}, box.max};
    return {box.min, {box.max.x, box.min.y}};
  }

 private:
  static std::uint32_t place(double offset, std::uint32_t count) {
    return std::min(static_cast<std::uint32_t>(std::max(offset, 0.0)), count - 1);
  }
};

}  // namespace warren
