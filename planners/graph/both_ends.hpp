// SPDX-License-Identifier: BSD-3-Clause
// The rounds of core/search/bidirectional_search.hpp with a thread for each side: the same path, length and counts as
// on one thread. The first rounds are too short to pay for a thread.
#pragma once

#include "core/search/bidirectional_search.hpp"
#include "parallel/chunks.hpp"

namespace warren {

/// Both sides, on two threads where execution.threads allows it. Throws what a side's callables throw.
template <class Forward, class Backward>
SearchResult bidirectional(Forward& forward, Backward& backward, const Execution& execution) {
  constexpr std::uint64_t rounds_alone = 5;
  const auto together = [&](std::uint64_t round, const auto& first, const auto& second) {
    round < rounds_alone ? InTurn()(round, first, second) : run_both(execution, first, second);
  };
  return bidirectional(
      forward, backward, [&] { return execution.should_stop(); }, together);
}

}  // namespace warren
