// SPDX-License-Identifier: BSD-3-Clause
// What searches in several threads learn of the edges of one roadmap. The world gives each of them the same answer for
// an edge, and an answer only sets bits of an edge that has none: so the order of the threads does not matter.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/raw_vector.hpp"
#include "core/search/graph.hpp"

namespace warren {

class SharedEdgeStates {
 public:
  SharedEdgeStates() = default;
  explicit SharedEdgeStates(std::span<const std::uint64_t> words) : words_(words.begin(), words.end()) {}

  EdgeState operator[](std::size_t end) const {
    const std::uint64_t word = word_of(end).load(std::memory_order_relaxed);
    return static_cast<EdgeState>(word >> shift_of(end) & 3U);
  }
  /// What the world says of an edge that was unchecked: free or blocked. Any thread may call it.
  void learn(std::size_t end, EdgeState state) const {
    word_of(end).fetch_or(static_cast<std::uint64_t>(state) << shift_of(end), std::memory_order_relaxed);
  }
  /// As they are now; while nobody learns.
  std::span<const std::uint64_t> words() const { return words_; }

 private:
  std::atomic_ref<std::uint64_t> word_of(std::size_t end) const {
    return std::atomic_ref<std::uint64_t>(words_[end / edge_states_in_word]);
  }
  static std::size_t shift_of(std::size_t end) { return 2 * (end % edge_states_in_word); }

  mutable RawVector<std::uint64_t> words_;
};

}  // namespace warren
