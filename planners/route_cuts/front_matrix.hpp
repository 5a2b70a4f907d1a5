// SPDX-License-Identifier: BSD-3-Clause
// Lengths between the gates and bounds of one front while it is made: the upper triangle of a symmetric matrix, row by
// row; and of each way by what it goes: over a gate of lower rank, or as a hop. Eliminating a gate makes each later
// pair the shorter of itself and the way by the gate; rows of gates are done in blocks, so that the rows below meet a
// block while it is in cache, side by side on all threads where they are many.
#pragma once

#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"
#include "planners/route_cuts/hop_turns.hpp"

namespace warren {

/// A gate's number: children before parents.
using GateRank = std::uint32_t;

/// The gate that a way goes over; or hop_bit and the number of a hop.
using WayBy = std::uint32_t;
inline constexpr WayBy hop_bit = WayBy{1} << 31;

class FrontMatrix {
 public:
  /// size x size, no ways at all. Asks `execution` for the memory.
  FrontMatrix(std::size_t size, const Execution& execution);

  std::size_t size() const { return size_; }
  /// Entries i .. size - 1 of row i.
  std::uint32_t* row(std::size_t i) { return lengths_.data() + i * size_ - (i > 0 ? i * (i - 1) / 2 : 0); }
  const std::uint32_t* row(std::size_t i) const { return lengths_.data() + i * size_ - (i > 0 ? i * (i - 1) / 2 : 0); }
  /// By what the ways of row i go, where there are any.
  const WayBy* by(std::size_t i) const { return by_.data() + i * size_ - (i > 0 ? i * (i - 1) / 2 : 0); }
  HopTurns hop(WayBy by) const { return hops_[by & ~hop_bit]; }
  /// A hop from i to j > i.
  void lessen_by_hop(std::size_t i, std::size_t j, std::uint32_t length, HopTurns turns);
  /// The way from `from` to `to` > `from` of another matrix, here i and j > i.
  void lessen_as(std::size_t i, std::size_t j, const FrontMatrix& other, std::size_t from, std::size_t to) {
    const std::uint32_t length = other.row(from)[to - from];
    if (length < row(i)[j - i]) take(i, j, length, other, other.by(from)[to - from]);
  }
  /// The first `gates` of all, whose ranks begin at `first`.
  void eliminate(std::size_t gates, GateRank first, const Execution& execution);

 private:
  WayBy* by(std::size_t i) { return by_.data() + i * size_ - (i > 0 ? i * (i - 1) / 2 : 0); }
  void take(std::size_t i, std::size_t j, std::uint32_t length, const FrontMatrix& other, WayBy by_what);
  void eliminate_block(std::size_t first, std::size_t last, GateRank rank, const Execution& execution);
  void pass_by(std::size_t row, std::size_t first, std::size_t last, GateRank rank);

  std::size_t size_;
  RawVector<std::uint32_t> lengths_;
  RawVector<WayBy> by_;
  RawVector<HopTurns> hops_;
};

}  // namespace warren
