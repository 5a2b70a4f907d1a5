// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/comparison_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/studies/study_report.hpp"
#include "scenes/text/human_units.hpp"

namespace warren::studies {
namespace {

using Json = nlohmann::ordered_json;

ComparedRun run_of(Outcome outcome, double time_s, double length) {
  ComparedRun run;
  run.outcome = outcome;
  run.time_s = time_s;
  run.length = length;
  run.hops = 3;
  run.expanded = 10;
  run.seed = 7;
  if (run.solved()) run.min_clearance = 0.25;
  return run;
}

/// Two planners with four runs each, one of them solved twice.
Comparison two_planners() {
  Comparison comparison;
  comparison.problems = {{"maze:4x4,seed=2", "", 0, 0}};
  Contender a;
  a.planner = "prm";
  a.search = "astar";
  a.library = "warren";
  a.options = {{"samples", "50"}, {"optimise", "true"}};
  for (const double time_s : {0.4, 0.1, 0.2, 0.3}) a.runs.push_back(run_of(Outcome::solved, time_s, 10.0 * time_s));
  Contender b = a;
  b.planner = "lazy-prm";
  b.options.clear();
  b.runs[0] = run_of(Outcome::not_connected, 0.7, 0.0);
  b.runs[1] = run_of(Outcome::stopped, 0.9, 0.0);
  comparison.contenders = {a, b};
  return comparison;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(ComparisonRow, LengthsAreOfSolvedRunsAndTimesOfAll) {
  const ComparisonRow row = row_of(two_planners().contenders[1]);
  EXPECT_EQ(row.runs, 4U);
  EXPECT_EQ(row.solved, 2U);
  ASSERT_TRUE(row.length && row.time_s);
  EXPECT_DOUBLE_EQ(row.length->median, 2.5);
  EXPECT_DOUBLE_EQ(row.time_s->median, 0.5);
  EXPECT_LT(row.success.low, 0.5);
  EXPECT_GT(row.success.high, 0.5);
}

TEST(ComparisonJson, HasTheKeysOfItsSchema) {
  const Json json = Json::parse(comparison_json(two_planners()));
  EXPECT_EQ(json["schema"], "warren.compare/1");
  ASSERT_EQ(json["rows"].size(), 2U);
  const Json& row = json["rows"][0];
  for (const char* key : {"planner", "search", "queue", "options", "runs", "solved", "hops", "expanded"}) {
    EXPECT_TRUE(row.contains(key)) << key;
  }
  EXPECT_EQ(row["options"], (Json{{"samples", 50}, {"optimise", true}}));
  EXPECT_TRUE(row["queue"].is_null());
  EXPECT_DOUBLE_EQ(row["length"]["median"], 2.5);
  EXPECT_DOUBLE_EQ(row["length"]["q1"], 1.75);
  EXPECT_DOUBLE_EQ(row["length"]["q3"], 3.25);
  EXPECT_DOUBLE_EQ(row["time_s"]["median"], 0.25);
  EXPECT_DOUBLE_EQ(row["time_s"]["mean"], 0.25);
  ASSERT_EQ(row["time_s"]["ci95"].size(), 2U);
  EXPECT_LT(row["time_s"]["ci95"][0], 0.25);
  EXPECT_EQ(row["hops"], 3);
  EXPECT_EQ(json["rows"][1]["solved"], 2);
}

TEST(ComparisonJson, WhatIsNotKnownIsNull) {
  Comparison comparison = two_planners();
  for (ComparedRun& run : comparison.contenders[0].runs) run = run_of(Outcome::not_connected, 0.5, 0.0);
  comparison.contenders[1].runs.clear();
  const Json json = Json::parse(comparison_json(comparison));
  EXPECT_TRUE(json["rows"][0]["length"]["median"].is_null());
  EXPECT_TRUE(json["rows"][1]["time_s"]["ci95"].is_null());
  EXPECT_EQ(json["rows"][1]["success_ci95"], (Json{0.0, 1.0}));
}

TEST(ComparisonCsv, FieldsWithCommasAreQuoted) {
  const auto lines = lines_of(comparison_csv(two_planners()));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1].rfind("\"maze:4x4,seed=2\",,,prm,astar,,warren,\"samples 50, optimise\",4,4,", 0), 0U) << lines[1];
  std::size_t outside = 0;
  bool quoted = false;
  for (const char c : lines[1]) {
    if (c == '"') quoted = !quoted;
    outside += c == ',' && !quoted ? 1 : 0;
  }
  EXPECT_EQ(outside, static_cast<std::size_t>(std::count(lines[0].begin(), lines[0].end(), ',')));
}

TEST(ComparisonRow, WhatNoSeedChangesSucceedsAlwaysOrNever) {
  Contender c = two_planners().contenders[0];
  c.runs.resize(1);
  EXPECT_LT(row_of(c).success.low, 0.5) << "one run of chance tells little";
  c.deterministic = true;
  EXPECT_EQ(row_of(c).success.low, 1.0);
  c.runs[0].outcome = Outcome::not_connected;
  EXPECT_EQ(row_of(c).success.high, 0.0);
  c.runs[0].outcome = Outcome::stopped;
  EXPECT_GT(row_of(c).success.high, 0.5) << "with more time it might have found a path";
}

TEST(ComparisonRuns, HasALineARunAndAColumnAnOption) {
  const auto lines = lines_of(comparison_runs(two_planners()));
  ASSERT_EQ(lines.size(), 9U);
  EXPECT_EQ(lines[0].rfind("source,planner,search,queue,library,option_samples,option_optimise,seed,status,time_s,", 0),
            0U);
  EXPECT_EQ(lines[1].rfind("\"maze:4x4,seed=2\",prm,astar,,warren,50,true,7,solved,0.4,,4,", 0), 0U) << lines[1];
  EXPECT_EQ(lines[5].rfind("\"maze:4x4,seed=2\",lazy-prm,astar,,warren,,,7,not_connected,0.7,,,", 0), 0U) << lines[5];
  for (const std::string& line : lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 26 + (line == lines[0] ? 0 : 1)) << "one in the source";
  }
}

