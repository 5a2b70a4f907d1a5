// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/once.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "parallel/chunks.hpp"

namespace warren {
namespace {

TEST(MadeOnce, IsMadeByOneOfManyThreadsAndSeenWholeByAll) {
  const MadeOnce<std::vector<int>> value;
  std::atomic<int> made = 0;
  std::vector<int> sizes(1000);
  for_chunks(sizes.size(), 1, {.threads = 8}, [&](Range r) {
    const std::vector<int>& all = value.get({}, [&] {
      ++made;
      return std::make_unique<std::vector<int>>(1000, 7);
    });
    sizes[r.first] = static_cast<int>(all.size()) + all.back();
  });
  EXPECT_EQ(made, 1);
  EXPECT_EQ(sizes, std::vector<int>(1000, 1007));
}

TEST(MadeOnce, WhatFailedIsMadeByTheNextOneWhoAsks) {
  const MadeOnce<int> value;
  const auto fail = []() -> std::unique_ptr<int> { throw std::runtime_error("no"); };
  EXPECT_THROW(value.get({}, fail), std::runtime_error);
  EXPECT_EQ(value.get({}, [] { return std::make_unique<int>(3); }), 3);
  EXPECT_EQ(value.get({}, fail), 3);
}

TEST(MadeOnce, WhatOnlyManyAreWorthIsMadeAfterSoManyCalls) {
  const MadeOnce<int> value;
  int made = 0;
  const auto make = [&] { return std::make_unique<int>(++made); };
  for (int i = 0; i < 3; ++i) EXPECT_EQ(value.get_after(3, {}, make), nullptr);
  EXPECT_EQ(made, 0);
  ASSERT_NE(value.get_after(3, {}, make), nullptr);
  EXPECT_EQ(*value.get_after(3, {}, make), 1);
  const MadeOnce<int> known;
  known.get({}, make);
  ASSERT_NE(known.get_after(3, {}, make), nullptr);
  EXPECT_EQ(*known.get_after(3, {}, make), 2);
}

TEST(MadeOnce, WhoWaitsIsStoppedByItsOwnDeadline) {
  const MadeOnce<int> value;
  const SignalFlag signal = SIGINT;
  const Deadline over(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &signal);
  const auto unasked = []() -> std::unique_ptr<int> { throw std::logic_error("two make it"); };
  const int& made = value.get({}, [&] {
    std::jthread waits([&] { EXPECT_THROW(value.get({.deadline = &over}, unasked), Stopped); });
    waits.join();  // while this one makes
    return std::make_unique<int>(3);
  });
  EXPECT_EQ(made, 3);
}

TEST(OneAtATime, WhoFindsItBusyGoesOnWithoutTheCall) {
  const OneAtATime one;
  int calls = 0;
  EXPECT_TRUE(one.unless_busy([&] {
    std::jthread([&] {
      for (int i = 0; i < 2; ++i) EXPECT_FALSE(one.unless_busy([&] { ++calls; }));  // who was refused ends nothing
    }).join();
    ++calls;
  }));
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(one.unless_busy([&] { ++calls; }));
  EXPECT_EQ(calls, 2);
}

}  // namespace
}  // namespace warren
