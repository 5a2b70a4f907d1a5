// SPDX-License-Identifier: BSD-3-Clause
// Exclusive prefix sums in parallel: two passes over the data, chunk sums between them. Integers only, so the result
// does not depend on the chunks.
#pragma once

#include <cstddef>
#include <vector>

#include "parallel/chunks.hpp"

namespace warren {

/// Replaces values[i] by the sum of values[0 .. i - 1] and returns the total. O(n), 2 reads and 1 write an element.
template <class Vector>
std::uint64_t exclusive_scan(Vector& values, const Execution& execution) {
  using Value = typename Vector::value_type;
  constexpr std::size_t grain = std::size_t{1} << 16;
  std::vector<std::uint64_t> sums(chunk_count(values.size(), grain) + 1, 0);
  for_chunks(values.size(), grain, execution, [&](Range r) {
    std::uint64_t sum = 0;
    for (std::size_t i = r.first; i < r.last; ++i) sum += values[i];
    sums[r.first / grain + 1] = sum;
  });
  for (std::size_t c = 1; c < sums.size(); ++c) sums[c] += sums[c - 1];
  for_chunks(values.size(), grain, execution, [&](Range r) {
    std::uint64_t sum = sums[r.first / grain];
    for (std::size_t i = r.first; i < r.last; ++i) {
      const std::uint64_t value = values[i];
      values[i] = static_cast<Value>(sum);
      sum += value;
    }
  });
  return sums.back();
}

}  // namespace warren
