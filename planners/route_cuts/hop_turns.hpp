// SPDX-License-Identifier: BSD-3-Clause
// A hop is a way from a gate to another that passes no third: along one chain, or through the junctions of one leaf.
// Its turns are one number: at each junction, the gate where it begins included, it takes one of so many exits, that by
// which it came left out, and their numbers are the digits, the first one the lowest. Where there is one exit alone,
// along chains, nothing is to be told. With `most` junctions at most 4 * 3^36 < 2^60 numbers.
#pragma once

#include <bit>
#include <cstdint>

#include "planners/route_cuts/dissection.hpp"

namespace warren {

using HopTurns = std::uint64_t;

/// Puts turns together, in the order of the way.
class TurnWriter {
 public:
  /// exits: a bit a direction, `direction` among them.
  void take(unsigned exits, unsigned direction) {
    const unsigned before = exits & ((1U << direction) - 1);
    turns_ += unit_ * static_cast<unsigned>(std::popcount(before));
    unit_ *= static_cast<unsigned>(std::popcount(exits));
  }
  HopTurns turns() const { return turns_; }

 private:
  HopTurns turns_ = 0;
  HopTurns unit_ = 1;
};

/// Which of two to four exits is taken; the turns that are left.
inline unsigned next_turn(unsigned exits, HopTurns& turns) {
  const auto count = static_cast<unsigned>(std::popcount(exits));
  unsigned before = 0;
  if (count == 2) {
    before = turns & 1U;
    turns >>= 1U;
  } else if (count == 3) {
    before = static_cast<unsigned>(turns % 3);
    turns /= 3;
  } else {
    before = turns & 3U;
    turns >>= 2U;
  }
  for (; before > 0; --before) exits &= exits - 1;
  return static_cast<unsigned>(std::countr_zero(exits));
}

}  // namespace warren
