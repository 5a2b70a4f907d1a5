// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/rng.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace warren {
namespace {

// The bits of every seed's mazes and samples hang on these: they never change.
static_assert(mix64(1) == 0x5692161d100b05e5U);
static_assert(random_bits(0, 0, 0) == 0x238275bc38fcbe91U);
static_assert(random_bits(1, 2, 3) == 0x8568f7c4e53b5a35U);
static_assert(uniform(1, 0, 0) == 0x1.631405e8db1bp-1);
static_assert(uniform(42, 1000000, 1) == 0x1.dd4d59a286206p-1);
static_assert([] {
  SequentialRng rng(7);
  return rng.next() == 0xb8b4c2977eabce45U && rng.next() == 0xa65305fd338ec8feU && rng.below(1000) == 549;
}());

TEST(Uniform, FillsItsRangeEvenly) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    constexpr int draws = 20000;
    std::array<int, 64> cells{};
    double sum = 0.0;
    for (std::uint64_t i = 0; i < draws; ++i) {
      const double u = uniform(seed, i, 0);
      ASSERT_TRUE(u >= 0.0 && u < 1.0);
      ++cells[static_cast<std::size_t>(u * 64)];
      sum += u;
    }
    double chi_sq = 0.0;  // 63 degrees of freedom: mean 63, deviation 11.2
    for (const int count : cells) chi_sq += std::pow(count - draws / 64.0, 2) / (draws / 64.0);
    EXPECT_LT(chi_sq, 63 + 6 * 11.2);
    EXPECT_NEAR(sum / draws, 0.5, 6 * 0.2887 / std::sqrt(draws));
  }
}

TEST(Uniform, AxesIndicesAndSeedsAreUncorrelated) {
  constexpr int draws = 20000;
  const auto correlation = [](const auto& pair) {
    double sum = 0.0;
    for (std::uint64_t i = 0; i < draws; ++i) {
      const auto [a, b] = pair(i);
      sum += (a - 0.5) * (b - 0.5);
    }
    return 12.0 * sum / draws;
  };
  const double bound = 6.0 / std::sqrt(draws);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    EXPECT_LT(std::abs(correlation([&](std::uint64_t i) {
                return std::pair{uniform(seed, i, 0), uniform(seed, i, 1)};
              })),
              bound);
    EXPECT_LT(std::abs(correlation([&](std::uint64_t i) {
                return std::pair{uniform(seed, i, 0), uniform(seed, i + 1, 0)};
              })),
              bound);
    EXPECT_LT(std::abs(correlation([&](std::uint64_t i) {
                return std::pair{uniform(seed, i, 0), uniform(seed + 1, i, 0)};
              })),
              bound);
  }
}

TEST(RandomBits, DoNotRepeatOverNeighbouringArguments) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (std::uint64_t index = 0; index < 100; ++index) {
      for (std::uint64_t axis = 0; axis < 8; ++axis) seen.insert(random_bits(seed, index, axis));
    }
  }
  EXPECT_EQ(seen.size(), 20U * 100U * 8U);
}

TEST(SequentialRng, BelowStaysBelowAndReachesEveryValue) {
  for (const std::uint64_t n : {1U, 2U, 3U, 7U, 100U}) {
    SequentialRng rng(n);
    std::set<std::uint64_t> seen;
    for (int i = 0; i < 5000; ++i) {
      const std::uint64_t value = rng.below(n);
      ASSERT_LT(value, n);
      seen.insert(value);
    }
    EXPECT_EQ(seen.size(), n);
  }
  SequentialRng rng(1);
  for (int i = 0; i < 1000; ++i) ASSERT_LT(rng.below(std::uint64_t{1} << 32), std::uint64_t{1} << 32);
}

}  // namespace
}  // namespace warren
