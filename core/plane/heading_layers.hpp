// SPDX-License-Identifier: BSD-3-Clause
// The configuration space of a turning body on a lattice: where it may stand at each of n headings, and which steps
// between such states are safe all the way. Plain data; equal layers are shared, so a square has 18 and not 72.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"

namespace warren {

/// State (i, j, k): the reference point at origin + cell (i, j), the body turned by 2 pi k / angles.
struct HeadingLayers {
  /// The four steps that are kept; the others are the same steps backwards.
  static constexpr std::array<std::array<int, 2>, 4> steps{{{1, 0}, {0, 1}, {1, 1}, {-1, 1}}};

  /// More are refused: states and the two ends of a search are numbered in 32 bits, of which one means none.
  static constexpr std::uint64_t most_states = 0xffff'fffc;

  Vec2 origin;
  double cell = 1.0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t angles = 1;
  std::vector<Bitmap> bitmaps;          ///< set: blocked
  std::vector<std::uint32_t> standing;  ///< for each heading its bitmap: may the body stand there?
  /// For each heading: may it go from (i, j) by steps[s]? Empty: between all free states.
  std::vector<std::array<std::uint32_t, 4>> moving;
  /// For each heading k: may it turn from k to k + 1? Empty: between all free states.
  std::vector<std::uint32_t> turning;

  bool is_free(std::uint32_t i, std::uint32_t j, std::uint32_t k) const { return !bitmaps[standing[k]].test(i, j); }
  std::uint64_t states() const { return std::uint64_t{width} * height * angles; }
  /// Free states at one heading, and in all.
  std::uint64_t free_at(std::uint32_t k) const { return std::uint64_t{width} * height - bitmaps[standing[k]].count(); }
  std::uint64_t free_states() const {
    std::uint64_t sum = 0;
    for (std::uint32_t k = 0; k < angles; ++k) sum += free_at(k);
    return sum;
  }
};

}  // namespace warren
