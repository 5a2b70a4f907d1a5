// SPDX-License-Identifier: BSD-3-Clause
// --heuristic: what an estimate that is too long costs is told, and is what asking with the straight line gives.
#include <cmath>

#include "tests/tools/grid_worlds.hpp"
#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Words = std::vector<std::string>;

Words course(const std::string& planner, const std::string& seed) {
  return {"solve",        "maze:5x7,algorithm=course",
          "--planner",    planner,
          "--sampler",    "uniform",
          "--samples",    "500",
          "--neighbours", "12",
          "--seed",       seed};
}

TEST(Heuristic, TellsWhatItCostsInLength) {
  bool any_longer = false;
  for (const char* planner : {"prm", "lazy-prm"}) {
    for (const char* seed : {"1", "2", "3", "4", "5"}) {
      const Words words = course(planner, seed);
      const Json exact = answered(words);
      EXPECT_FALSE(exact.contains("shortest_length"));
      for (const char* heuristic : {"manhattan", "octile", "chebyshev", "zero"}) {
        const Json answer = answered(joined(words, {"--heuristic", heuristic}));
        SCOPED_TRACE(shown(words) + " " + heuristic);
        EXPECT_EQ(answer["options"]["heuristic"], heuristic);
        EXPECT_EQ(answer["searched_length"], answer["length"]);
        EXPECT_EQ(answer["shortest_length"], exact["length"]);
        EXPECT_EQ(answer["shortest_expanded"], exact["counters"]["expanded"]);
        EXPECT_FALSE(answer.contains("optimal"));
        const double ratio = answer["length"].get<double>() / exact["length"].get<double>();
        const bool exact_kind = std::string(heuristic) == "chebyshev" || std::string(heuristic) == "zero";
        EXPECT_GE(ratio, 1.0 - 1e-12);
        EXPECT_LE(ratio, exact_kind ? 1.0 + 1e-12 : std::sqrt(2.0));
        any_longer = any_longer || ratio > 1.001;
      }
    }
  }
  EXPECT_TRUE(any_longer);
}

TEST(Heuristic, ZeroIsDijkstra) {
  const Words words = course("prm", "7");
  const Json zero = answered(joined(words, {"--heuristic", "zero"}));
  const Json dijkstra = answered(joined(words, {"--search", "dijkstra"}));
  EXPECT_EQ(zero["path"], dijkstra["path"]);
  EXPECT_EQ(zero["counters"]["expanded"], dijkstra["counters"]["expanded"]);
}

TEST(Heuristic, WhatIsToldIsOfThePathBeforeItIsShortened) {
  const Words words = joined(course("prm", "1"), {"--heuristic", "manhattan", "--optimise"});
  const Json answer = answered(words);
  EXPECT_EQ(answer["searched_length"], answer["raw_length"]);
  EXPECT_NE(run(words).out.find("longer than the roadmap's shortest"), std::string::npos);
}

TEST(Heuristic, KeptRoadmapsAreAskedAlike) {
  const Folder folder;
  const std::string roadmap = folder.path("r.roadmap");
  Words build = course("prm", "1");
  build.front() = "build";
  ASSERT_EQ(run(joined(build, {"-o", roadmap})).code, 0);
  const Json solved = answered(joined(course("prm", "1"), {"--heuristic", "manhattan"}));
  const Json asked = answered({"query", roadmap, "--heuristic", "manhattan"});
  for (const char* key : {"path", "length", "shortest_length"}) EXPECT_EQ(asked[key], solved[key]) << key;
  check({{"build", "maze:5x5", "-o", roadmap, "--heuristic", "zero"}, 2, "'warren query' takes it"});
  const Json kept = answered(joined(course("prm", "1"), {"--heuristic", "manhattan", "--save-roadmap", roadmap}));
  EXPECT_EQ(kept["path"], solved["path"]);
}

TEST(Heuristic, IsRefusedWhereNothingIsEstimated) {
  const std::vector<Case> cases{
      {{"solve", "maze:5x5", "--search", "dijkstra", "--heuristic", "zero"}, 2, "dijkstra estimates nothing"},
      {{"solve", "maze:5x5", "--pipeline", "tiled", "--heuristic", "zero"}, 2, "--pipeline plain"},
      {{"solve", "maze:5x5", "--planner", "voronoi", "--heuristic", "zero"}, 2, "prm and lazy-prm take it"},
      {{"solve", world_file("walls.scene"), "--heuristic", "zero"}, 2, "would ignore it for a polygon that turns"},
      {{"solve", "maze:5x5", "--heuristic", "manhatan"}, 2, "did you mean manhattan?"},
      {{"compare", "maze:5x5", "--heuristic", "zero"}, 2, "--planners prm --heuristic"}};
  for (const Case& c : cases) check(c);
}

TEST(Heuristic, CompareTakesAList) {
  const Outcome outcome = run({"compare", "maze:5x7", "--planners", "prm", "--sampler", "uniform", "--samples", "400",
                               "--heuristic", "euclidean,manhattan", "--seeds", "2", "--csv", "-"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* name : {"euclidean", "manhattan"}) EXPECT_NE(outcome.out.find(name), std::string::npos);
}

}  // namespace
}  // namespace warren::test
