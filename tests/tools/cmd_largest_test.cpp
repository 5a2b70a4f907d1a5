// SPDX-License-Identifier: BSD-3-Clause
// `warren largest` and `warren scale` as users and scripts meet them. No claim about time: sizes are capped.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"
#include "tests/tools/program.hpp"

namespace warren::tools {
namespace {

using Json = nlohmann::ordered_json;

void expect_keys(const Json& json, std::initializer_list<const char*> keys) {
  for (const char* key : keys) EXPECT_TRUE(json.contains(key)) << key;
}

TEST(Largest, WritesItsSchemaAndVerifiesThreeSeedsAtTheCap) {
  const ProgramRun run = run_program("largest --budget 60s --max-size 48 --start-size 16 --quiet --json -");
  ASSERT_EQ(run.exit_code, 0);
  const Json json = Json::parse(run.out);
  expect_keys(json, {"schema", "budget_s", "rows", "cols", "cells", "solve_s", "verified", "planner", "sampler",
                     "threads", "peak_memory_bytes", "bfs_funnel_s", "trials", "machine", "stages_s"});
  EXPECT_EQ(json["schema"], "warren.largest/1");
  EXPECT_EQ(json["rows"], 48);
  EXPECT_EQ(json["cols"], 48);
  EXPECT_EQ(json["cells"], 48 * 48);
  EXPECT_EQ(json["budget_s"], 60.0);
  EXPECT_EQ(json["seeds"], (Json{1, 2, 3}));
  EXPECT_TRUE(json["verified"]);
  EXPECT_TRUE(json["bfs_funnel_s"].is_number());
  std::size_t at_the_cap = 0;
  for (const Json& trial : json["trials"]) {
    expect_keys(trial, {"rows", "cols", "seed", "solve_s", "stages_s", "verified"});
    EXPECT_TRUE(trial["verified"]);
    at_the_cap += trial["rows"] == 48 ? 1 : 0;
  }
  EXPECT_EQ(at_the_cap, 3U);
}

TEST(Largest, TheSizeGivesWhatSolveGives) {
  const Json found = Json::parse(run_program("largest --max-size 20 --seeds 1 --seed 4 --quiet --json -").out);
  const Json solved = Json::parse(run_program("solve maze:20x20,seed=4 --seed 4 --quiet --json -").out);
  EXPECT_EQ(found["trials"].back()["length"], solved["length"]);
}

TEST(Largest, StreamedMazesBeginWithTheSeed) {
  const Json json = Json::parse(
      run_program("largest --max-size 300 --start-size 300 --seeds 1 --pipeline streamed --quiet --json -").out);
  EXPECT_EQ(json["rows"], 300);
  EXPECT_TRUE(json["verified"]);
  EXPECT_EQ(json["trials"][0]["pipeline"], "streamed");
  EXPECT_EQ(json["trials"][0]["generate_s"], 0.0);
  EXPECT_GT(json["trials"][0]["stages_s"]["generate"], 0.0);
  const Json solved =
      Json::parse(run_program("solve maze:300x300,algorithm=mst --pipeline tiled --quiet --json -").out);
  EXPECT_EQ(json["trials"][0]["length"], solved["length"]);
}

TEST(Largest, ShapeIsRowsToColumns) {
  const Json json = Json::parse(run_program("largest --max-size 30 --rows 1 --cols 4 --seeds 1 --quiet --json -").out);
  EXPECT_EQ(json["rows"], 15);
  EXPECT_EQ(json["cols"], 60);
}

TEST(Largest, ABudgetThatNothingMeetsIs124WithTheTrialsSoFar) {
  const ProgramRun run = run_program("largest --budget 0.000001ms --max-size 8 --quiet --json -");
  EXPECT_EQ(run.exit_code, 124);
  const Json json = Json::parse(run.out);
  EXPECT_TRUE(json["rows"].is_null());
  EXPECT_FALSE(json["verified"]);
  EXPECT_FALSE(json["trials"].empty());
}

TEST(Largest, MemoryTooSmallForAnyMazeIs124) {
  EXPECT_EQ(run_program("largest --memory 1MiB --max-size 64 --quiet").exit_code, 124);
}

TEST(Largest, BadOptionsAreUsageErrorsThatNameTheOption) {
  struct Case {
    const char* words;
    const char* named;
  };
  for (const Case& c : {Case{"largest --budget 0s", "--budget"},
                        Case{"largest --budget -1s", "--budget"},
                        Case{"largest --precision 0", "--precision"},
                        Case{"largest --seeds 0", "--seeds"},
                        Case{"largest --rows 0", "--rows"},
                        Case{"largest --max-size 0", "--max-size"},
                        Case{"largest --start-size 99 --max-size 9", "--start-size"},
                        Case{"largest --max-size 65536", "--max-size"},
                        Case{"largest --threads 1,2", "--threads"},
                        Case{"largest --loops 2", "--loops"},
                        Case{"largest --start 1,1", "--start"},
                        Case{"largest --clearance -1", "--clearance"},
                        Case{"largest --planner rrt --search bfs --queue heap", "--planner"},
                        Case{"largest --json - --svg -", "--picture"},
                        Case{"largest maze:4x4", "maze:4x4"},
                        Case{"scale --budget 0s", "--budget"},
                        Case{"scale --sizes 4,,5", "--sizes"},
                        Case{"scale --sizes 4x", "--sizes"},
                        Case{"scale --sizes 65536", "--sizes"},
                        Case{"scale --threads 1,1", "--threads"},
                        Case{"scale --planners prm,dijkstra", "--planner"},
                        Case{"scale --repeats 0", "--repeats"},
                        Case{"scale --seeds x", "--seeds"},
                        Case{"scale --csv - --html -", "--html"}}) {
    SCOPED_TRACE(c.words);
    const ProgramRun run = run_program(std::string{c.words} + " 2>&1");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.out.find(c.named), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find('\n'), run.out.size() - 1) << "one line: " << run.out;
  }
}

TEST(Largest, AnInterruptPrintsWhatThereIs) {
  // A budget that is never reached, and sizes without end: only the signal ends it, once a trial was told.
  const test::Folder folder;
  const std::string told = folder.path("told");
  const ProgramRun run =
      run_program("largest --budget 1h --memory 512MiB --json - 2>" + told + " & p=$!; until grep -qs 'within' " +
                  told + " || ! kill -0 $p; do sleep 0.1; done; kill -INT $p; wait $p");
  EXPECT_EQ(run.exit_code, 130);
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["stopped_by"], "SIGINT");
  EXPECT_FALSE(json["trials"].empty());
}

