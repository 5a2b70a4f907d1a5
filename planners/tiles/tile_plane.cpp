// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiles/tile_plane.hpp"

#include <algorithm>
#include <cmath>

namespace warren {
namespace {

/// First and one past the last local number, ring included, of lattice points inside [low, high] of `count`.
struct Span {
  int first;
  int end;
};

Span standing(double low, double high, std::uint32_t count, std::uint32_t origin, int ring_end) {
  const double first = std::max(0.0, std::ceil(low) - 1);
  const double end = std::min(static_cast<double>(count), std::floor(high));  // points stand at 1 .. count
  const double from = std::clamp(first - origin, -1.0, static_cast<double>(ring_end));
  return {static_cast<int>(from), static_cast<int>(std::clamp(end - origin, from, static_cast<double>(ring_end)))};
}

}  // namespace

void TilePlane::reset(std::size_t tile, const Box& box) {
  tile_ = tile;
  std::fill(bytes_.begin(), bytes_.end(), std::uint8_t{0});
  const Span cols = standing(box.min.x, box.max.x, grid_.cols, grid_.first_col(tile), width() + 1);
  const Span rows = standing(box.min.y, box.max.y, grid_.rows, grid_.first_row(tile), height() + 1);
  if (cols.first >= cols.end) return;
  for (int row = rows.first; row < rows.end; ++row) {
    unsigned bits = plane_bit::edges | plane_bit::milestone;
    if (row == rows.first) bits &= ~unsigned{plane_bit::down};
    if (row + 1 == rows.end) bits &= ~unsigned{plane_bit::up};
    std::fill(at(cols.first, row), at(cols.end, row), static_cast<std::uint8_t>(bits));
    *at(cols.first, row) &= static_cast<std::uint8_t>(~plane_bit::left);
    *at(cols.end - 1, row) &= static_cast<std::uint8_t>(~plane_bit::right);
  }
}

}  // namespace warren
