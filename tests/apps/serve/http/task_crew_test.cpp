// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/http/http_server.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "core/base/page_pool.hpp"
#include "core/base/raw_vector.hpp"

namespace warren::serve {
namespace {

TEST(TaskCrew, SaysNoWhereTooManyWait) {
  std::promise<void> begun;
  std::promise<void> go;
  std::atomic<int> done{0};
  TaskCrew crew(1, 2);
  ASSERT_TRUE(crew.offer([&] {
    begun.set_value();
    go.get_future().wait();
    ++done;
  }));
  begun.get_future().wait();
  EXPECT_TRUE(crew.offer([&] { ++done; }));
  EXPECT_TRUE(crew.offer([&] { ++done; }));
  EXPECT_EQ(crew.waiting(), 2U);
  EXPECT_FALSE(crew.offer([&] { ++done; }));
  go.set_value();
  while (done < 3) std::this_thread::yield();
  EXPECT_EQ(crew.waiting(), 0U);
}

TEST(TaskCrew, EndsAfterWhatHasBegunAndForgetsTheRest) {
  std::promise<void> begun;
  std::atomic<int> done{0};
  std::atomic<bool> may_end{false};
  TaskCrew crew(1, 8);
  crew.offer([&] {
    begun.set_value();
    while (!may_end) std::this_thread::yield();
    ++done;
  });
  begun.get_future().wait();
  crew.offer([&] { done += 100; });
  auto ended = std::async(std::launch::async, [&] { crew.end(); });
  while (crew.waiting() > 0) std::this_thread::yield();
  may_end = true;
  ended.wait();
  EXPECT_EQ(done, 1);
  EXPECT_FALSE(crew.offer([&] { ++done; }));
}

TEST(TaskCrew, AllTasksAreDoneOnceByAnyNumberOfThreads) {
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    std::atomic<int> sum{0};
    TaskCrew crew(threads, 1000);
    for (int i = 1; i <= 1000; ++i) {
      while (!crew.offer([&sum, i] { sum += i; })) std::this_thread::yield();
    }
    while (sum < 500'500) std::this_thread::yield();
    crew.end();
    EXPECT_EQ(sum, 500'500);
  }
}

TEST(TaskCrew, TasksInARowShareThePagesOfLargeBlocksUpToSoMany) {
  constexpr std::size_t block = std::size_t{32} << 20U;
  TaskCrew crew(1, 8);
  const auto idle_after = [&](std::size_t bytes) {
    crew.offer([bytes] { const RawVector<char> large(bytes); });
    std::promise<std::size_t> idle;
    crew.offer([&] { idle.set_value(PagePool::idle_bytes()); });
    return idle.get_future().get();
  };
  EXPECT_EQ(idle_after(block), block);
  EXPECT_EQ(idle_after(block), block);
  EXPECT_EQ(idle_after(8 * block), 0U);
}

}  // namespace
}  // namespace warren::serve
