// SPDX-License-Identifier: BSD-3-Clause
// `warren build`, `query`, `update`, `export` and `info` of roadmaps, as a user runs them.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

class RoadmapVerbs : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  /// The JSON that a verb prints, which ends with this exit code.
  static Json told(const Words& words, int code = 0) {
    SCOPED_TRACE(shown(words));
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    const Json json = Json::parse(outcome.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << outcome.out;
    return json;
  }
  static void runs(const Words& words) {
    SCOPED_TRACE(shown(words));
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  std::string built(const std::string& name, const std::string& world, const Words& more = {}) const {
    runs(joined({"build", world, "-o", path(name), "--quiet"}, more));
    return path(name);
  }

  Folder folder_;
};

struct SameCase {
  std::string world;
  Words body;    // of build and solve
  Words ends;    // of query and solve
  Words method;  // of solve alone
  Words search;  // of query and solve
};

void expect_same(const Json& answer, const Json& expected) {
  for (const char* key : {"status", "verified", "length", "path", "start", "goal", "robot", "clearance", "planner",
                          "sampler", "search", "seed", "world"}) {
    EXPECT_EQ(answer[key], expected[key]) << key;
  }
  EXPECT_EQ(answer["counters"]["expanded"], expected["counters"]["expanded"]);
}

TEST_F(RoadmapVerbs, AQueryAnswersAsSolveDoes) {
  const Words few{"--samples", "300", "--seed", "5"};
  const std::vector<SameCase> cases{
      {"maze:9x13,loops=0.1", {"--planner", "prm"}, {}, {"--pipeline", "plain"}, {}},
      {"maze:9x13", joined(few, {"--planner", "lazy-prm", "--clearance", "0.2"}), {"--goal", "3,4"}, {}, {}},
      {world_file("walls.scene"), joined(few, {"--planner", "prm"}), {}, {}, {"--search", "dijkstra"}},
      {world_file("walls.scene"), joined(few, {"--planner", "lazy-prm"}), {}, {}, {"--optimise"}},
      {world_file("town.geojson"),
       joined(few, {"--planner", "lazy-prm", "--robot", "disc 0.05"}),
       {"--start", "1.5,1.5", "--goal", "9.5,8.5"},
       {},
       {"--queue", "sorted-array"}},
      {world_file("poly-easy.scene"), joined(few, {"--planner", "prm"}), {}, {}, {}},
      {world_file("parking-lot.scene"), joined(few, {"--planner", "prm"}), {}, {}, {}},
      {world_file("car-20.scene"), joined(few, {"--planner", "lazy-prm"}), {}, {}, {}},
      {world_file("puma.scene"), joined(few, {"--planner", "prm"}), {}, {}, {"--attach", "3"}},
      {world_file("flat.yaml"),
       joined(few, {"--planner", "prm", "--robot", "disc 0.05"}),
       {"--start", "1,1", "--goal", "3,1"},
       {},
       {}},
      {world_file("walls.scene"), joined(few, {"--planner", "prm"}), {"--start=-99,0,0"}, {}, {}}};
  std::size_t solved = 0;
  for (const SameCase& c : cases) {
    const std::string file = built("r.roadmap", c.world, c.body);
    SCOPED_TRACE(shown(joined({"build", c.world}, c.body)));
    const Words asked = joined(joined(c.ends, c.search), {"--json", "-"});
    const Outcome expected = run(joined(joined(joined({"solve", c.world}, c.body), c.method), asked));
    const Json answer = told(joined({"query", file}, asked), expected.code);
    expect_same(answer, Json::parse(expected.out));
    solved += answer["status"] == "solved" ? 1 : 0;
  }
  EXPECT_GE(solved, cases.size() - 3);
}

TEST_F(RoadmapVerbs, AQueryDrawsAPicture) {
  runs({"query", built("r.roadmap", "maze:5x5"), "--svg", path("r.svg"), "--quiet"});
  EXPECT_NE(folder_.read("r.svg").find("</svg>"), std::string::npos);
}

TEST_F(RoadmapVerbs, TheFileIsTheSameForAnyNumberOfThreads) {
  for (const Words& body : {Words{"--planner", "prm"}, {"--planner", "lazy-prm", "--sampler", "uniform"}}) {
    std::string first;
    for (const char* threads : {"1", "2", "7"}) {
      built("r.roadmap", "maze:31x33,loops=0.1", joined(body, {"--threads", threads}));
      const std::string bytes = folder_.read("r.roadmap");
      if (first.empty()) first = bytes;
      EXPECT_TRUE(bytes == first) << threads << " threads";
    }
    EXPECT_GT(first.size(), 10'000U);
  }
}

TEST_F(RoadmapVerbs, WithoutItsWorldAFileIsSmallerAndNeedsIt) {
  const std::string world = "maze:11x11";
  const std::string whole = built("whole.roadmap", world);
  const std::string bare = built("bare.roadmap", world, {"--no-world"});
  EXPECT_LT(folder_.read("bare.roadmap").size(), folder_.read("whole.roadmap").size());
  check({{"query", bare}, 65, "has no world inside"});
  check({{"query", bare, "--world", "maze:11x12"}, 65, "is another one"});
  check({{"query", whole, "--world", "maze:11x12"}, 65, "is another one"});
  expect_same(told({"query", bare, "--world", world, "--json", "-"}), told({"query", whole, "--json", "-"}));
  check({{"update", bare, world, "-o", path("u.roadmap")}, 65, "has no world inside"});
  runs({"update", bare, world, "--world", world, "-o", path("u.roadmap")});
  EXPECT_TRUE(folder_.read("u.roadmap") == folder_.read("whole.roadmap"));
  check({{"export", bare, "-o", path("b.csv")}, 65, "has no world inside"});
  runs({"export", bare, "--world", world, "-o", path("b.csv")});
  runs({"info", bare, "--check", "all"});
}

TEST_F(RoadmapVerbs, WhatAQueryHasLearntIsKeptWhereItIsAskedFor) {
  const std::string file = built("lazy.roadmap", "maze:9x9", {"--planner", "lazy-prm", "--samples", "900"});
  const std::string before = folder_.read("lazy.roadmap");
  const Json first = told({"query", file, "--keep", path("learnt.roadmap"), "--json", "-"});
  EXPECT_TRUE(folder_.read("lazy.roadmap") == before);
  const Json unknown = told({"info", file})["edges"];
  const Json known = told({"info", path("learnt.roadmap")})["edges"];
  EXPECT_EQ(unknown["free"], 0);
  EXPECT_GT(known["free"], 0);
  const auto all = [](const Json& edges) {
    return edges["free"].get<int>() + edges["blocked"].get<int>() + edges["unchecked"].get<int>();
  };
  EXPECT_EQ(all(known), all(unknown));
  const Json second = told({"query", path("learnt.roadmap"), "--json", "-"});
  expect_same(second, first);
  EXPECT_LT(second["counters"]["edges_checked"], first["counters"]["edges_checked"]);
  const Outcome straight = run({"query", file, "--keep", "-"});
  EXPECT_TRUE(straight.out == folder_.read("learnt.roadmap")) << "more than the file on standard output";
}

TEST_F(RoadmapVerbs, AnUpdateIsABuildInTheNewWorld) {
  const std::string text = "bounds 0 0 10 10\n2 0 2 6\n5 10 5 4\n8 0 8 6\nstart 1 1\ngoal 9 1\n";
  const std::string before = folder_.write("before.scene", text);
  const std::string now = folder_.write("now.scene", text + "2.5 9 3.5 9\n");
  const Words body{"--planner", "prm", "--samples", "400"};
  const std::string file = built("before.roadmap", before, body);
  built("now.roadmap", now, body);
  const Json report = told({"update", file, now, "-o", path("updated.roadmap"), "--report", "-"});
  EXPECT_TRUE(folder_.read("updated.roadmap") == folder_.read("now.roadmap"));
  EXPECT_EQ(report["schema"], "warren.update/1");
  EXPECT_EQ(report["mode"], "changed");
  EXPECT_GT(report["edges_checked"], 0);
  EXPECT_LT(report["edges_checked"].get<int>(), report["edges"].get<int>() / 2);
  EXPECT_EQ(report.size(), 6U);
  runs({"update", file, before, "-o", path("same.roadmap"), "--report", path("same.json"), "--quiet"});
  EXPECT_TRUE(folder_.read("same.roadmap") == folder_.read("before.roadmap"));
  EXPECT_EQ(Json::parse(folder_.read("same.json"))["edges_checked"], 0);
  const std::string grown = built("grown.roadmap", before, {"--planner", "prm"});
  EXPECT_EQ(told({"update", grown, now, "-o", path("u.roadmap"), "--report", "-"})["mode"], "built");
}

TEST_F(RoadmapVerbs, WhatIsNotDrawnIsBuiltAnewByAnUpdate) {
  const std::string text = "bounds 0 0 10 10\npolygon 2 2 4 2 4 6 2 6\nstart 1 1\ngoal 9 1\n";
  const std::string before = folder_.write("before.scene", text);
  const std::string now = folder_.write("now.scene", text + "polygon 6 0.5 7 0.5 7 8 6 8\n");
  for (const char* planner : {"visibility", "cells", "voronoi"}) {
    SCOPED_TRACE(planner);
    const Words body{"--planner", planner};
    const std::string file = built("before.roadmap", before, body);
    built("now.roadmap", now, body);
    const Json report = told({"update", file, now, "-o", path("updated.roadmap"), "--report", "-"});
    EXPECT_TRUE(folder_.read("updated.roadmap") == folder_.read("now.roadmap"));
    EXPECT_EQ(report["mode"], "built");
    EXPECT_EQ(report["edges"], told({"info", path("now.roadmap")})["edges"]["free"]);
    EXPECT_EQ(report["edges_checked"], report["edges"]);
    EXPECT_GT(report["states_added"], 0);
    const Words asked{"--json", "-"};
    expect_same(told(joined({"query", path("now.roadmap")}, asked)),
                told(joined({"solve", now, "--planner", planner}, asked)));
  }
}

TEST_F(RoadmapVerbs, TheAxisOfAMapIsARouteGraph) {
  const std::string axis =
      built("axis.roadmap", world_file("flat.yaml"), {"--planner", "voronoi", "--robot", "disc 0.05"});
  const Json meta = told({"info", axis, "--check", "all"});
  EXPECT_EQ(meta["planner"], "voronoi");
  EXPECT_GT(meta["edges"]["free"], 20);
  for (const char* name : {"r.geojson", "r.graphml", "r.gr", "r.csv", "r.npz", "r.dot"}) {
    runs({"export", axis, "-o", path(name), "--quiet"});
  }
  const Json route = Json::parse(folder_.read("r.geojson"));
  EXPECT_EQ(route["features"].size(), meta["states"].get<std::size_t>() + 2 * meta["edges"]["free"].get<std::size_t>());
  const Words ends{"--start", "1,1", "--goal", "3,1"};
  const Json answer = told(joined({"query", axis, "--json", "-"}, ends));
  const std::string questions = folder_.write("q.csv", "start_x,start_y,goal_x,goal_y\n1,1,3,1\n");
  const Json length = told({"query", axis, "--batch", questions, "--lengths-only", "--quiet"});
  EXPECT_EQ(length["status"], "solved");
  EXPECT_EQ(length["length"], answer["length"]);
  check(
      {joined({"build", world_file("flat.yaml"), "-o", path("n.roadmap")}, {"--planner", "voronoi", "--search", "bfs"}),
       2, "--search"});
}

TEST_F(RoadmapVerbs, AreExportedByEnding) {
  const std::string car = built("car.roadmap", world_file("parking-lot.scene"), {"--samples", "200"});
  const std::vector<std::pair<std::string, std::string>> files{{"x.geojson", "\"FeatureCollection\""},
                                                               {"x.graphml", "</graphml>"},
                                                               {"x.gr", "c weights are lengths in units of"},
                                                               {"x.co", "c coordinates are in units of"},
                                                               {"x.csv", "id,x,y,theta,component"},
                                                               {"x.edges.csv", "from,to,length,state"},
                                                               {"x.npz", "indptr.npy"},
                                                               {"x.dot", "graph"}};
  for (const char* name : {"x.geojson", "x.graphml", "x.gr", "x.csv", "x.npz", "x.dot"}) {
    runs({"export", car, "-o", path(name)});
  }
  for (const auto& [name, said] : files) EXPECT_NE(folder_.read(name).find(said), std::string::npos) << name;
  runs({"export", car, "-o", path("y.geojson"), "--frame", "odom"});
  EXPECT_NE(folder_.read("y.geojson").find("\"odom\""), std::string::npos);
  check({{"export", car, "-o", path("x.bin")}, 2, ".geojson .graphml .gr .csv .npz .dot"});
  const std::string lazy = built("lazy.roadmap", "maze:5x5", {"--planner", "lazy-prm", "--samples", "99"});
  runs({"export", lazy, "-o", path("without.csv")});
  runs({"export", lazy, "-o", path("with.csv"), "--unchecked"});
  EXPECT_EQ(folder_.read("without.edges.csv"), "from,to,length,state\n");
  EXPECT_NE(folder_.read("with.edges.csv").find("unchecked"), std::string::npos);
}

TEST_F(RoadmapVerbs, InfoSaysWhatTheFileSaysOfItself) {
  const std::string file = built("r.roadmap", "maze:7x9", {"--planner", "prm", "--seed", "4"});
  const Json meta = told({"info", file});
  EXPECT_EQ(meta["schema"], "warren.roadmap/1");
  EXPECT_EQ(meta["source"], "maze:7x9");
  EXPECT_EQ(meta["planner"], "prm");
  EXPECT_EQ(meta["seed"], 4);
  EXPECT_EQ(meta["states"], 63);
  EXPECT_EQ(meta["edges"], Json::parse(R"({"unchecked": 0, "free": 62, "blocked": 48})"));
  EXPECT_EQ(meta["components"], 1);
  EXPECT_EQ(told({"info", file, "--check", "all", "--json", "-"}), meta);
  check({{"info", "maze:7x9", "--check", "all"}, 2, "is for roadmap files"});
  EXPECT_EQ(Json::parse(Process({"info", "-", "--check", "all"}, file).wait().out), meta);
  const std::string world = folder_.write("w.scene", "bounds 0 0 9 9\nstart 1 1\ngoal 8 8\n");
  EXPECT_NE(Process({"info", "-"}, world).wait().out.find("9"), std::string::npos);
}

TEST_F(RoadmapVerbs, ALazyCarCountsItsEdgesAsSolveDoes) {
  const std::string car = world_file("car-20.scene");
  const Words body{"--planner", "lazy-prm", "--samples", "300", "--seed", "5"};
  const Json answer = told({"query", built("r.roadmap", car, body), "--json", "-"});
  const Json expected = told(joined({"solve", car, "--json", "-"}, body));
  EXPECT_EQ(answer["roadmap"]["edges"], expected["roadmap"]["edges"]);
  EXPECT_EQ(answer["counters"]["edges_checked"], expected["counters"]["edges_checked"]);
}

TEST_F(RoadmapVerbs, AnUpdateTakesTheIndexThatABuildWouldTake) {
  const std::string large = "maze:300x257,loops=0.02";
  const std::string indexed = built("indexed.roadmap", large);
  const std::string plain = built("plain.roadmap", large, {"--index", "none"});
  const std::string small = built("small.roadmap", "maze:9x9");
  EXPECT_EQ(told({"info", plain})["asked_index"], "none");
  EXPECT_FALSE(told({"info", small}).contains("asked_index"));
  const Json report = told({"update", small, large, "-o", path("u.roadmap"), "--report", "-"});
  EXPECT_TRUE(folder_.read("u.roadmap") == folder_.read("indexed.roadmap"));
  EXPECT_EQ(report["mode"], "built");
  EXPECT_EQ(report["states_added"], 300 * 257 - 81);
  EXPECT_EQ(report["states_dropped"], 0);
  runs({"update", plain, large, "-o", path("u.roadmap")});
  EXPECT_TRUE(folder_.read("u.roadmap") == folder_.read("plain.roadmap"));
  runs({"update", indexed, "maze:9x9", "-o", path("u.roadmap")});
  EXPECT_TRUE(folder_.read("u.roadmap") == folder_.read("small.roadmap"));
}

TEST_F(RoadmapVerbs, TheStarRuleByRadiusNeedsAVolume) {
  check({{"build", world_file("car-20.scene"), "--samples", "50", "--radius", "star", "-o", path("r.roadmap")},
         2,
         "--radius: star: this world doesn't tell its volume; say --neighbours star"});
}

TEST_F(RoadmapVerbs, AStopLeavesTheFileAsItWas) {
  const std::string file = folder_.write("big.roadmap", "old");
  const Words words{"build", "maze:4000x4000", "-o", file, "--memory", "64GiB"};
  check({joined(words, {"--budget", "100ms"}), 124, "the time budget ended"});
  Process process(joined(words, {"--quiet"}));
  process.wait_until_it_works_for(std::chrono::milliseconds(100));
  process.send(SIGTERM);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.code, 143);
  EXPECT_EQ(outcome.err, "warren: stopped: terminated\n");
  EXPECT_EQ(folder_.read("big.roadmap"), "old");
  std::filesystem::remove(file);
  EXPECT_TRUE(folder_.is_empty());
}

}  // namespace
}  // namespace warren::test
