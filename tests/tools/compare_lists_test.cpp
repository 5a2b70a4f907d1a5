// SPDX-License-Identifier: BSD-3-Clause
// `warren compare` over seeds and lists of options: who is dealt what, and which runs are one run. No claim about time.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/paths.hpp"
#include "tests/tools/compared.hpp"
#include "tests/tools/process.hpp"
#include "tests/tools/program.hpp"

namespace warren::tools {
namespace {

using Json = nlohmann::ordered_json;
using test::compared;
using test::Folder;

TEST(Compare, PlannersRunOverSeedsAndPathsDependOnThemAlone) {
  const std::string right = "maze:8x8 --planners prm,lazy-prm --samplers uniform --seeds 4 --seed 11";
  const Json json = compared(right);
  ASSERT_EQ(json["rows"].size(), 2U);
  for (const Json& row : json["rows"]) {
    EXPECT_EQ(row["runs"], 4);
    EXPECT_EQ(row["solved"], 4);
    EXPECT_EQ(row["options"]["sampler"], "uniform");
    EXPECT_TRUE(row["success_ci95"][0].get<double>() > 0.4);
  }
  const Json again = compared(right + " --threads 1");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(json["rows"][i]["length"], again["rows"][i]["length"]);
    EXPECT_EQ(json["rows"][i]["expanded"], again["rows"][i]["expanded"]);
  }
  const Json solved = Json::parse(run_program("solve maze:8x8 --planner prm --sampler uniform --seed 11 --quiet "
                                              "--json -")
                                      .out);
  EXPECT_GE(solved["length"], json["rows"][0]["length"]["min"]);
  EXPECT_LE(solved["length"], json["rows"][0]["length"]["max"]);
}

TEST(Compare, ListsAreDealtToThePlannersThatTakeThem) {
  const Json json = compared(
      "maze:5x5 --planners prm,lazy-prm --samples 200,400 --searches astar,dijkstra --neighbours 9 --trials 2");
  std::set<std::string> rows;
  for (const Json& row : json["rows"]) {
    rows.insert(row["planner"].get<std::string>() + " " + row["search"].get<std::string>() + " " +
                row["options"]["samples"].dump());
    EXPECT_EQ(row["options"]["neighbours"], 9);
  }
  EXPECT_EQ(rows.size(), 8U);
  EXPECT_TRUE(rows.contains("lazy-prm dijkstra 400"));
  const Json searches = compared("maze:5x5 --planners prm,lazy-prm --searches bfs,astar --trials 1");
  EXPECT_EQ(searches["rows"].size(), 3U) << "lazy-prm takes no bfs";
  const Json optional = compared("maze:5x5 --planners prm,lazy-prm --lazy expansion --trials 1");
  EXPECT_FALSE(optional["rows"][0]["options"].contains("lazy")) << "prm does not take it";
  EXPECT_EQ(optional["rows"][1]["options"]["lazy"], "expansion");
}

TEST(Compare, ListsOfTwoOptionsAreDrawnAsHeatMaps) {
  const Folder folder;
  const std::string svg = folder.path("k.svg");
  compared("maze:5x5 --planners prm --sampler uniform --samples 100,300 --neighbours 4,8 --seeds 2 --svg " + svg);
  const std::string drawn = folder.read("k.svg");
  for (const char* title : {"prm: runs solved", "prm: median length", "prm: median time", "samples 300, neighbours 8",
                            "prm: runs solved against samples"}) {
    EXPECT_NE(drawn.find(title), std::string::npos) << title;
  }
}

std::string poly_easy() { return test::source_dir() + "/examples/worlds/poly-easy.scene"; }

TEST(Compare, EveryCombinationOfListedOptionsIsAConfiguration) {
  const Json json = compared(
      poly_easy() +
      " --planners prm,rrt --sampler uniform,halton --neighbours 6,star --nodes 500,5000 --clearance 0.01,0.05 "
      "--seeds 1 --samples 300");
  std::set<std::string> configurations;
  for (const Json& row : json["rows"]) configurations.insert(row["planner"].get<std::string>() + row["options"].dump());
  EXPECT_EQ(json["rows"].size(), 16U);
  EXPECT_EQ(configurations.size(), 16U);
  EXPECT_EQ(json["rows"][0]["dealt"], (Json{"sampler", "neighbours", "clearance"}));
  EXPECT_EQ(json["rows"][0]["options"]["neighbours"], 6);
  EXPECT_EQ(json["rows"][2]["options"]["neighbours"], "star");
  EXPECT_EQ(json["rows"][1]["options"]["clearance"], 0.05);
  EXPECT_GE(json["rows"][1]["min_clearance"]["min"], 0.05);
}

TEST(Compare, PlannersWhoseAnswerNoSeedChangesRunOnce) {
  const Json json =
      compared(poly_easy() + " --planners visibility,voronoi,prm,rrt,grid --angles 8 --cell 0.2 --seeds 4");
  for (const Json& row : json["rows"]) {
    SCOPED_TRACE(row["planner"]);
    const bool random = row["planner"] == "prm" || row["planner"] == "rrt";
    EXPECT_EQ(row["deterministic"], !random);
    EXPECT_EQ(row["runs"], random ? 4 : 1);
    const double solved = row["solved"] > 0 ? 1.0 : 0.0;
    EXPECT_EQ(row["success_ci95"] == (Json{solved, solved}), !random);
  }
  const ProgramRun said =
      run_program("compare " + test::source_dir() +
                  "/tests/data/dense.scene --planners cells --trials 3 --progress none --color never");
  EXPECT_NE(said.out.find("3 of 3  deterministic"), std::string::npos) << said.out;
  const Json lattice = compared("maze:5x5 --planners prm,lazy-prm --optimise --seeds 3");
  for (const Json& row : lattice["rows"]) EXPECT_EQ(row["runs"], row["options"]["sampler"] == "lattice" ? 1 : 3);
}

/// Without times, of which no two runs have the same.
std::vector<std::string> runs_without_times(const std::string& csv) {
  std::vector<std::string> runs;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  std::vector<bool> is_time;
  std::istringstream head(line);
  for (std::string name; std::getline(head, name, ',');) is_time.push_back(name.ends_with("_s"));
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string run;
    std::size_t column = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (column >= is_time.size() || !is_time[column]) run += cell + ",";
    }
    runs.push_back(run);
  }
  return runs;
}

TEST(Compare, RunsBesideEachOtherAreTheSameRuns) {
  const std::string words = "compare " + poly_easy() + " --planners prm,rrt,visibility --seeds 9 --quiet --runs -";
  const ProgramRun in_turn = run_program(words);
  const ProgramRun beside = run_program(words + " --parallel --threads 3");
  const auto runs = runs_without_times(in_turn.out);
  EXPECT_EQ(runs.size(), 19U);
  EXPECT_EQ(runs, runs_without_times(beside.out));
  const ProgramRun said =
      run_program("compare maze:5x5 --planners prm --seeds 2 --parallel --threads 2 --progress none");
  EXPECT_NE(said.out.find("up to 2 at once"), std::string::npos) << said.out;
}

}  // namespace
}  // namespace warren::tools
