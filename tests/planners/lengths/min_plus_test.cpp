// SPDX-License-Identifier: BSD-3-Clause
// The oracle is the sum itself, one by one.
#include "planners/lengths/separator_fronts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/base/rng.hpp"

namespace warren {
namespace {

using detail::InstructionSet;

std::uint32_t below(std::uint32_t end, std::uint64_t seed, std::uint64_t index, std::uint64_t axis) {
  return static_cast<std::uint32_t>(random_bits(seed, index, axis) % end);
}

TEST(MinPlus, RowsOfAllLengthsAndInstructionSets) {
  for (std::size_t count = 0; count < 70; ++count) {
    std::vector<std::uint32_t> least(count);
    std::vector<std::uint32_t> rest(count);
    std::vector<std::uint32_t> expected(count);
    const std::uint32_t first = 1000;
    for (std::size_t i = 0; i < count; ++i) {
      least[i] = below(5, count, i, 0) == 0 ? no_way : below(70000, count, i, 1);
      rest[i] = below(5, count, i, 2) == 0 ? no_way : below(70000, count, i, 3);
      expected[i] = std::min(least[i], first + rest[i]);
    }
    for (const auto lessen : {lessen_row<std::uint32_t>(), lessen_row<std::uint32_t>(InstructionSet::baseline)}) {
      std::vector<std::uint32_t> found = least;
      lessen(found.data(), rest.data(), first, count);
      EXPECT_EQ(found, expected) << count;
    }
  }
}

TEST(MinPlus, RowsThatKeepByWhatTheyBecameSmaller) {
  for (std::size_t count = 0; count < 70; ++count) {
    std::vector<std::uint32_t> least(count);
    std::vector<std::uint32_t> rest(count);
    std::vector<std::uint32_t> by(count);
    std::vector<std::uint32_t> expected(count);
    std::vector<std::uint32_t> expected_by(count);
    const std::uint32_t first = 10;
    for (std::size_t i = 0; i < count; ++i) {  // many are equal: these keep what they have
      least[i] = below(5, count, i, 0) == 0 ? no_way : below(30, count, i, 1);
      rest[i] = below(5, count, i, 2) == 0 ? no_way : below(30, count, i, 3);
      by[i] = below(100, count, i, 4);
      expected[i] = std::min(least[i], first + rest[i]);
      expected_by[i] = expected[i] < least[i] ? 1000 : by[i];
    }
    for (const LessenRowBy lessen : {lessen_row_by(), lessen_row_by(InstructionSet::baseline)}) {
      std::vector<std::uint32_t> found = least;
      std::vector<std::uint32_t> found_by = by;
      lessen(found.data(), found_by.data(), rest.data(), first, 1000, count);
      EXPECT_EQ(found, expected) << count;
      EXPECT_EQ(found_by, expected_by) << count;
    }
  }
}

TEST(MinPlus, ShortRowsHaveNoWaysOfTheirOwn) {
  for (std::size_t count = 0; count < 70; ++count) {
    std::vector<std::uint32_t> least(count);
    std::vector<std::uint16_t> rest(count);
    std::vector<std::uint32_t> expected(count);
    const std::uint32_t first = 100000;
    for (std::size_t i = 0; i < count; ++i) {
      least[i] = below(2, count, i, 0) == 0 ? no_way : below(200000, count, i, 1);
      rest[i] = static_cast<std::uint16_t>(0xffff - below(3, count, i, 2));
      expected[i] = rest[i] == no_short_way ? least[i] : std::min(least[i], first + rest[i]);
    }
    for (const auto lessen : {lessen_row<std::uint16_t>(), lessen_row<std::uint16_t>(InstructionSet::baseline)}) {
      std::vector<std::uint32_t> found = least;
      lessen(found.data(), rest.data(), first, count);
      EXPECT_EQ(found, expected) << count;
    }
  }
}

}  // namespace
}  // namespace warren
