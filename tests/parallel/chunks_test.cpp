// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/chunks.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <iterator>
#include <limits>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/base/rng.hpp"
#include "core/run/trace.hpp"
#include "parallel/sort.hpp"
#include "tests/parallel/on_threads.hpp"

namespace warren {
namespace {

using test::on;

constexpr unsigned thread_counts[] = {1, 2, 3, 8};

TEST(ForChunks, VisitsEachIndexOnceInChunksThatDependOnSizeAndGrainAlone) {
  for (const unsigned threads : thread_counts) {
    for (const std::size_t n : {0U, 1U, 99U, 100U, 101U, 5000U}) {
      std::vector<int> visits(n, 0);  // each slot belongs to one chunk
      std::vector<Range> borders(chunk_count(n, 100), Range{1, 0});
      for_chunks(n, 100, on(threads), [&](Range r) {
        borders[r.first / 100] = r;
        for (std::size_t i = r.first; i < r.last; ++i) ++visits[i];
      });
      EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(n));
      for (std::size_t c = 0; c < borders.size(); ++c) {
        EXPECT_EQ(borders[c].first, 100 * c);
        EXPECT_EQ(borders[c].last, std::min<std::size_t>(n, 100 * (c + 1)));
      }
    }
  }
}

TEST(FirstThat, IsTheLeastForAnyNumberOfThreads) {
  for (const unsigned threads : thread_counts) {
    for (const std::size_t least : {0U, 99U, 100U, 4321U, 4999U, 5000U}) {
      EXPECT_EQ(first_that(5000, 100, on(threads), [&](std::size_t i) { return i >= least; }), least);
    }
    EXPECT_EQ(first_that(0, 100, on(threads), [](std::size_t) { return true; }), 0U);
  }
}

TEST(ForChunks, RunsLoopsInsideOfLoops) {
  for (const unsigned outer : thread_counts) {
    for (const unsigned inner : thread_counts) {
      std::vector<int> visits(40 * 30, 0);
      for_chunks(40, 1, on(outer), [&](Range i) {
        for_chunks(30, 4, on(inner), [&](Range r) {
          for (std::size_t j = r.first; j < r.last; ++j) ++visits[30 * i.first + j];
        });
      });
      EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 40 * 30) << outer << " and " << inner;
    }
  }
}

TEST(ForChunks, RunsAgainAfterAnExceptionOnAnyNumberOfThreads) {
  for (const unsigned before : thread_counts) {
    for (const unsigned after : thread_counts) {
      const auto fail = [&] { for_chunks(100, 1, on(before), [](Range) { throw std::out_of_range("any"); }); };
      EXPECT_THROW(fail(), std::out_of_range);
      std::atomic<int> runs{0};
      for_chunks(100, 1, on(after), [&](Range) { ++runs; });
      EXPECT_EQ(runs, 100) << before << " and " << after;
    }
  }
}

TEST(ForChunks, AnExceptionOfABodyEndsTheLoopAndArrivesHere) {
  for (const unsigned threads : thread_counts) {
    std::atomic<int> runs{0};
    const auto loop = [&] {
      for_chunks(100000, 1, on(threads), [&](Range r) {
        ++runs;
        if (r.first == 17) throw std::out_of_range("seventeen");
      });
    };
    EXPECT_THROW(loop(), std::out_of_range);
    if (threads == 1) {
      EXPECT_EQ(runs, 18);
    }
  }
}

TEST(ForChunks, UsesAsManyThreadsAsAskedForAndNoMore) {
  const std::thread::id caller = std::this_thread::get_id();
  for (const unsigned threads : thread_counts) {
    std::atomic<unsigned> elsewhere{0};
    std::atomic<unsigned> inside{0};
    std::atomic<unsigned> most{0};
    for_chunks(2000, 1, on(threads), [&](Range) {
      const unsigned now = ++inside;
      for (unsigned before = most; before < now && !most.compare_exchange_weak(before, now);) {
      }
      if (std::this_thread::get_id() != caller) ++elsewhere;
      --inside;
    });
    EXPECT_LE(most, threads);
    if (threads == 1) {
      EXPECT_EQ(elsewhere, 0U);
    }
  }
}

