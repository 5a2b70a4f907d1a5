// SPDX-License-Identifier: BSD-3-Clause
// A hop is a way from a gate to another that passes no third: along one chain, or through the junctions of one leaf.
// Its turns are one number: at each junction, the gate where it begins included, it takes one of so many exits, that by
// which it came left out, and their numbers are the digits, the first one the lowest. Where there is one exit alone,
// along chains, nothing is to be told. With most_leaf_junctions that is less than 4 * 3^36 < 2^60.
#pragma once

#include <cstdint>

#include "planners/route_cuts/dissection.hpp"

namespace warren {

using HopTurns = std::uint64_t;

/// How many of four directions there are: processors without an instruction to count bits call a function.
constexpr unsigned exit_count(unsigned exits) { return 0x4332322132212110U >> 4 * exits & 15U; }

/// Puts turns together, in the order of the way.
class TurnWriter {
 public:
  /// exits: a bit a direction, `direction` among them.
  void take(unsigned exits, unsigned direction) {
    turns_ += unit_ * exit_count(exits & ((1U << direction) - 1));
    unit_ *= exit_count(exits);
  }
  HopTurns turns() const { return turns_; }

 private:
  HopTurns turns_ = 0;
  HopTurns unit_ = 1;
};

/// Which of two to four exits is taken, as a bit; `turns` becomes those that are left.
inline unsigned next_turn(unsigned exits, HopTurns& turns) {
  const unsigned count = exit_count(exits);
  HopTurns before = 0;
  if (count == 3) {
    before = turns % 3;
    turns /= 3;
  } else {  // two or four
    before = turns & (count - 1);
    turns >>= count / 2;
  }
  for (; before > 0; --before) exits &= exits - 1;
  return exits & (~exits + 1);
}

}  // namespace warren
