// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/machine.hpp"

#include <gtest/gtest.h>
#include <linux/perf_event.h>
#include <sys/mman.h>

#include <nlohmann/json.hpp>
#include <thread>

namespace warren::studies {
namespace {

constexpr std::size_t page = 4096;
constexpr std::size_t pages = 300;

/// Touches pages that nobody has touched, on a thread of its own.
void fault_elsewhere() {
  std::thread([] {
    void* const block = ::mmap(nullptr, pages * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(block, MAP_FAILED);
    ::madvise(block, pages * page, MADV_NOHUGEPAGE);
    auto* const bytes = static_cast<volatile char*>(block);
    for (std::size_t i = 0; i < pages; ++i) bytes[i * page] = 1;
    ::munmap(block, pages * page);
  }).join();
}

TEST(RunCounters, CountWhatLaterThreadsDo) {
  const RunCounters counters;
  const RunCounts before = counters.read();
  fault_elsewhere();
  const RunCounts run = counters.read() - before;
  EXPECT_GE(run.page_faults, pages);
  EXPECT_LT(run.page_faults, 10 * pages);
  EXPECT_GE(run.cpu_s, 0.0);
}

TEST(RunCounters, PerfEventsCountLaterThreadsToo) {
  const PerfEvent events[] = {{PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS}};
  const RunCounters counters(events);
  if (!counters.refusal().empty()) GTEST_SKIP() << "perf_event_open: " << counters.refusal();
  const RunCounts before = counters.read();
  fault_elsewhere();
  const RunCounts run = counters.read() - before;
  ASSERT_EQ(run.hardware.size(), 1U);
  ASSERT_TRUE(run.hardware[0]);
  EXPECT_GE(*run.hardware[0], static_cast<double>(pages));
}

TEST(RunCounters, WhatTheKernelRefusesIsAbsentAndSaidOnce) {
  const PerfEvent events[] = {{0x7fffffff, 0}, {0x7fffffff, 1}};
  const RunCounters counters(events);
  EXPECT_FALSE(counters.refusal().empty());
  const RunCounts run = counters.read() - counters.read();
  EXPECT_FALSE(run.hardware_count("cycles"));
  EXPECT_FALSE(counts_json(run).contains("cycles"));
  EXPECT_TRUE(counts_json(run).contains("cpu_s"));
}

TEST(RunCounts, AreSubtractedNameByName) {
  const RunCounts before{1.0, 10, 3, {100.0, std::nullopt, 7.0, std::nullopt}};
  const RunCounts after{1.5, 14, 3, {150.0, 40.0, std::nullopt, std::nullopt}};
  const RunCounts run = after - before;
  EXPECT_DOUBLE_EQ(run.cpu_s, 0.5);
  EXPECT_EQ(run.page_faults, 4U);
  EXPECT_EQ(run.involuntary_switches, 0U);
  EXPECT_EQ(run.hardware_count("cycles"), 50.0);
  EXPECT_EQ(run.hardware_count("instructions"), 40.0);
  EXPECT_FALSE(run.hardware_count("cache_misses"));
  EXPECT_EQ(counts_json(run)["cycles"], 50);
}

}  // namespace
}  // namespace warren::studies
