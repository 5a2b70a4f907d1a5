// SPDX-License-Identifier: BSD-3-Clause
// How dark a grid of cells is, seen from afar: level k has a byte for each square of 2^k x 2^k cells, the mean of its
// four squares of level k - 1. Level 0, the cells themselves, is not held: whoever has them says how dark each is. A
// third of a byte a cell, made in one pass over them on all threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "parallel/chunks.hpp"

namespace warren::serve {

/// Immutable; any number of threads may read. What lies beyond the cells is not dark.
class ShadePyramid {
 public:
  ShadePyramid() = default;
  /// shade(x, y) is 0 .. 255. Throws Stopped.
  template <class Shade>
  ShadePyramid(std::uint32_t width, std::uint32_t height, const Shade& shade, const Execution& execution) {
    halve(width, height, shade, execution);
    while (planes_.back().width > 1 || planes_.back().height > 1) {
      const std::size_t below = planes_.size();
      halve(
          planes_.back().width, planes_.back().height,
          [&](std::uint32_t x, std::uint32_t y) { return at(static_cast<unsigned>(below), x, y); }, execution);
    }
  }

  unsigned levels() const { return static_cast<unsigned>(planes_.size()) + 1; }
  /// level: 1 .. levels() - 1; any x and y.
  std::uint8_t at(unsigned level, std::int64_t x, std::int64_t y) const {
    const Plane& plane = planes_[level - 1];
    if (x < 0 || y < 0 || x >= plane.width || y >= plane.height) return 0;
    return plane.shades[static_cast<std::size_t>(y) * plane.width + static_cast<std::size_t>(x)];
  }

 private:
  struct Plane {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    RawVector<std::uint8_t> shades;
  };
  template <class Shade>
  void halve(std::uint32_t width, std::uint32_t height, const Shade& shade, const Execution& execution) {
    Plane plane{width / 2 + width % 2, height / 2 + height % 2, {}};
    execution.reserve(std::size_t{plane.width} * plane.height);
    plane.shades.resize(std::size_t{plane.width} * plane.height);
    for_chunks(plane.height, 1 + (1U << 18U) / plane.width, execution, [&](Range rows) {
      for (std::size_t y = rows.first; y < rows.last; ++y) {
        for (std::uint32_t x = 0; x < plane.width; ++x) {
          const auto row = static_cast<std::uint32_t>(2 * y);
          const bool right = 2 * x + 1 < width;
          const bool above = row + 1 < height;
          unsigned sum = shade(2 * x, row) + 2U;
          if (right) sum += shade(2 * x + 1, row);
          if (above) sum += shade(2 * x, row + 1);
          if (right && above) sum += shade(2 * x + 1, row + 1);
          plane.shades[y * plane.width + x] = static_cast<std::uint8_t>(std::min(255U, sum / 4));
        }
      }
    });
    planes_.push_back(std::move(plane));
  }
  std::vector<Plane> planes_;  // level 1 first
};

}  // namespace warren::serve