TEST(ForChunks, TwoBodiesRunAtTheSameTimeOnTwoThreads) {
  std::atomic<int> arrived{0};
  for_chunks(2, 1, on(2), [&](Range) {  // each waits for the other: with one thread this would never end
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

TEST(ForChunks, EachThreadBeginsFarFromTheOthers) {
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
  GTEST_SKIP() << "of oneTBB alone, which is not there";
#endif
#endif
  std::atomic<unsigned> arrived{0};
  std::mutex mutex;
  std::set<std::size_t> first;
  for_chunks(90, 1, on(2), [&](Range r) {
    if (arrived >= 2) return;
    {
      const std::lock_guard lock(mutex);
      first.insert(r.first);
    }
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  ASSERT_EQ(first.size(), 2U);
  for (auto i = std::next(first.begin()); i != first.end(); ++i) EXPECT_GE(*i - *std::prev(i), 15U);
}

TEST(ForChunks, StopsAtTheDeadline) {
  const Deadline over(0.0);
  for (const unsigned threads : thread_counts) {
    Execution execution = on(threads);
    execution.deadline = &over;
    std::atomic<int> runs{0};
    EXPECT_THROW(for_chunks(1000, 1, execution, [&](Range) { ++runs; }), Stopped);
    EXPECT_EQ(runs, 0);
    EXPECT_TRUE(execution.should_stop());
  }
}

TEST(ForChunks, StopsInTheMiddleWhenASignalComes) {
  for (const unsigned threads : thread_counts) {
    SignalFlag flag{0};
    const Deadline deadline(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &flag);
    Execution execution = on(threads);
    execution.deadline = &deadline;
    std::atomic<int> runs{0};
    const auto loop = [&] {
      for_chunks(100000, 1, execution, [&](Range r) {
        ++runs;
        if (r.first == 5) flag = SIGINT;
      });
    };
    EXPECT_THROW(loop(), Stopped);
    EXPECT_LT(runs, 100000);
  }
}

TEST(ForChunks, TellsProgressEachItemAndTraceEachChunk) {
  for (const unsigned threads : thread_counts) {
    Progress progress;
    Trace trace;
    Execution execution = on(threads);
    execution.progress = &progress;
    execution.trace = &trace;
    double seconds = 0.0;
    {
      const StageTimer timer(execution, "stage", seconds, 1050);
      EXPECT_STREQ(progress.stage(), "stage");
      EXPECT_EQ(progress.total(), 1050U);
      for_chunks(1050, 100, execution, [](Range) {});
    }
    EXPECT_EQ(progress.done(), 1050U);
    EXPECT_GE(seconds, 0.0);
    const auto events = trace.events();
    EXPECT_EQ(events.size(), 12U);
    EXPECT_EQ(std::count_if(events.begin(), events.end(), [](const Trace::Event& e) { return e.is_stage; }), 1);
    for (const Trace::Event& e : events) {
      EXPECT_STREQ(e.name, "stage");
      EXPECT_GE(e.begin_us, 0.0);
      EXPECT_GE(e.duration_us, 0.0);
      EXPECT_LT(e.thread, trace.thread_count());
    }
  }
}

/// The sum of 0 .. 9999, by a loop.
std::uint64_t sum_on(unsigned threads) {
  std::atomic<std::uint64_t> sum{0};
  for_chunks(10'000, 7, on(threads), [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) sum += i;
  });
  return sum;
}
constexpr std::uint64_t whole_sum = 49'995'000;

TEST(ForChunks, AForkedProcessComputesWithoutTheThreadsOfItsParent) {
  ASSERT_EQ(sum_on(4), whole_sum);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) ::_exit(sum_on(4) == whole_sum && sum_on(1) == whole_sum ? 0 : 1);
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(sum_on(4), whole_sum);
}

TEST(ForChunks, ManyThreadsRunLoopsAtTheSameTime) {
  std::atomic<int> wrong{0};
  std::vector<std::jthread> callers;
  for (unsigned caller = 0; caller < 16; ++caller) {
    callers.emplace_back([&wrong, caller] {
      for (unsigned loop = 0; loop < 200; ++loop) wrong += sum_on(1 + (caller + loop) % 4) == whole_sum ? 0 : 1;
    });
  }
  callers.clear();
  EXPECT_EQ(wrong, 0);
}

TEST(RunBoth, CallsBothAndThrowsWhatOneThrows) {
  for (const unsigned threads : thread_counts) {
    int first = 0;
    int second = 0;
    run_both(
        on(threads), [&] { ++first; }, [&] { ++second; });
    EXPECT_EQ(first + 2 * second, 3);
    const auto fail = [&] {
      run_both(
          on(threads), [&] { throw std::out_of_range("any"); }, [&] { ++second; });
    };
    EXPECT_THROW(fail(), std::out_of_range);
  }
}

TEST(PlainChunks, VisitEachOnceAndHandOnWhatAChunkThrows) {
  for (const unsigned threads : thread_counts) {
    std::vector<int> visits(1000, 0);
    detail::run_plain_chunks(visits.size(), threads, [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 1000);
    const auto fail = [&] {
      detail::run_plain_chunks(1000, threads, [](std::size_t i) {
        if (i == 17) throw std::out_of_range("seventeen");
      });
    };
    EXPECT_THROW(fail(), std::out_of_range);
  }
}

TEST(StageTimer, AddsToTheSecondsAndLeavesTheRestAlone) {
  double seconds = 5.0;
  { const StageTimer timer(Execution(), "alone", seconds); }
  EXPECT_GE(seconds, 5.0);
}

TEST(ThreadCount, IsTheNumberAskedForOrAtLeastOne) {
  EXPECT_EQ(thread_count(7), 7U);
  EXPECT_GE(thread_count(0), 1U);
}

TEST(ExclusiveScan, EqualsTheSerialOne) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    std::vector<std::uint32_t> values(seed == 1 ? 0 : rng.below(300'000));
    for (auto& v : values) v = static_cast<std::uint32_t>(rng.below(1000));
    std::vector<std::uint32_t> expected(values.size());
    std::exclusive_scan(values.begin(), values.end(), expected.begin(), 0U);
    const std::uint64_t total = std::accumulate(values.begin(), values.end(), std::uint64_t{0});
    for (const unsigned threads : thread_counts) {
      auto scanned = values;
      ASSERT_EQ(exclusive_scan(scanned, on(threads)), total);
      ASSERT_EQ(scanned, expected);
    }
  }
}

TEST(ExclusiveScan, TotalsPass32Bits) {
  std::vector<std::uint64_t> values(200'000, std::uint64_t{1} << 20);
  EXPECT_EQ(exclusive_scan(values, on(2)), std::uint64_t{200'000} << 20);
  EXPECT_EQ(values.back(), std::uint64_t{199'999} << 20);
}

}  // namespace
}  // namespace warren
