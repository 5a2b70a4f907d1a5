// SPDX-License-Identifier: BSD-3-Clause
// A coarse grid of places in the plane, a bit each, up to 64 columns and 64 rows: small enough to be looked at for
// every problem. A row is a word, so that whole rows are moved and compared at once. No allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/types.hpp"

namespace warren {

/// Place (column, row) is at origin + step * (column, row). Bits beyond the columns are 0. What a set bit means is said
/// by who made the grid.
struct PlaceGrid {
  static constexpr std::size_t most = 64;  ///< columns, and rows

  Vec2 origin;
  double step = 1.0;  ///< > 0
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::array<std::uint64_t, most> bits{};

  Vec2 at(std::size_t column, std::size_t row) const {
    return origin + step * Vec2{static_cast<double>(column), static_cast<double>(row)};
  }
  bool test(std::size_t column, std::size_t row) const { return (bits[row] >> column & 1U) != 0; }

  /// A grid of set bits over the whole of a box, as fine as the number of columns and rows lets it be.
  static PlaceGrid over(const Box& box) {
    PlaceGrid grid;
    const double longest = std::max(box.width(), box.height());
    if (!(longest > 0.0)) return grid;
    grid.origin = box.min;
    grid.step = longest / static_cast<double>(most - 1) * (1.0 - 1e-12);  // rounding hardly leaves the box
    const auto count = [&grid](double extent) {
      return std::min(most, static_cast<std::size_t>(extent / grid.step * (1.0 + 1e-9)) + 1);
    };
    grid.columns = count(box.width());
    grid.rows = count(box.height());
    for (std::size_t row = 0; row < grid.rows; ++row) grid.bits[row] = ~std::uint64_t{0} >> (most - grid.columns);
    return grid;
  }
};

}  // namespace warren
