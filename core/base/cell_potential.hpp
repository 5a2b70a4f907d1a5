// SPDX-License-Identifier: BSD-3-Clause
// A function over the cells of a map that proves what no path costs less than: linear on four triangles a cell, between
// its middle and two neighbouring corners. Where it rises nowhere faster than a path pays, no path from one place to
// another costs less than the two values differ by. Plain data: whoever checks it needs no trust in who made it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace warren {

/// Values at the corners and middles of cells; a map's cells may be cut into parts x parts smaller ones.
struct CellPotential {
  std::uint32_t width = 0;     ///< columns of the smaller cells
  std::uint32_t height = 0;    ///< rows, the bottom row first
  std::vector<double> values;  ///< world units: (height + 1) rows of width + 1 corners, then as many of middles

  /// Of the corner between columns x - 1 and x, rows y - 1 and y.
  std::size_t corner(std::size_t x, std::size_t y) const { return y * (std::size_t{width} + 1) + x; }
  /// Of the middle of a cell; the last column and row of middles mean nothing.
  std::size_t middle(std::size_t x, std::size_t y) const {
    return (std::size_t{height} + 1 + y) * (std::size_t{width} + 1) + x;
  }
  /// Values that there are.
  std::size_t size() const { return 2 * (std::size_t{width} + 1) * (std::size_t{height} + 1); }
};

}  // namespace warren
