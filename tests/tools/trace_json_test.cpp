// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/run_of_verb.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <vector>

#include "tests/tools/program.hpp"

namespace warren::tools {
namespace {

using Json = nlohmann::ordered_json;
using std::chrono::nanoseconds;

/// A "complete" event in whole nanoseconds.
struct Slice {
  std::int64_t begin;
  std::int64_t end;
};

std::map<int, std::vector<Slice>> slices_by_thread(const Json& trace) {
  std::map<int, std::vector<Slice>> slices;
  for (const Json& event : trace["traceEvents"]) {
    if (event["ph"] != "X") continue;
    const auto begin = static_cast<std::int64_t>(std::llround(1e3 * event["ts"].get<double>()));
    const auto length = static_cast<std::int64_t>(std::llround(1e3 * event["dur"].get<double>()));
    EXPECT_GE(length, 0);
    slices[event["tid"].get<int>()].push_back({begin, begin + length});
  }
  return slices;
}

/// Viewers draw the events of a thread as a stack: each must lie inside or outside of each other.
void expect_nested(std::vector<Slice> slices) {
  std::sort(slices.begin(), slices.end(),
            [](const Slice& a, const Slice& b) { return a.begin != b.begin ? a.begin < b.begin : a.end > b.end; });
  std::vector<Slice> open;
  for (const Slice& slice : slices) {
    while (!open.empty() && open.back().end <= slice.begin) open.pop_back();
    if (!open.empty()) {
      EXPECT_LE(slice.end, open.back().end) << slice.begin;
    }
    open.push_back(slice);
  }
}

TEST(TraceJson, ChunksLieInTheirStagesAfterRounding) {
  Trace trace;
  const auto start = Trace::Clock::now();
  for (int i = 0; i < 200; ++i) {
    const auto begin = start + nanoseconds(1001 * i);
    trace.record("inner", begin + nanoseconds(1), begin + nanoseconds(999), false);
    trace.record("outer", begin, begin + nanoseconds(1000), true);
  }
  const Json json = Json::parse(tools::trace_json(trace));
  const auto slices = slices_by_thread(json);
  ASSERT_EQ(slices.size(), 1U);
  EXPECT_EQ(slices.at(0).size(), 400U);
  expect_nested(slices.at(0));
}

TEST(TraceJson, EveryThreadHasItsNameAndEvents) {
  Trace trace;
  const auto now = Trace::Clock::now();
  trace.record("stage", now, now + nanoseconds(50), true);
  std::thread([&] { trace.record("chunk", now, now + nanoseconds(20), false); }).join();
  const Json json = Json::parse(tools::trace_json(trace));
  std::set<int> named;
  for (const Json& event : json["traceEvents"]) {
    if (event["name"] == "thread_name") named.insert(event["tid"].get<int>());
  }
  EXPECT_EQ(named, (std::set<int>{0, 1}));
  EXPECT_EQ(slices_by_thread(json).size(), 2U);
}

TEST(TraceJson, ARunShowsStagesAndChunks) {
  const ProgramRun run = run_program("scale --sizes 60 --threads 1,2 --planners prm --repeats 1 --quiet --trace -");
  ASSERT_EQ(run.exit_code, 0);
  const Json json = Json::parse(run.out);
  std::map<std::string, std::set<std::string>> names;
  for (const Json& event : json["traceEvents"]) {
    if (event["ph"] == "X") names[event["cat"]].insert(event["name"]);
  }
  for (const char* stage : {"generate", "index", "connect", "search", "verify"}) {
    EXPECT_TRUE(names["stage"].contains(stage)) << stage;
  }
  EXPECT_FALSE(names["chunk"].empty());
  for (const auto& [thread, slices] : slices_by_thread(json)) expect_nested(slices);
}

}  // namespace
}  // namespace warren::tools
