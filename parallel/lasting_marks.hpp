// SPDX-License-Identifier: BSD-3-Clause
// One bit for each of n things that are done once and stay done, whichever thread does them: a look costs one load.
// What is done twice, because two threads looked at once, must do no harm. A mark passes no memory on to others: it may
// only speak of what nobody writes.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace warren {

/// Any number of threads may call all of it.
class LastingMarks {
 public:
  explicit LastingMarks(std::size_t n) : words_((n + word_bits - 1) / word_bits) {}

  bool test(std::size_t i) const noexcept {
    return (words_[i / word_bits].load(std::memory_order_relaxed) >> (i % word_bits) & 1U) != 0;
  }
  void set(std::size_t i) noexcept {
    words_[i / word_bits].fetch_or(std::uint64_t{1} << (i % word_bits), std::memory_order_relaxed);
  }

 private:
  static constexpr std::size_t word_bits = 64;
  std::vector<std::atomic<std::uint64_t>> words_;
};

}  // namespace warren
