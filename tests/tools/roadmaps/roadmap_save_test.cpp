// SPDX-License-Identifier: BSD-3-Clause
// `warren solve --save-roadmap`: the answer of solve, and a roadmap that gives the same path when it is asked again.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

class RoadmapSave : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  std::string plain_walls() const {
    return folder_.write("walls.txt", "bounds 0 0 10 10\n2 0 2 6\n5 10 5 4\n8 0 8 6\nstart 1 1\ngoal 9 1\n");
  }
  Outcome solved(const std::string& world, const Words& more) const {
    return run(joined({"solve", world, "--save-roadmap", path("s.roadmap"), "--json", "-"}, more));
  }
  void expect_asked_again(const Json& answer, const Words& how, int code) const {
    const Outcome again = run(joined({"query", path("s.roadmap"), "--json", "-"}, how));
    EXPECT_EQ(again.code, code) << again.err;
    const Json second = Json::parse(again.out);
    for (const char* key : {"status", "verified", "length", "path"}) EXPECT_EQ(second[key], answer[key]) << key;
  }

  Folder folder_;
};

struct SaveCase {
  std::string world;
  Words options;      // of solve and build
  Words ends;         // of solve and query
  Words build;        // those of build that solve chooses itself
  bool same = true;   // is the file that of build?
  bool plain = true;  // does solve search the same roadmap where it saves none?
};

TEST_F(RoadmapSave, TheAnswerIsSolvesAndTheFileThatOfBuild) {
  const std::string walls = plain_walls();
  const std::vector<SaveCase> cases{
      {"maze:9x13,loops=0.1", {}, {}, {}, true, false},
      {"maze:300x257,loops=0.02", {}, {}, {}, true, false},
      {"maze:9x13", {"--planner", "prm", "--sampler", "uniform", "--samples", "900", "--seed", "3"}, {}, {}},
      {world_file("walls.scene"), {"--planner", "prm", "--samples", "300"}, {"--search", "dijkstra"}, {}},
      {walls, {"--samples", "300"}, {"--optimise"}, {"--planner", "lazy-prm"}, false},
      {world_file("poly-easy.scene"), {"--planner", "prm", "--samples", "300"}, {}, {}},
      {world_file("parking-lot.scene"), {"--planner", "prm", "--samples", "200"}, {}, {}},
      {world_file("car-20.scene"), {"--planner", "lazy-prm", "--samples", "300"}, {}, {}, false},
      {world_file("puma.scene"), {"--planner", "prm", "--samples", "300"}, {}, {}},
      {world_file("town.geojson"), {}, {"--start", "1.5,1.5", "--goal", "9.5,8.5"}, {"--planner", "visibility"}},
      {world_file("walls.scene"), {"--planner", "prm", "--samples", "300"}, {"--start=-99,0,0"}, {}}};
  for (const SaveCase& c : cases) {
    SCOPED_TRACE(shown(joined({"solve", c.world}, c.options)));
    const Outcome outcome = solved(c.world, joined(c.options, c.ends));
    const Json answer = Json::parse(outcome.out);
    const Outcome alone = run(joined(joined({"solve", c.world, "--json", "-"}, c.options), c.ends));
    EXPECT_EQ(outcome.code, alone.code) << outcome.err;
    const Json expected = Json::parse(alone.out);
    for (const char* key : {"status", "verified", "length", "planner", "sampler", "seed", "options"}) {
      EXPECT_EQ(answer[key], expected[key]) << key;
    }
    if (c.plain) {
      EXPECT_EQ(answer["path"], expected["path"]);
      EXPECT_EQ(answer["counters"]["expanded"], expected["counters"]["expanded"]);
    }
    expect_asked_again(answer, c.ends, outcome.code);
    const Outcome built = run(joined(joined({"build", c.world, "-o", path("b.roadmap")}, c.options), c.build));
    ASSERT_EQ(built.code, 0) << built.err;
    EXPECT_EQ(folder_.read("s.roadmap") == folder_.read("b.roadmap"), c.same);
  }
}

