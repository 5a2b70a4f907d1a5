// SPDX-License-Identifier: BSD-3-Clause
// Where two bitmaps of one size differ.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/base/bitmap.hpp"
#include "core/base/whole.hpp"

namespace warren {

/// Calls visit(cell) where the bitmaps, of one size, differ, by rows, and poll() before each row; an empty one has no
/// bits.
template <class Poll, class Visit>
void for_each_differing(const Bitmap& a, const Bitmap& b, const Poll& poll, const Visit& visit) {
  const Bitmap& sized = a.empty() ? b : a;
  for (std::uint32_t y = 0; y < sized.height(); ++y) {
    poll();
    for (std::size_t w = 0; w < sized.row(y).size(); ++w) {
      const std::uint64_t in_a = a.empty() ? 0 : a.row(y)[w];
      const std::uint64_t in_b = b.empty() ? 0 : b.row(y)[w];
      for (std::uint64_t rest = in_a ^ in_b; rest != 0; rest &= rest - 1) {
        visit(Cell{as_whole<std::uint32_t>(64 * w + as_whole<std::size_t>(std::countr_zero(rest))), y});
      }
    }
  }
}

}  // namespace warren
