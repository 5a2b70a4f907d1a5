// SPDX-License-Identifier: BSD-3-Clause
// What is left to go at least from the cells of a grid: a Dijkstra backwards from seeds by the knight_steps of
// spatial/maps/free_cells over cells that are passable, divided by a ratio. Grown only as far as it is asked: a value
// is the same whatever was asked before. Whole numbers of 1/1024 cell, rounded down; buckets as wide as half a step,
// within which no value depends on another, so each is final when its bucket is. 4 bytes a cell.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"

namespace warren {

class CellField {
 public:
  static constexpr double unit = 0x1p-10;  ///< cells
  static constexpr std::uint32_t never = std::numeric_limits<std::uint32_t>::max();

  /// passable(cell): asked at most once a cell. ratio: >= 1. Throws Stopped, also where the memory lacks.
  CellField(std::uint32_t width, std::uint32_t height, double ratio, std::function<bool(Cell)> passable,
            const Execution& execution);
  /// From this passable cell so many cells are left, >= 0; before anything is asked.
  void seed(Cell cell, double cells);
  /// In units; `never` where no steps lead to a seed.
  std::uint32_t at(Cell cell);

 private:
  static constexpr std::uint32_t unknown = never;
  static constexpr std::uint32_t blocked = never - 1;
  static constexpr std::uint32_t largest = never - 2;

  void reach(std::uint32_t x, std::uint32_t y, std::uint32_t value);
  void settle_bucket();

  std::uint32_t width_;
  std::uint32_t height_;
  std::array<std::uint32_t, 16> costs_{};
  unsigned shift_ = 0;  // a bucket holds 2^shift_ units
  std::function<bool(Cell)> passable_;
  const Execution& execution_;
  RawVector<std::uint32_t> values_;  // also: not reached, known to be blocked
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::size_t settled_ = 0;  // buckets
};

}  // namespace warren
