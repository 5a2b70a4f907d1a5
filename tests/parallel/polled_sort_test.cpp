// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/rng.hpp"
#include "parallel/asked_memory.hpp"
#include "tests/memory_limit.hpp"

namespace warren {
namespace {

constexpr std::size_t many = 100'000;

std::vector<std::uint64_t> numbers() {
  std::vector<std::uint64_t> list(many);
  for (std::size_t i = 0; i < many; ++i) list[i] = random_bits(1, i, 0) % 1000;
  return list;
}

TEST(PolledSort, SortsAsTheStandardLibraryDoes) {
  std::vector<std::uint64_t> list = numbers();
  std::vector<std::uint64_t> expected = list;
  std::sort(expected.begin(), expected.end(), std::greater<>());
  polled_sort(list.begin(), list.end(), Execution{}, std::greater<>());
  EXPECT_EQ(list, expected);
  polled_sort(list.begin(), list.end(), Execution{});
  EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
}

TEST(PolledSort, EndsSoonAfterTheDeadline) {
  const Deadline over(0.0);
  Execution execution;
  execution.deadline = &over;
  std::vector<std::uint64_t> list = numbers();
  std::size_t comparisons = 0;
  const auto less = [&](std::uint64_t a, std::uint64_t b) { return ++comparisons, a < b; };
  EXPECT_THROW(polled_sort(list.begin(), list.end(), execution, less), Stopped);
  EXPECT_LT(comparisons, many / 2);
}

TEST(AskedGrowth, AsksForMemoryBeforeAListGrows) {
  RawVector<std::uint64_t> list;
  const Deadline narrow = test::limit_from_here(std::size_t{16} << 20);
  Execution execution;
  execution.deadline = &narrow;
  EXPECT_THROW(
      {
        while (list.size() < std::size_t{1} << 30) push_asked(list, list.size(), execution);
      },
      Stopped);
  EXPECT_GT(list.size(), many);
  EXPECT_LE(list.size() * sizeof(std::uint64_t), std::size_t{32} << 20);
  for (std::size_t i = 0; i < list.size(); i += 1000) ASSERT_EQ(list[i], i);
}

}  // namespace
}  // namespace warren
