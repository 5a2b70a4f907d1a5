// SPDX-License-Identifier: BSD-3-Clause
#include "verify/cells/judged_grid_lines.hpp"

#include <algorithm>
#include <cassert>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"

namespace warren {
namespace {

bool bit(const RawVector<std::uint64_t>& bits, std::uint64_t at) { return (bits[at / 64] >> at % 64 & 1U) != 0; }
void set_bit(RawVector<std::uint64_t>& bits, std::uint64_t at) { bits[at / 64] |= std::uint64_t{1} << at % 64; }

}  // namespace

JudgedGridLines::JudgedGridLines(std::uint32_t rows, std::uint32_t cols, unsigned side_log2, Range held,
                                 const Execution& execution)
    : LookedUpWalls(rows, cols, side_log2), held_(held) {
  const std::size_t upright = ((cols + std::size_t{1}) * held.size() + 63) / 64;
  const std::size_t level = ((held.size() + 1) * cols + 63) / 64;
  execution.reserve((upright + level) * sizeof(std::uint64_t));
  const auto poll = [&] { execution.check(); };
  assign_polled(upright_, upright, std::uint64_t{0}, poll);
  assign_polled(level_, level, std::uint64_t{0}, poll);
}

JudgedGridLines::JudgedGridLines(const WallSet& walls, std::uint32_t rows, std::uint32_t cols,
                                 const Execution& execution)
    : JudgedGridLines(rows, cols, usual_side_log2, {0, rows}, execution) {
  constexpr std::size_t polled = std::size_t{1} << 16;
  Box around;
  walls.visit([&](auto held) {
    for (std::size_t i = 0; i < held.size(); ++i) {
      if (i % polled == 0) execution.check();
      const Segment s = held[i].segment();
      take("walls", s.a.x, s.a.y, s.b.x, s.b.y, execution);
      around.include(box_of(s));
    }
  });
  if (around.min != box().min || around.max != box().max) throw InputError("walls", "do not reach around their maze");
}

void JudgedGridLines::take(const std::string& where, double x1, double y1, double x2, double y2,
                           const Execution& execution) {
  constexpr std::uint64_t units_per_poll = std::uint64_t{1} << 16;  // walls may be as long as the maze is wide
  const double dx = x2 > x1 ? 1 : x2 < x1 ? -1 : 0;
  const double dy = y2 > y1 ? 1 : y2 < y1 ? -1 : 0;
  const auto is_inside = [](double x, double side) {
    return x >= 0.5 && x <= side + 0.5 && static_cast<double>(bounded_whole<std::uint64_t>(x)) + 0.5 == x;
  };
  if ((dx == 0) == (dy == 0) || !is_inside(x1, cols()) || !is_inside(x2, cols()) || !is_inside(y1, rows()) ||
      !is_inside(y2, rows())) {
    throw InputError(where, "holds walls off the grid of its maze, which can't be judged");
  }
  for (; x1 != x2 || y1 != y2; x1 += dx, y1 += dy) {
    if (++units_ % units_per_poll == 0) execution.check();
    const auto col = bounded_whole<std::uint64_t>(dx < 0 ? x1 - 1 : x1);  // of the unit's lower or left end, from 0
    const auto row = bounded_whole<std::uint64_t>(dy < 0 ? y1 - 1 : y1);
    if (row < held_.first || row > held_.last) continue;
    if (dx != 0) {
      set_bit(level_, (row - held_.first) * cols() + col);
    } else if (row < held_.last) {
      set_bit(upright_, col * held_.size() + row - held_.first);
    }
  }
}

/// The lines right of and above the cell.
unsigned JudgedGridLines::walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const {
  const auto x = as_whole<std::uint64_t>(col + 1);
  const auto y = as_whole<std::uint64_t>(row + 1);
  assert(y >= held_.first && y <= held_.last);
  const bool right = y > held_.first && bit(upright_, x * held_.size() + y - 1 - held_.first);
  const bool above = x > 0 && bit(level_, (y - held_.first) * cols() + x - 1);
  return (right ? CellTile::right_wall : 0U) | (above ? CellTile::upper_wall : 0U);
}

}  // namespace warren
