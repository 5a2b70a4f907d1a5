// SPDX-License-Identifier: BSD-3-Clause
// The rounds of core/search/bidirectional_search.hpp with a thread for each side: the same path, length and counts as
// on one thread. The first rounds, too short to pay for a thread, run here; then both threads meet at a barrier after
// each phase and come to the same agreement each by itself. An exception of one side stops both and is rethrown.
#pragma once

#include <barrier>
#include <exception>
#include <thread>

#include "core/search/bidirectional_search.hpp"
#include "parallel/execution.hpp"

namespace warren {

namespace detail {
inline constexpr std::uint64_t rounds_alone = 5;

/// One side's rounds, up to the end of the search. `failure` receives what it throws.
template <class Side, class Other, class Border>
void run_side(Side& side, const Other& other, bool is_forward, Border agreed, std::uint64_t round,
              std::barrier<>& barrier, const Execution& execution, std::exception_ptr& failure) {
  while (!is_over(agreed)) {
    bool stop = false;
    try {
      side.advance(other, agreed, other.border().least_key, round_size(round++));
      stop = execution.should_stop();
    } catch (...) {
      failure = std::current_exception();
      stop = true;
    }
    barrier.arrive_and_wait();
    side.exchange(other, stop);
    barrier.arrive_and_wait();
    agreed = is_forward ? agree(side.border(), other.border()) : agree(other.border(), side.border());
  }
}

/// Runs both at the same time, the first on a thread of its own. False where there is no such thread: nothing ran then.
bool beside(const auto& first, const auto& second) {
  std::jthread thread;
  try {
    thread = std::jthread(first);
  } catch (const std::system_error&) {
    return false;
  }
  second();
  return true;
}
}  // namespace detail

/// Both sides, on two threads where execution.threads allows it. Throws what a side's callables throw.
template <class Forward, class Backward>
SearchResult bidirectional(Forward& forward, Backward& backward, const Execution& execution) {
  const auto should_stop = [&] { return execution.should_stop(); };
  if (thread_count(execution.threads) < 2) return bidirectional(forward, backward, should_stop);
  BorderOf<Forward> agreed;
  std::uint64_t round = 0;
  for (; round < detail::rounds_alone && !is_over(agreed); ++round) {
    agreed = one_round(forward, backward, agreed, round, should_stop);
  }
  if (!is_over(agreed)) {
    std::barrier<> barrier(2);
    std::exception_ptr failures[2];
    const bool on_two = detail::beside(
        [&] { detail::run_side(backward, forward, false, agreed, round, barrier, execution, failures[1]); },
        [&] { detail::run_side(forward, backward, true, agreed, round, barrier, execution, failures[0]); });
    for (const std::exception_ptr& failure : failures) {
      if (failure) std::rethrow_exception(failure);
    }
    if (on_two) agreed = agree(forward.border(), backward.border());
  }
  for (; !is_over(agreed); ++round) agreed = one_round(forward, backward, agreed, round, should_stop);
  return joined_result(agreed, forward, backward);
}

}  // namespace warren
