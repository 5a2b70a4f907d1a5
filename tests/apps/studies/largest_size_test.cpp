// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/largest_maze.hpp"

#include <gtest/gtest.h>

#include <set>

namespace warren::studies {
namespace {

TEST(SizeSearch, FindsTheLargestSideThatFitsWhateverItIs) {
  for (std::uint32_t limit = 1; limit <= 300; ++limit) {
    for (const std::uint32_t start : {1U, 7U, 64U, 300U}) {
      SCOPED_TRACE(testing::Message() << "limit " << limit << " start " << start);
      const SizeSearch search{.start = start, .least = 1, .most = 300, .step = 1e-6};
      EXPECT_EQ(largest_side(search, [&](std::uint32_t n) { return n <= limit; }), limit);
    }
  }
}

TEST(SizeSearch, EndsWithinAStepOfTheLargestSide) {
  for (std::uint32_t limit = 20; limit <= 20000; limit += 777) {
    SCOPED_TRACE(limit);
    const SizeSearch search{.start = 16, .least = 1, .most = 65000, .step = 0.05};
    const std::uint32_t side = largest_side(search, [&](std::uint32_t n) { return n <= limit; });
    EXPECT_LE(side, limit);
    EXPECT_GE(side * 1.05 + 1.0, limit);
  }
}

TEST(SizeSearch, NothingFits) {
  const SizeSearch search{.start = 16, .least = 3, .most = 100, .step = 0.05};
  std::uint32_t smallest = 100;
  const auto never = [&](std::uint32_t n) {
    smallest = std::min(smallest, n);
    return false;
  };
  EXPECT_EQ(largest_side(search, never), 0U);
  EXPECT_EQ(smallest, 3U) << "the least size was tried before giving up";
}

TEST(SizeSearch, NoSideIsTriedTwiceOrOutsideTheLimits) {
  const SizeSearch search{.start = 10, .least = 2, .most = 500, .step = 0.01};
  std::set<std::uint32_t> tried;
  largest_side(search, [&](std::uint32_t n) {
    EXPECT_TRUE(tried.insert(n).second) << n;
    EXPECT_TRUE(n >= 2 && n <= 500) << n;
    return n <= 123;
  });
}

TEST(SizeSearch, SideBelowIsSmallerAndEndsBelowTheLeast) {
  const SizeSearch search{.start = 10, .least = 4, .most = 500, .step = 0.05};
  EXPECT_EQ(side_below(search, 105), 100U);
  EXPECT_EQ(side_below(search, 5), 4U) << "at least one smaller where the step is less than a cell";
  EXPECT_EQ(side_below(search, 4), 0U);
}

}  // namespace
}  // namespace warren::studies
