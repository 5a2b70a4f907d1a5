// SPDX-License-Identifier: BSD-3-Clause
// for_chunks: spreads a loop over the cores. Borders depend on n and grain alone, never on the threads, so parts that
// are kept one slot a chunk and joined in chunk order are the same bits for any thread count. Deadline and progress are
// served once a chunk; an exception of a body ends the loop and is rethrown here. The threads are oneTBB's, fewer where
// the system makes no more; one thread is the caller alone.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <numeric>
#include <vector>

#include "core/base/function_ref.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// Indices first .. last - 1.
struct Range {
  std::size_t first;
  std::size_t last;
  std::size_t size() const { return last - first; }
};

constexpr std::size_t chunk_count(std::size_t n, std::size_t grain) { return (n + grain - 1) / grain; }

namespace detail {
/// Calls run(chunk) for chunk = 0 .. chunks - 1 on up to `threads` threads; returns when all are done.
void run_chunks(std::size_t chunks, unsigned threads, FunctionRef<void(std::size_t)> run);
/// The same on threads of their own, on fewer where the system makes no more: for the thread sanitizer (Debian's oneTBB
/// gives it false reports) and for forked processes. Some tens of microseconds a thread and loop.
void run_plain_chunks(std::size_t chunks, unsigned threads, FunctionRef<void(std::size_t)> run);
/// Tells progress and trace about one chunk, which began then.
void tell_of_chunk(const Execution& execution, std::chrono::steady_clock::time_point begin, std::size_t items);
}  // namespace detail

/// Calls body(Range) for each chunk of `grain` indices of 0 .. n - 1; chunks run in any order, at most
/// thread_count(execution.threads) at a time. Chunk number = range.first / grain. Throws Stopped at the deadline.
template <class Body>
void for_chunks(std::size_t n, std::size_t grain, const Execution& execution, const Body& body) {
  const auto run = [&](std::size_t chunk) {
    execution.check();
    std::chrono::steady_clock::time_point begin;
    if (execution.trace != nullptr) begin = std::chrono::steady_clock::now();
    const Range range{chunk * grain, std::min(n, (chunk + 1) * grain)};
    body(range);
    detail::tell_of_chunk(execution, begin, range.size());
  };
  const std::size_t chunks = chunk_count(n, grain);
  if (chunks <= 1 || thread_count(execution.threads) == 1) {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) run(chunk);
    return;
  }
  detail::run_chunks(chunks, thread_count(execution.threads), run);
}

/// The same where each index is dealt with by itself: each(index).
template <class Index = std::size_t, class Each>
void for_each_index(std::size_t n, std::size_t grain, const Execution& execution, const Each& each) {
  for_chunks(n, grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) each(static_cast<Index>(i));
  });
}

/// What part_of(Range) makes of each chunk, in their order.
template <class PartOf>
auto parts_of_chunks(std::size_t n, std::size_t grain, const Execution& execution, const PartOf& part_of) {
  std::vector<decltype(part_of(Range{}))> parts(chunk_count(n, grain));
  for_chunks(n, grain, execution, [&](Range r) { parts[r.first / grain] = part_of(r); });
  return parts;
}

/// The sum of what count(Range) says of each chunk.
template <class Count>
auto sum_of_chunks(std::size_t n, std::size_t grain, const Execution& execution, const Count& count) {
  const auto parts = parts_of_chunks(n, grain, execution, count);
  return std::accumulate(parts.begin(), parts.end(), decltype(count(Range{})){0});
}

/// The first of n for which there is one in first_in(Range), which gives the end of its range where it finds none; n
/// where no chunk has one.
template <class FirstIn>
std::size_t first_in_chunks(std::size_t n, std::size_t grain, const Execution& execution, const FirstIn& first_in) {
  const std::vector<std::size_t> firsts = parts_of_chunks(n, grain, execution, [&](Range r) {
    const std::size_t i = first_in(r);
    return i < r.last ? i : n;
  });
  const auto found = std::find_if(firsts.begin(), firsts.end(), [n](std::size_t i) { return i < n; });
  return found == firsts.end() ? n : *found;
}

/// The same where each index is asked by itself: is_one(index).
template <class IsOne>
std::size_t first_that(std::size_t n, std::size_t grain, const Execution& execution, const IsOne& is_one) {
  return first_in_chunks(n, grain, execution, [&](Range r) {
    std::size_t i = r.first;
    while (i < r.last && !is_one(i)) ++i;
    return i;
  });
}

/// Calls both, at the same time where execution.threads and the system allow it, and returns when both are done. Throws
/// what one of them throws; the other may then not have begun.
template <class First, class Second>
void run_both(const Execution& execution, const First& first, const Second& second) {
  detail::run_chunks(2, std::min(thread_count(execution.threads), 2U),
                     [&](std::size_t which) { which == 0 ? first() : second(); });
}

}  // namespace warren
