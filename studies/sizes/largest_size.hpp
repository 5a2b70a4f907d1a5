// SPDX-License-Identifier: BSD-3-Clause
// Finds the largest size that fits by trying: starts small, doubles the area while it fits, then bisects on the side.
// Sizes that don't fit are supposed to be above those that do; noise at the border costs at most a step.
#pragma once

#include <cstdint>
#include <functional>

namespace warren::studies {

struct SizeSearch {
  std::uint32_t start = 1;  ///< the first side tried; least <= start <= most
  std::uint32_t least = 1;  ///< >= 1
  std::uint32_t most = 1;
  double step = 0.05;  ///< > 0: ends when the side that fits and the one that doesn't are closer than this fraction
};

/// The largest side for which fits(side) was seen to hold; 0 if none. Halves the area where the start doesn't fit.
/// Number of tries: the doublings, and log2(0.41 / step) more.
std::uint32_t largest_side(const SizeSearch& search, const std::function<bool(std::uint32_t)>& fits);

/// The next smaller side to try when one that fitted once doesn't always: a step below, 0 below the least.
std::uint32_t side_below(const SizeSearch& search, std::uint32_t side);

}  // namespace warren::studies
