// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/trace.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <utility>
#include <vector>

#include "parallel/chunks.hpp"

namespace warren {
namespace {

/// Wall and CPU time of a stage; zeros where there is none.
StageCost cost_of(const StageAccount& account, std::string_view name) {
  for (const StageCost& cost : account.costs()) {
    if (cost.name == name) return cost;
  }
  return {};
}

TEST(StageAccount, DealsAStagesTimeOutByThePartsOfIt) {
  StageAccount account;
  account.begin();
  account.add_part(StagePart::queries, 2e9);
  account.add_part(StagePart::checks, 1e9);
  account.add("expansion", 2.0, 4.0);
  EXPECT_DOUBLE_EQ(cost_of(account, "queries").cpu_s, 2.0);
  EXPECT_DOUBLE_EQ(cost_of(account, "queries").wall_s, 1.0);
  EXPECT_DOUBLE_EQ(cost_of(account, "checks").cpu_s, 1.0);
  EXPECT_DOUBLE_EQ(cost_of(account, "expansion").wall_s, 0.5);
  account.begin();
  account.add("expansion", 1.0, 1.0);  // the same stage again, without parts
  EXPECT_DOUBLE_EQ(cost_of(account, "expansion").wall_s, 1.5);
  EXPECT_EQ(account.costs().size(), 3U);
}

TEST(StageAccount, PartsNeverTakeMoreThanTheStageHad) {
  StageAccount account;
  account.begin();
  account.add_part(StagePart::checks, 9e9);  // threads that waited for a core
  account.add("queries", 1.0, 2.0);
  EXPECT_DOUBLE_EQ(cost_of(account, "checks").wall_s, 1.0);
  EXPECT_DOUBLE_EQ(cost_of(account, "queries").wall_s, 0.0);
}

TEST(StageAccount, PartsBelongToTheStageInWhichTheyWereTimed) {
  StageAccount account;
  account.add_part(StagePart::checks, 1e9);  // of no stage
  double seconds = 0.0;
  Execution execution;
  execution.account = &account;
  { const StageTimer timer(execution, "verify", seconds); }
  ASSERT_EQ(account.costs().size(), 1U);
  EXPECT_EQ(std::string_view(account.costs().front().name), "verify");
  EXPECT_DOUBLE_EQ(account.costs().front().wall_s, seconds);
}

TEST(PartClock, TellsTheAccountWhatSomeTurnsTookAsOfAll) {
  StageAccount account;
  Execution execution;
  execution.account = &account;
  account.begin();
  {
    PartClock clock(execution, 4);
    for (int turn = 0; turn < 8; ++turn) {
      clock.begin();
      volatile double sum = 0.0;
      for (int i = 0; i < 20000; ++i) sum = sum + 1.0;
      clock.lap(StagePart::checks);
      clock.lap(StagePart::rest);
    }
  }
  account.add("queries", 1e-9, 1e-9);
  EXPECT_GT(cost_of(account, "checks").wall_s, 0.0);
  PartClock without(Execution(), 1);
  without.begin();
  without.lap(StagePart::checks);
}

TEST(PartClock, WhatWasTimedIsThereHoweverShort) {
  for (int run = 0; run < 1000; ++run) {
    StageAccount account;
    Execution execution;
    execution.account = &account;
    account.begin();
    {
      PartClock clock(execution, 32);
      clock.begin();
      clock.lap(StagePart::queries);
      clock.lap(StagePart::checks);
    }
    account.add("expansion", 1e-6, 0.0);
    ASSERT_EQ(account.costs().size(), 3U);
  }
}

TEST(Trace, ChunksHaveTheNameOfTheirStageAndTheNumberOfItems) {
  Trace trace;
  Execution execution;
  execution.trace = &trace;
  {
    const StageTimer outer(execution, "outer", nullptr, 7);
    {
      StageTimer inner(execution, "inner", nullptr);
      inner.set_items(5);  // known at its end
    }
    for_chunks(10, 10, execution, [](Range) {});
  }
  for_chunks(3, 3, execution, [](Range) {});
  std::vector<std::pair<std::string_view, std::uint64_t>> said;
  for (const Trace::Event& e : trace.events()) said.emplace_back(e.name, e.items);
  EXPECT_EQ(said, (std::vector<std::pair<std::string_view, std::uint64_t>>{
                      {"inner", 5}, {"outer", 10}, {"outer", 7}, {"chunk", 3}}));
}

}  // namespace
}  // namespace warren
