// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/scaling_study.hpp"

#include <gtest/gtest.h>

#include "apps/studies/machine.hpp"

namespace warren::studies {
namespace {

/// A run of `threads` threads; the machine did `rate` of arithmetic meanwhile.
ScalingRun timed_run(unsigned threads, unsigned repeat, double seconds, double rate, std::uint32_t side = 100) {
  MazeTrial t;
  t.rows = t.cols = side;
  t.threads = threads;
  t.planner = "prm";
  t.sampler = "lattice";
  t.outcome = Outcome::solved;
  t.verified = true;
  t.solve_s = seconds;
  t.seconds.index = 0.5 * seconds;
  t.seconds.search = 1e-6;  // too short to say anything about
  ScalingRun run{std::move(t), repeat};
  run.arithmetic_per_s = rate;
  return run;
}

TEST(ThreadGains, AreMediansOfPairsAndOfThoseInWhichTheMachineGaveAllItsCores) {
  ScalingResult result;
  // Five repeats: gains 1.9, 1.8, 1.0, 1.2, 1.7, of arithmetic 2, 1.96, 3 (the single thread was disturbed), 1.89
  // and 1.9.
  const double gains[] = {1.9, 1.8, 1.0, 1.2, 1.7};
  const double rates[] = {2.0, 1.96, 3.0, 1.89, 1.91};
  for (unsigned repeat = 0; repeat < 5; ++repeat) {
    result.runs.push_back(timed_run(1, repeat, 1.0, 100.0));
    result.runs.push_back(timed_run(2, repeat, 1.0 / gains[repeat], 100.0 * rates[repeat]));
  }
  const auto all = thread_gains(result, 2);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].first.threads, 2U);
  EXPECT_EQ(all[0].pairs, 5U);
  EXPECT_NEAR(all[0].gain, 1.7, 1e-12);
  EXPECT_NEAR(all[0].arithmetic, 1.96, 1e-12);
  EXPECT_EQ(all[0].quiet_pairs, 3U);
  ASSERT_TRUE(all[0].quiet_gain);
  EXPECT_NEAR(*all[0].quiet_gain, 1.8, 1e-12);
  ASSERT_EQ(all[0].quiet_stages.size(), 1U);
  EXPECT_EQ(all[0].quiet_stages[0].first, "index");
  EXPECT_NEAR(all[0].quiet_stages[0].second, 1.8, 1e-12);
  EXPECT_EQ(text_of(all[0]),
            "100 x 100, prm, lattice sampler, 2 threads: 1.70 times as fast as one (median of 5 pairs of runs), "
            "arithmetic alone 1.96 times; while the machine was quiet, in 3 of them, 1.80 times (index 1.80)");
}

TEST(ThreadGains, TheMedianOfAnEvenNumberLiesBetween) {
  ScalingResult result;
  result.runs = {timed_run(1, 0, 1.0, 100.0), timed_run(2, 0, 1.0, 200.0), timed_run(1, 1, 1.0, 100.0),
                 timed_run(2, 1, 0.5, 200.0)};
  const auto gains = thread_gains(result, 2);
  ASSERT_EQ(gains.size(), 1U);
  EXPECT_NEAR(gains[0].gain, 1.5, 1e-12);
}

TEST(ThreadGains, ARunThatWasBrokenOffBeforeItsArithmeticIsNoPair) {
  ScalingResult result;
  result.runs = {timed_run(1, 0, 1.0, 100.0), timed_run(2, 0, 0.5, 0.0)};
  EXPECT_TRUE(thread_gains(result, 2).empty());
}

TEST(ThreadGains, AMachineThatWasNeverQuietShowsNone) {
  ScalingResult result;
  result.runs = {timed_run(1, 0, 1.0, 100.0), timed_run(2, 0, 1.0, 110.0)};
  const auto gains = thread_gains(result, 2);
  ASSERT_EQ(gains.size(), 1U);
  EXPECT_FALSE(gains[0].quiet_gain);
  EXPECT_TRUE(gains[0].quiet_stages.empty());
}

TEST(ThreadGains, MoreThreadsThanCoresAreQuietWhereAllCoresAre) {
  ScalingResult result;
  result.runs = {timed_run(2, 0, 1.0, 200.0), timed_run(8, 0, 0.9, 199.0)};
  const auto gains = thread_gains(result, 2);
  ASSERT_EQ(gains.size(), 1U);
  EXPECT_NEAR(gains[0].gain, 2.0 / 0.9, 1e-12) << "the fewest threads gain their own number";
  EXPECT_EQ(gains[0].quiet_pairs, 1U);
}

TEST(ThreadGains, PairRunsOfOneSizeAndRepeatOnly) {
  ScalingResult result;
  result.runs = {timed_run(1, 0, 1.0, 100.0), timed_run(2, 1, 0.5, 200.0), timed_run(2, 0, 0.5, 200.0, 200)};
  ScalingRun failed = timed_run(2, 0, 0.5, 200.0);
  failed.trial.verified = false;
  result.runs.push_back(failed);
  EXPECT_TRUE(thread_gains(result, 2).empty());
  EXPECT_TRUE(thread_gains({}, 2).empty());
}

TEST(ArithmeticProbe, CountsTheWorkOfAllThreads) {
  Execution execution;
  execution.threads = 1;
  EXPECT_GT(arithmetic_per_second(execution), 1e5);
  execution.threads = 3;
  EXPECT_GT(arithmetic_per_second(execution), 1e5);
}

TEST(ArithmeticProbe, StopsAtTheDeadline) {
  const Deadline over(0.0);
  Execution execution;
  execution.deadline = &over;
  EXPECT_THROW(arithmetic_per_second(execution), Stopped);
}

}  // namespace
}  // namespace warren::studies