/// Reads the log as ompl_benchmark_statistics.py does: split at "; ", the last piece dropped.
TEST(OmplLog, ReadsBackAsOmplsScriptReadsIt) {
  const OmplExperiment experiment{.name = "compare_maze",
                                  .hostname = "host",
                                  .date = "2026-Nov-21 09:00:00",
                                  .setup = "warren compare",
                                  .seed = 5,
                                  .budget_s = 20.0,
                                  .memory_mb = 4096,
                                  .total_s = 3.5};
  const auto lines = lines_of(ompl_log(two_planners(), experiment));
  std::size_t at = 0;
  const auto next = [&] { return lines.at(at++); };
  EXPECT_EQ(next().rfind("warren version ", 0), 0U);
  EXPECT_EQ(next(), "Experiment compare_maze");
  EXPECT_EQ(next(), "Running on host");
  EXPECT_EQ(next(), "Starting at 2026-Nov-21 09:00:00");
  for (int block = 0; block < 2; ++block) {
    EXPECT_EQ(next(), "<<<|");
    while (next() != "|>>>") ASSERT_LT(at, lines.size());
  }
  EXPECT_EQ(next(), "5 is the random seed");
  EXPECT_EQ(next(), "20 seconds per run");
  EXPECT_EQ(next(), "4096 MB per run");
  EXPECT_EQ(next(), "4 runs per planner");
  EXPECT_EQ(next(), "3.5 seconds spent to collect the data");
  EXPECT_EQ(next(), "1 enum type");
  std::vector<std::string> words;
  std::istringstream enumeration(next());
  for (std::string word; std::getline(enumeration, word, '|');) words.push_back(word);
  ASSERT_EQ(words.at(0), "status");
  EXPECT_EQ(next(), "2 planners");
  const std::vector<std::vector<std::string>> statuses{
      {"Exact solution", "Exact solution", "Exact solution", "Exact solution"},
      {"Not connected", "Timeout", "Exact solution", "Exact solution"}};
  for (const auto& expected : statuses) {
    const std::string name = next();
    EXPECT_EQ(name.find_first_of(" ,:"), std::string::npos) << name;
    const int common = std::stoi(next());
    for (int i = 0; i < common; ++i) EXPECT_NE(next().find(" = "), std::string::npos);
    const int properties = std::stoi(next());
    EXPECT_EQ(next(), "status ENUM");
    EXPECT_EQ(next(), "time REAL");
    for (int i = 2; i < properties; ++i) next();
    EXPECT_EQ(next(), "4 runs");
    for (const std::string& status : expected) {
      const std::string line = next();
      ASSERT_TRUE(line.ends_with("; ")) << line;
      std::vector<std::string> values;
      for (std::size_t from = 0; from < line.size();) {
        const std::size_t end = line.find("; ", from);
        values.push_back(line.substr(from, end - from));
        from = end + 2;
      }
      ASSERT_EQ(values.size(), static_cast<std::size_t>(properties)) << line;
      EXPECT_EQ(words.at(static_cast<std::size_t>(std::stoi(values[0])) + 1), status);
      EXPECT_EQ(values[4].empty(), status != "Exact solution") << "no length without a path";
    }
    EXPECT_EQ(next(), ".");
  }
  EXPECT_EQ(at, lines.size());
}

TEST(TextTable, ColumnsAreAsWideAsTheirWidestCellAndEmptyOnesGo) {
  const TextTable table{{"name", "nothing", "n"}, 1, "", {{"a", "", "1"}, {"longer", "", "100"}}};
  EXPECT_EQ(table.text(Palette(false)), "name      n\na         1\nlonger  100\n");
}

TEST(HumanNumber, LargeNumbersHaveAllTheirDigits) {
  const std::vector<std::pair<double, const char*>> cases{{0.0, "0"},
                                                          {1.0 / 3.0, "0.333333"},
                                                          {999999.4, "999999"},
                                                          {999999.7, "1000000"},
                                                          {11152213.5, "11152214"},
                                                          {-1.5e12, "-1500000000000"},
                                                          {2.5e15, "2.5e+15"}};
  for (const auto& [value, text] : cases) EXPECT_EQ(human_number(value), text);
}

TEST(PreciseSeconds, ShowsThreeDigitsInTheUnitThatFits) {
  const std::vector<std::pair<double, const char*>> cases{
      {0.0, "0 ns"},        {23e-9, "23 ns"},      {999e-9, "999 ns"}, {999.6e-9, "1.00 us"},
      {3.7e-6, "3.70 us"},  {12.34e-6, "12.3 us"}, {519e-6, "519 us"}, {1.4e-3, "1.40 ms"},
      {99.96e-3, "100 ms"}, {2.5, "2.50 s"},       {1234.0, "1234 s"}};
  for (const auto& [seconds, text] : cases) EXPECT_EQ(precise_seconds(seconds), text);
}

}  // namespace
}  // namespace warren::studies