TEST_F(RoadmapSave, SamplesThatGrowAreThoseOfTheLastRound) {
  const std::vector<SaveCase> cases{{world_file("walls.scene"), {"--planner", "prm"}, {}, {}},
                                    {world_file("walls.scene"), {"--planner", "lazy-prm"}, {}, {}, false},
                                    {plain_walls(), {"--planner", "lazy-prm"}, {}, {}, false},
                                    {"maze:7x7", {"--planner", "prm", "--sampler", "uniform"}, {}, {}},
                                    {world_file("parking-lot.scene"), {"--planner", "prm"}, {}, {}},
                                    {world_file("car-20.scene"), {"--planner", "prm"}, {}, {}},
                                    {world_file("puma.scene"), {"--planner", "prm"}, {}, {}}};
  for (const SaveCase& c : cases) {
    SCOPED_TRACE(shown(joined({"solve", c.world}, c.options)));
    const Outcome outcome = solved(c.world, c.options);
    const Json answer = Json::parse(outcome.out);
    const Json alone = Json::parse(run(joined({"solve", c.world, "--json", "-"}, c.options)).out);
    for (const char* key : {"status", "length", "path", "counters"}) EXPECT_EQ(answer[key], alone[key]) << key;
    expect_asked_again(answer, {}, outcome.code);
    const Json meta = Json::parse(run({"info", path("s.roadmap")}).out);
    EXPECT_EQ(meta["samples"], meta["drawn"]);
    const Words samples{"--samples", meta["samples"].dump()};
    ASSERT_EQ(run(joined(joined({"build", c.world, "-o", path("b.roadmap")}, c.options), samples)).code, 0);
    EXPECT_EQ(folder_.read("s.roadmap") == folder_.read("b.roadmap"), c.same);
  }
}

TEST_F(RoadmapSave, ALazyRoadmapKnowsWhatTheQuestionHasLearnt) {
  ASSERT_EQ(solved(world_file("walls.scene"), {"--planner", "lazy-prm", "--samples", "400"}).code, 0);
  const Json edges = Json::parse(run({"info", path("s.roadmap")}).out)["edges"];
  EXPECT_GT(edges["free"], 0);
  EXPECT_GT(edges["unchecked"], 0);
  const Json again = Json::parse(run({"query", path("s.roadmap"), "--json", "-"}).out);
  const Json fresh = Json::parse(
      run({"solve", world_file("walls.scene"), "--planner", "lazy-prm", "--samples", "400", "--json", "-"}).out);
  EXPECT_LT(again["counters"]["edges_checked"], fresh["counters"]["edges_checked"]);
}

TEST_F(RoadmapSave, TheFileIsTheSameForAnyNumberOfThreads) {
  for (const char* planner : {"prm", "lazy-prm"}) {
    std::string first;
    for (const char* threads : {"1", "5"}) {
      ASSERT_EQ(solved(world_file("walls.scene"), {"--planner", planner, "--threads", threads}).code, 0);
      if (first.empty()) first = folder_.read("s.roadmap");
      EXPECT_TRUE(folder_.read("s.roadmap") == first) << planner;
    }
  }
}

TEST_F(RoadmapSave, WhatIsKeptInNoWayIsRefused) {
  const std::string file = path("s.roadmap");
  const std::string walls = world_file("walls.scene");
  check({{"solve", walls, "--planner", "rrt", "--save-roadmap", file}, 2, "makes no roadmap"});
  check(
      {{"solve", "maze:9x9", "--pipeline", "tiled", "--save-roadmap", file}, 2, "--pipeline: a roadmap that is kept"});
  check({{"solve", walls, "--planner", "lazy-prm", "--lazy", "expansion", "--save-roadmap", file},
         2,
         "--lazy: a roadmap"});
  check({{"solve", "maze:9x9", "--save-roadmap", path("no/folder")}, 73, "no/folder"});
  const std::string goals = folder_.write("g.scene", "bounds 0 0 9 9\nstart 1 1\ngoal 8 8\ngoal 1 8\n");
  check({{"solve", goals, "--planner", "prm", "--save-roadmap", file},
         2,
         "g.scene: its line 'goal': kept roadmaps are asked for one goal"});
  const std::string built = path("g.roadmap");
  ASSERT_EQ(run({"build", goals, "--planner", "prm", "--samples", "50", "-o", built}).code, 0);
  check({{"query", built}, 2, "--goal: the world has several"});
  EXPECT_EQ(run({"query", built, "--goal", "8,8"}).code, 0);
  const std::string mine = folder_.write("w.scene", "bounds 0 0 9 9\nstart 1 1\ngoal 8 8\n");
  check({{"solve", mine, "--planner", "prm", "--save-roadmap", mine}, 2, "would overwrite"});
  check({{"solve", mine, "--planner", "prm", "--save-roadmap", file, "--json", file}, 2, "would both write"});
  EXPECT_FALSE(std::filesystem::exists(file));
  check({{"solve", "maze:3000x3000", "--budget", "50ms", "--save-roadmap", file, "--quiet"}, 124, "stopped"});
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(RoadmapSave, StandardOutputTakesTheFileAlone) {
  const Outcome straight = run({"solve", "maze:9x9", "--save-roadmap", "-"});
  EXPECT_EQ(straight.code, 0) << straight.err;
  ASSERT_EQ(run({"build", "maze:9x9", "-o", path("b.roadmap")}).code, 0);
  EXPECT_TRUE(straight.out == folder_.read("b.roadmap"));
  check({{"solve", "maze:9x9", "--save-roadmap", "-", "--json", "-"}, 2, "standard output takes one of them"});
}

}  // namespace
}  // namespace warren::test
