// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/execution.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <thread>
#include <vector>

namespace warren {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

StopReason reason_of(const Deadline& deadline, std::size_t bytes) {
  try {
    deadline.reserve(bytes);
  } catch (const Stopped& stopped) {
    return stopped.reason;
  }
  ADD_FAILURE() << "did not stop";
  return StopReason::time;
}

TEST(Deadline, WithoutLimitsNeverEnds) {
  EXPECT_FALSE(Deadline().reached());
  EXPECT_FALSE(Deadline(forever).reached());
  EXPECT_FALSE(Deadline(1e300).reached());
  EXPECT_NO_THROW(Deadline(forever).reserve(std::size_t{1} << 60));
  EXPECT_NO_THROW(Execution().check());
  EXPECT_FALSE(Execution().should_stop());
}

TEST(Deadline, EndsWhenItsTimeIsOver) {
  EXPECT_EQ(Deadline(0.0).reached(), StopReason::time);
  EXPECT_EQ(Deadline(-1.0).reached(), StopReason::time);
  EXPECT_FALSE(Deadline(1000.0).reached());
  EXPECT_EQ(reason_of(Deadline(0.0), 1), StopReason::time);
}

TEST(Deadline, RefusesBytesBeyondItsMemory) {
  const std::size_t limit = resident_bytes() + (std::size_t{1} << 30);
  const Deadline deadline(forever, limit);
  EXPECT_NO_THROW(deadline.reserve(std::size_t{1} << 20));
  EXPECT_EQ(reason_of(deadline, std::size_t{2} << 30), StopReason::memory);
  EXPECT_EQ(reason_of(deadline, std::numeric_limits<std::size_t>::max()), StopReason::memory);
  EXPECT_EQ(reason_of(Deadline(forever, 1), 0), StopReason::memory);
  EXPECT_EQ(deadline.memory_bytes(), limit);
}

TEST(Deadline, TellsTheMostThatWasRefusedAndSoDoesTheWhole) {
  constexpr std::size_t gibibyte = std::size_t{1} << 30;
  const Deadline whole(forever, resident_bytes() + gibibyte);
  EXPECT_EQ(whole.wanted_bytes(), 0U);
  const Deadline part(&whole, forever);
  for (const std::size_t bytes : {4 * gibibyte, 2 * gibibyte}) EXPECT_EQ(reason_of(part, bytes), StopReason::memory);
  for (const Deadline* asked : {&whole, &part}) {
    EXPECT_GE(asked->wanted_bytes(), 4 * gibibyte);
    EXPECT_LT(asked->wanted_bytes(), 4 * gibibyte + whole.memory_bytes());
  }
  EXPECT_EQ(reason_of(whole, std::numeric_limits<std::size_t>::max()), StopReason::memory);
  EXPECT_EQ(whole.wanted_bytes(), std::numeric_limits<std::size_t>::max());
}

TEST(Deadline, GrantsThatItGaveUnaskedCountTowardsTheLimit) {
  constexpr std::size_t step = std::size_t{1} << 16;  // far less than a 64th of what is left at first
  give_freed_pages_back();                            // memory that other tests left at hand would be held already
  const Deadline deadline(forever, resident_bytes() + 1024 * step);
  std::vector<std::vector<char>> held;
  const auto take_all = [&] {
    while (held.size() < 10'000) {
      deadline.reserve(step);
      held.emplace_back(step, 'x');
    }
  };
  EXPECT_THROW(take_all(), Stopped);
  EXPECT_LT(held.size(), 1100U);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool keeps_freed_pages = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool keeps_freed_pages = false;
#else
constexpr bool keeps_freed_pages = true;
#endif
#else
constexpr bool keeps_freed_pages = true;
#endif

TEST(Deadline, PagesThatAnotherThreadHasFreedAreNoReasonToStop) {
  if (!keeps_freed_pages) GTEST_SKIP() << "a sanitizer's allocator";
  constexpr std::size_t piece = std::size_t{1} << 14;
  std::vector<char> last;
  std::thread([&] {
    std::vector<std::vector<char>> pieces(3000);
    for (std::vector<char>& one : pieces) one.assign(piece, 'x');
    last.assign(piece, 'x');  // above all others, so that they can't go by themselves
  }).join();
  const Deadline deadline(forever, resident_bytes());
  EXPECT_NO_THROW(deadline.reserve(1000 * piece));
}

TEST(Deadline, NamesTheSignalThatCame) {
  SignalFlag flag{0};
  const Deadline deadline(forever, std::numeric_limits<std::size_t>::max(), &flag);
  EXPECT_FALSE(deadline.reached());
  flag = SIGINT;
  EXPECT_EQ(deadline.reached(), StopReason::interrupt);
  flag = SIGTERM;
  EXPECT_EQ(deadline.reached(), StopReason::terminate);
  flag = SIGHUP;
  EXPECT_EQ(deadline.reached(), StopReason::hang_up);
}

TEST(Deadline, OfAPartEndsByItselfOrWithTheWhole) {
  SignalFlag flag{0};
  const Deadline whole(forever, 12345, &flag);
  const Deadline part(&whole, forever);
  EXPECT_FALSE(part.reached());
  EXPECT_EQ(part.memory_bytes(), 12345U);
  EXPECT_EQ(Deadline(&whole, 0.0).reached(), StopReason::time);
  EXPECT_FALSE(whole.reached()) << "a part's time is its own";
  flag = SIGINT;
  EXPECT_EQ(part.reached(), StopReason::interrupt);
  const Deadline over(0.0);
  EXPECT_EQ(Deadline(&over, 1000.0).reached(), StopReason::time);
  EXPECT_FALSE(Deadline(nullptr, 1000.0).reached());
}

TEST(Deadline, PartsSideBySideAreGrantedWhatIsTheirsWhateverTheOthersAsk) {
  constexpr std::size_t mebibyte = std::size_t{1} << 20;
  const Deadline whole(forever, resident_bytes() + 1024 * mebibyte);
  const Deadline one(&whole, CountedRoom{10 * mebibyte});
  const Deadline other(&whole, CountedRoom{10 * mebibyte});
  EXPECT_NO_THROW(one.reserve(9 * mebibyte));  // nothing is taken: whoever measures would grant it again
  EXPECT_EQ(one.room(), mebibyte);
  EXPECT_EQ(reason_of(one, 9 * mebibyte), StopReason::memory);
  EXPECT_GE(whole.wanted_bytes(), whole.memory_bytes() + 8 * mebibyte);
  EXPECT_NO_THROW(other.reserve(9 * mebibyte));
  const Deadline part(&other, forever, mebibyte / 2);
  EXPECT_EQ(reason_of(part, mebibyte / 2), StopReason::memory);
  EXPECT_NO_THROW(part.reserve(mebibyte / 4));
  EXPECT_EQ(other.room(), mebibyte - mebibyte / 4) << "a part is granted what the whole is";
  EXPECT_EQ(reason_of(Deadline(&whole, CountedRoom{4096 * mebibyte}), 2048 * mebibyte), StopReason::memory);
  EXPECT_NO_THROW(Deadline(nullptr, CountedRoom{1}).reserve(mebibyte)) << "without a limit nothing is counted";
}

TEST(Deadline, TellsWhatIsLeftInSteps) {
  give_freed_pages_back();
  const Deadline deadline(forever, resident_bytes() + (std::size_t{100} << 20));
  EXPECT_EQ(deadline.room(), std::size_t{96} << 20);  // eighths of 64 MiB
  EXPECT_EQ(Deadline(forever, 1).room(), 0U);
  EXPECT_EQ(Deadline(forever).room(), std::numeric_limits<std::size_t>::max());
}

TEST(Memory, FiguresAreInAPlausibleOrder) {
  EXPECT_GT(resident_bytes(), 0U);
  EXPECT_GE(peak_resident_bytes(), resident_bytes() / 2);
  EXPECT_GT(available_bytes(), std::size_t{1} << 20);
}

/// In a process of its own, where nobody has asked glibc's allocator for anything before: with a sanitizer's allocator
/// before it, its set-up by two threads at once ended that process.
TEST(Memory, FreedPagesGoBackOnManyThreadsAtOnce) {
  const auto give_back_at_once = [] {
    constexpr int count = 8;
    std::atomic<int> ready{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i) {
      threads.emplace_back([&] {
        ++ready;
        while (ready < count) std::this_thread::yield();
        give_freed_pages_back();
      });
    }
    for (std::thread& t : threads) t.join();
    std::_Exit(0);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(give_back_at_once(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace warren
