// SPDX-License-Identifier: BSD-3-Clause
// The cells of a thin set, such as a map's skeleton, as vertices of a graph.
#pragma once

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"

namespace warren {

/// The set cells of a bitmap, numbered row by row.
class NumberedCells {
 public:
  explicit NumberedCells(Bitmap cells) : bits_(std::move(cells)) {
    std::uint32_t count = 0;
    for (const std::uint64_t word : bits_.words()) {
      before_.push_back(count);
      count += static_cast<std::uint32_t>(std::popcount(word));
    }
    cells_.reserve(count);
    for (std::uint32_t y = 0; y < bits_.height(); ++y) {
      const auto words = bits_.row(y);
      for (std::uint32_t w = 0; w < words.size(); ++w) {
        for (std::uint64_t rest = words[w]; rest != 0; rest &= rest - 1) {
          cells_.push_back({64 * w + static_cast<std::uint32_t>(std::countr_zero(rest)), y});
        }
      }
    }
  }
  std::size_t size() const { return cells_.size(); }
  Cell cell(VertexId v) const { return cells_[v]; }
  bool holds(std::int64_t x, std::int64_t y) const { return bits_.holds(x, y); }
  /// Of a cell that is set.
  VertexId number(std::uint32_t x, std::uint32_t y) const {
    const std::size_t word = y * bits_.row(0).size() + x / 64;
    const std::uint64_t below = (std::uint64_t{1} << x % 64) - 1;
    return before_[word] + static_cast<VertexId>(std::popcount(bits_.words()[word] & below));
  }

 private:
  Bitmap bits_;
  std::vector<std::uint32_t> before_;  // set cells before each word
  std::vector<Cell> cells_;
};

}  // namespace warren
