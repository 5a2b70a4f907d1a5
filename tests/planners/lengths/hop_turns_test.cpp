// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/separator_fronts.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

TEST(HopTurns, AreReadAsTheyWereWritten) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    TurnWriter writer;
    std::vector<unsigned> exits;
    std::vector<unsigned> taken;
    const std::size_t most = 1 + random_bits(seed, 0, 0) % most_leaf_junctions;
    for (std::size_t i = 0; i <= most; ++i) {
      const unsigned all = i == 0 ? 15U : 15U & ~(1U << random_bits(seed, i, 1) % 4);
      unsigned some = all & static_cast<unsigned>(random_bits(seed, i, 2));
      if (some == 0) some = all;
      unsigned direction = static_cast<unsigned>(random_bits(seed, i, 3) % 4);
      while ((some >> direction & 1U) == 0) direction = (direction + 1) % 4;
      writer.take(some, direction);
      exits.push_back(some);
      taken.push_back(1U << direction);
    }
    HopTurns turns = writer.turns();
    for (std::size_t i = 0; i < exits.size(); ++i) {
      const unsigned way = std::has_single_bit(exits[i]) ? exits[i] : next_turn(exits[i], turns);
      ASSERT_EQ(way, taken[i]) << i << " of seed " << seed;
    }
    EXPECT_EQ(turns, 0U);
  }
}

TEST(HopTurns, TheLongestLeavesRoomForOneMoreBit) {
  TurnWriter writer;
  writer.take(15, 3);
  for (std::size_t i = 0; i < most_leaf_junctions; ++i) writer.take(7, 2);
  EXPECT_EQ(std::countl_zero(writer.turns()), 4);
  HopTurns turns = writer.turns();
  EXPECT_EQ(next_turn(15, turns), 8U);
  for (std::size_t i = 0; i < most_leaf_junctions; ++i) ASSERT_EQ(next_turn(7, turns), 4U);
}

}  // namespace
}  // namespace warren
