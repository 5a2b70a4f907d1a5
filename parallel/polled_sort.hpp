// SPDX-License-Identifier: BSD-3-Clause
// std::sort that looks at the deadline between comparisons: sorting ten million edges takes a second. The look is at a
// counter in all comparisons but one of 2^12, for exact ones can take microseconds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>

#include "parallel/execution.hpp"

namespace warren {

/// Sorts first .. last by less. Throws Stopped: the elements are then in some
/// order, and one of them may have been moved from.
template <class Iterator, class Less = std::less<>>
void polled_sort(Iterator first, Iterator last, const Execution& execution, const Less& less = {}) {
  constexpr std::uint32_t comparisons_per_poll = 1U << 12;
  std::uint32_t comparisons = 0;
  std::sort(first, last, [&](const auto& a, const auto& b) {
    if (++comparisons % comparisons_per_poll == 0) execution.check();
    return less(a, b);
  });
}

}  // namespace warren
