// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/base/rng.hpp"

namespace warren {
namespace {

std::vector<std::uint32_t> random_keys(std::uint64_t seed, std::size_t n, std::size_t keys) {
  std::vector<std::uint32_t> key(n);
  for (std::size_t i = 0; i < n; ++i) key[i] = static_cast<std::uint32_t>(random_bits(seed, i) % keys);
  return key;
}

void expect_sorted(const std::vector<std::uint32_t>& key, std::size_t keys, unsigned threads) {
  std::vector<std::uint32_t> expected(key.size());
  std::iota(expected.begin(), expected.end(), 0U);
  std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return key[a] < key[b]; });
  const ItemsByKey order = counting_sort(key.size(), keys, {.threads = threads}, [&](std::size_t i) { return key[i]; });
  ASSERT_TRUE(std::equal(expected.begin(), expected.end(), order.items.begin(), order.items.end()));
  ASSERT_EQ(order.first.size(), keys + 1);
  for (std::size_t k = 0; k <= keys; ++k) {
    const auto less = [&](std::uint32_t i, std::size_t bound) { return key[i] < bound; };
    ASSERT_EQ(order.first[k], std::lower_bound(expected.begin(), expected.end(), k, less) - expected.begin());
  }
}

TEST(CountingSort, IsStableSortForAnyThreadCount) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const std::size_t n = random_bits(seed, 1) % 50'000;
    for (const std::size_t keys : {std::size_t{1}, std::size_t{7}, std::size_t{512}, std::size_t{513}, n + 1}) {
      for (const unsigned threads : {1U, 2U, 3U, 8U}) expect_sorted(random_keys(seed, n, keys), keys, threads);
    }
  }
}

TEST(CountingSort, HandlesNoItemsAndOneKey) {
  expect_sorted({}, 1, 2);
  expect_sorted({}, 5000, 2);
  expect_sorted(std::vector<std::uint32_t>(40'000, 3), 4, 2);
  expect_sorted(std::vector<std::uint32_t>(40'000, 8999), 9000, 2);
}

TEST(CountingSort, StopsAtTheDeadline) {
  const Deadline ended(0.0);
  const auto key = random_keys(1, 1000, 10);
  EXPECT_THROW(counting_sort(key.size(), 10, {.deadline = &ended}, [&](std::size_t i) { return key[i]; }), Stopped);
}

}  // namespace
}  // namespace warren
