// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/http/kept_values.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace warren::serve {
namespace {

/// A number that counts how many of its kind there are.
struct Counted {
  Counted(int its_number, std::atomic<int>& alive) : number(its_number), count(alive) { ++count; }
  ~Counted() { --count; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  int number;
  std::atomic<int>& count;
};
using Current = CurrentValue<Counted>;

TEST(CurrentValue, WhoTookAValueKeepsItAndTheLastOneEndsIt) {
  std::atomic<int> alive{0};
  Current current(std::make_unique<Counted>(1, alive));
  {
    const auto old = current.now();
    const auto old_too = current.now();
    Current::Change(current).replace(std::make_unique<Counted>(2, alive));
    EXPECT_EQ(old->number, 1);
    EXPECT_EQ(current.now()->number, 2);
    EXPECT_EQ(alive, 2);
  }
  EXPECT_EQ(alive, 1);
  Current::Change(current).replace(std::make_unique<Counted>(3, alive));
  EXPECT_EQ(alive, 1);  // nobody had it
  EXPECT_EQ(current.now()->number, 3);
}

TEST(CurrentValue, OneChangesItAtATime) {
  std::atomic<int> alive{0};
  Current current(std::make_unique<Counted>(1, alive));
  std::optional<Current::Change> first;
  first.emplace(current);
  EXPECT_TRUE(first->is_mine());
  EXPECT_FALSE(Current::Change(current).is_mine());
  EXPECT_FALSE(Current::Change(current).is_mine());  // who was refused doesn't end what the first one does
  first.reset();
  EXPECT_TRUE(Current::Change(current).is_mine());
}

TEST(CurrentValue, ManyTakeItWhileItChanges) {
  std::atomic<int> alive{0};
  std::atomic<bool> done{false};
  std::atomic<int> backwards{0};
  {
    Current current(std::make_unique<Counted>(0, alive));
    std::vector<std::thread> readers;
    for (int i = 0; i < 3; ++i) {
      readers.emplace_back([&] {
        for (int last = 0; !done;) {
          const auto now = current.now();
          backwards += now->number < last ? 1 : 0;
          last = now->number;
        }
      });
    }
    for (int i = 1; i <= 2000; ++i) Current::Change(current).replace(std::make_unique<Counted>(i, alive));
    done = true;
    for (std::thread& reader : readers) reader.join();
    EXPECT_EQ(alive, 1);
  }
  EXPECT_EQ(alive, 0);
  EXPECT_EQ(backwards, 0);
}

}  // namespace
}  // namespace warren::serve