TEST(Scale, OneRunWithoutAPathIsAnExitCode) {
  const auto code = [](const std::string& words) {
    return run_program("scale --repeats 1 --quiet " + words).exit_code;
  };
  EXPECT_EQ(code("--sizes 5"), 0);
  EXPECT_EQ(code("--sizes 5 --planners lazy-prm --samplers uniform --samples 3"), 1);
}

TEST(Scale, WritesItsSchemaWithARunForEveryCombination) {
  const ProgramRun run = run_program(
      "scale --sizes 9,14x12,40 --threads 1,2 --planners prm,lazy-prm --seeds 1,5 --repeats 2 --quiet --json -");
  ASSERT_EQ(run.exit_code, 0);
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["schema"], "warren.scale/1");
  ASSERT_EQ(json["runs"].size(), 3U * 2 * 2 * 2 * 2);
  for (const Json& r : json["runs"]) {
    expect_keys(r,
                {"rows", "cols", "threads", "planner", "sampler", "seed", "solve_s", "stages_s", "peak_memory_bytes"});
    EXPECT_TRUE(r["verified"]);
  }
  EXPECT_EQ(json["rows"].size(), 3U * 2 * 2);
  EXPECT_TRUE(json["exponents"].contains("solve"));
}

TEST(Scale, RepeatsAlternateWithWhatTheyAreComparedTo) {
  const Json json = Json::parse(run_program("scale --sizes 9 --threads 1,2 --repeats 2 --quiet --json -").out);
  std::vector<std::pair<int, int>> order;
  for (const Json& r : json["runs"]) order.emplace_back(r["repeat"], r["threads"]);
  EXPECT_EQ(order, (std::vector<std::pair<int, int>>{{0, 1}, {0, 2}, {1, 1}, {1, 2}}));
}

TEST(Scale, CsvHasALineARunWithAsManyFieldsAsTheHead) {
  const ProgramRun run = run_program("scale --sizes 9,12 --threads 1 --repeats 2 --csv - --quiet");
  std::vector<std::size_t> commas(1, 0);
  for (const char c : run.out) {
    if (c == ',') ++commas.back();
    if (c == '\n') commas.push_back(0);
  }
  commas.pop_back();
  ASSERT_EQ(commas.size(), 5U);
  for (const std::size_t n : commas) EXPECT_EQ(n, commas.front());
}

TEST(Scale, PageStandsAlone) {
  const ProgramRun run = run_program("scale --sizes 9,30 --threads 1,2 --repeats 1 --html - --quiet");
  EXPECT_TRUE(run.out.starts_with("<!DOCTYPE html>"));
  EXPECT_NE(run.out.find("<title>Speed-up</title>"), std::string::npos);
  for (const char* loader : {"<script src", "src=", "@import", "url("}) {
    EXPECT_EQ(run.out.find(loader), std::string::npos) << loader;
  }
}

TEST(Scale, ARunCutByItsBudgetIs124) {
  EXPECT_EQ(run_program("scale --sizes 50 --budget 0.000001ms --quiet").exit_code, 124);
}

}  // namespace
}  // namespace warren::tools
