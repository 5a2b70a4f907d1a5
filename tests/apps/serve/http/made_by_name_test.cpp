// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/http/kept_values.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

namespace warren::serve {
namespace {

TEST(MadeByName, ManyWhoAskForOneAtOnceGetTheOneThatIsMade) {
  MadeByName<int> made(100);
  std::atomic<int> makes{0};
  std::atomic<int> asking{0};
  std::vector<std::jthread> askers;
  constexpr int count = 6;
  for (int i = 0; i < count; ++i) {
    askers.emplace_back([&] {
      ++asking;
      const auto lease = made.get("a", 10, {}, [&] {
        while (asking < count) std::this_thread::yield();  // the others ask while it is made
        return std::make_unique<int>(++makes);
      });
      EXPECT_EQ(*lease, 1);
    });
  }
  askers.clear();
  EXPECT_EQ(makes, 1);
  EXPECT_EQ(*made.get("b", 10, {}, [&] { return std::make_unique<int>(++makes); }), 2) << "another name";
  EXPECT_EQ(*made.get("a", 10, {}, [&] { return std::make_unique<int>(++makes); }), 1) << "kept";
}

TEST(MadeByName, WhatCouldNotBeMadeIsMadeByTheNextOne) {
  MadeByName<int> made(100);
  const auto fails = []() -> std::unique_ptr<int> { throw std::runtime_error("no"); };
  EXPECT_THROW(made.get("a", 10, {}, fails), std::runtime_error);
  EXPECT_EQ(*made.get("a", 10, {}, [] { return std::make_unique<int>(7); }), 7);
}

TEST(MadeByName, WhoWaitsEndsByItsOwnLimits) {
  MadeByName<int> made(100);
  const SignalFlag signal{15};
  const Deadline deadline(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &signal);
  const auto lease = made.get("a", 10, {}, [&] {
    std::jthread([&] {
      EXPECT_THROW(made.get("a", 10, {.deadline = &deadline}, [] { return std::make_unique<int>(2); }), Stopped);
    }).join();
    return std::make_unique<int>(1);
  });
  EXPECT_EQ(*lease, 1);
}

TEST(MadeByName, StayWhileSomebodyHoldsThem) {
  MadeByName<int> made(100);
  const auto of = [](int value) { return [value] { return std::make_unique<int>(value); }; };
  const auto held = made.get("a", 50, {}, of(1));
  for (const char* name : {"b", "c", "d"}) made.get(name, 50, {}, of(2));
  EXPECT_EQ(*held, 1);
  EXPECT_EQ(*made.get("a", 50, {}, of(3)), 3) << "forgotten, so made anew";
}

}  // namespace
}  // namespace warren::serve
