// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/page_pool.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/rng.hpp"

namespace warren {
namespace {

constexpr std::size_t mib = std::size_t{1} << 20;

RawVector<std::uint8_t> written(std::size_t bytes, std::uint8_t value) {
  RawVector<std::uint8_t> block(bytes);
  std::fill(block.begin(), block.end(), value);
  return block;
}

TEST(PagePool, KeepsThePagesOfReleasedBlocksAndTakesThemForTheNext) {
  const PagePool pool;
  { const auto block = written(16 * mib, 1); }
  EXPECT_EQ(PagePool::idle_bytes(), 16 * mib);
  {
    const auto block = written(6 * mib, 2);
    EXPECT_EQ(PagePool::idle_bytes(), 10 * mib);
  }
  EXPECT_EQ(PagePool::idle_bytes(), 16 * mib);
}

TEST(PagePool, APageThatIsTakenAgainStillHoldsWhatWasWritten) {
  const PagePool pool;
  { const auto block = written(8 * mib, 77); }
  const RawVector<std::uint8_t> again(8 * mib);
  EXPECT_EQ(again[4 * mib], 77) << "a fresh page would be zero";
}

TEST(PagePool, TakesThePieceThatFitsBestWhereItLies) {
  const PagePool pool;
  const std::uint8_t* small = nullptr;
  const std::uint8_t* middle = nullptr;
  {
    const auto a = written(4 * mib, 1);
    const auto b = written(8 * mib, 2);
    const auto c = written(32 * mib, 3);
    small = a.data();
    middle = b.data();
  }
  const RawVector<std::uint8_t> six(6 * mib);
  EXPECT_EQ(six.data(), middle + 2 * mib);
  EXPECT_EQ(six[0], 2);
  const RawVector<std::uint8_t> four(4 * mib);
  EXPECT_EQ(four.data(), small);
  EXPECT_EQ(PagePool::idle_bytes(), 34 * mib);
}

TEST(PagePool, GivesBackAllPagesWithItsEnd) {
  {
    const PagePool outer;
    {
      const PagePool inner;
      { const auto block = written(8 * mib, 1); }
    }
    EXPECT_EQ(PagePool::idle_bytes(), 8 * mib) << "the outer one is still open";
  }
  EXPECT_EQ(PagePool::idle_bytes(), 0U);
  const RawVector<std::uint8_t> fresh(8 * mib);
  EXPECT_EQ(fresh[0], 0);
}

TEST(PagePool, BlocksMayOutliveIt) {
  RawVector<std::uint8_t> block;
  {
    const PagePool pool;
    { const auto first = written(8 * mib, 1); }
    block = written(12 * mib, 5);
  }
  EXPECT_EQ(block.back(), 5);
}

TEST(PagePool, RemembersTheLeastThatWasIdle) {
  const PagePool pool;
  { const auto block = written(16 * mib, 1); }
  PagePool::watch_idle_bytes();
  EXPECT_EQ(PagePool::least_idle_bytes(), 16 * mib);
  { const auto block = written(10 * mib, 1); }
  EXPECT_EQ(PagePool::idle_bytes(), 16 * mib);
  EXPECT_EQ(PagePool::least_idle_bytes(), 6 * mib);
}

TEST(PagePool, BlocksOfAnySizesInAnyOrderKeepTheirContents) {
  const PagePool pool;
  struct Held {
    RawVector<std::uint8_t> block;
    std::uint8_t value;
  };
  std::vector<Held> held;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto value = static_cast<std::uint8_t>(i + 1);
    const auto size = static_cast<std::size_t>((4.0 + 12.0 * uniform(7, i, 0)) * static_cast<double>(mib));
    held.push_back({written(size, value), value});
    if (held.size() < 6) continue;
    const auto leaving = held.begin() + static_cast<std::ptrdiff_t>(uniform(7, i, 1) * 6.0);
    for (std::size_t at = 0; at < leaving->block.size(); at += 4096) ASSERT_EQ(leaving->block[at], leaving->value);
    ASSERT_EQ(leaving->block.back(), leaving->value);
    held.erase(leaving);
  }
  EXPECT_LE(PagePool::idle_bytes(), 6 * 16 * mib) << "never more than was once in use";
}

}  // namespace
}  // namespace warren
