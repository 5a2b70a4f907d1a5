// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/raw_vector.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>

namespace warren {
namespace {

TEST(RawVector, KeepsItsElementsWhenItGrowsFromSmallToLargeBlocks) {
  RawVector<std::uint64_t> numbers;
  for (std::uint64_t i = 0; i < 2'000'000; ++i) numbers.push_back(i);  // 16 MB: passes the border of 512 KiB
  for (std::uint64_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], i);
  RawVector<std::uint64_t> copy = numbers;
  numbers.clear();
  numbers.shrink_to_fit();
  EXPECT_EQ(std::accumulate(copy.begin(), copy.end(), std::uint64_t{0}), 1'999'999'000'000U);
}

TEST(RawVector, LargeBlocksAreAlignedToHugePages) {
  RawVector<double> numbers(std::size_t{1} << 20);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % (std::uintptr_t{2} << 20), 0U);
}

TEST(RawVector, AskedForTooMuchThrowsBadAlloc) {
  EXPECT_THROW(allocate_raw(static_cast<std::size_t>(-1)), std::bad_alloc);
  EXPECT_THROW(RawAllocator<double>().allocate(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
}

}  // namespace
}  // namespace warren
