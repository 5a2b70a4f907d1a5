// SPDX-License-Identifier: BSD-3-Clause
// What `warren solve` and the verbs around it promise: one answer for any number of threads, JSON alone on standard
// output, files that appear whole, signals that are heard.
#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;

Json solved(std::vector<std::string> arguments, int code = 0) {
  SCOPED_TRACE(shown(arguments));
  arguments.insert(arguments.begin(), "solve");
  arguments.insert(arguments.end(), {"--json", "-"});
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.code, code) << outcome.err;
  return Json::parse(outcome.out);
}

std::string without_times(Json answer) {
  for (const char* key : {"stages_s", "solve_s", "threads", "peak_memory_bytes"}) {
    EXPECT_TRUE(answer.contains(key)) << key;
    answer.erase(key);
  }
  return answer.dump();
}

TEST(Solve, AnswersAreTheSameForAnyNumberOfThreads) {
  const std::vector<std::vector<std::string>> questions{
      {"maze:31x23"},
      {"maze:61x61,loops=0.3"},
      {"maze:61x61,loops=0.3", "--pipeline", "plain"},
      {"maze:61x61,loops=0.3", "--search", "dijkstra"},
      {"maze:61x61", "--planner", "prm", "--sampler", "uniform"},
      {"maze:31x23", "--sampler", "uniform", "--seed", "7"},
      {"maze:31x23", "--sampler", "halton", "--planner", "prm", "--neighbours", "12"},
      {"maze:31x23", "--planner", "lazy-prm", "--lazy", "expansion"},
      {"maze:31x23,loops=0.1", "--optimise"},
      {"maze:31x23", "--sampler", "uniform", "--samples", "60"}};
  for (const auto& question : questions) {
    SCOPED_TRACE(shown(question));
    const int code = question.back() == "60" ? 1 : 0;
    std::string one;
    for (const char* threads : {"1", "2", "3", "8"}) {
      std::vector<std::string> arguments = question;
      arguments.insert(arguments.end(), {"--threads", threads});
      const std::string text = without_times(solved(arguments, code));
      if (one.empty()) one = text;
      EXPECT_EQ(text, one) << threads << " threads";
    }
  }
}

TEST(Solve, TheAnswerHasTheDocumentedKeysInTheirOrder) {
  const Json answer = solved({"maze:11x13,seed=3", "--seed", "5", "--threads", "2"});
  std::vector<std::string> keys;
  for (const auto& [key, value] : answer.items()) keys.push_back(key);
  std::size_t at = 0;
  for (const char* key : {"schema",
                          "warren_version",
                          "status",
                          "verified",
                          "length",
                          "min_clearance",
                          "raw_length",
                          "start",
                          "goal",
                          "clearance",
                          "contact",
                          "sampler",
                          "world",
                          "planner",
                          "search",
                          "seed",
                          "threads",
                          "options",
                          "roadmap",
                          "counters",
                          "stages_s",
                          "solve_s",
                          "peak_memory_bytes",
                          "path"}) {
    while (at < keys.size() && keys[at] != key) ++at;
    EXPECT_LT(at, keys.size()) << key << " is missing or out of order";
  }
  EXPECT_EQ(answer["schema"], "warren.answer/1");
  EXPECT_EQ(answer["status"], "solved");
  EXPECT_EQ(answer["verified"], true);
  EXPECT_TRUE(answer["raw_length"].is_null());
  EXPECT_EQ(answer["start"], Json::array({0.5, 1.0}));
  EXPECT_EQ(answer["goal"], Json::array({13.5, 11.0}));
  EXPECT_EQ(answer["clearance"], 0.1);
  EXPECT_EQ(answer["sampler"], "lattice");
  EXPECT_EQ(answer["planner"], "prm");
  EXPECT_EQ(answer["seed"], 5);
  EXPECT_EQ(answer["threads"], 2);
  EXPECT_EQ(answer["world"]["source"], "maze:11x13,seed=3");
  EXPECT_EQ(answer["world"]["walls"], 4 + 10 * 12);
  EXPECT_EQ(answer["world"]["hash"].get<std::string>().size(), 16U);
  EXPECT_EQ(answer["path"].front(), answer["start"]);
  EXPECT_EQ(answer["path"].back(), answer["goal"]);
}

TEST(Solve, NotConnectedNamesTheComponentsAndTheGap) {
  const Json answer = solved({"maze:21x21", "--sampler", "uniform", "--samples", "40"}, 1);
  EXPECT_EQ(answer["status"], "not_connected");
  EXPECT_GE(answer["components"]["start_size"], 1);
  EXPECT_GE(answer["components"]["goal_size"], 1);
  EXPECT_GT(answer["components"]["nearest_gap"], 0.0);
  EXPECT_TRUE(answer["path"].empty());
  EXPECT_TRUE(answer["length"].is_null());
}

TEST(Solve, ClearanceAndDiscRadiusAddUp) {
  const Json answer = solved({"maze:9x9", "--robot", "disc 0.2", "--clearance", "0.15", "--sampler", "uniform"});
  EXPECT_EQ(answer["clearance"], 0.15);
  EXPECT_EQ(answer["robot"], "disc 0.2");
  EXPECT_GE(answer["min_clearance"], 0.15);
}

TEST(Solve, JsonIsAloneOnStandardOutput) {
  const Outcome outcome = run({"solve", "maze:9x9", "--json", "-", "--progress", "plain"});
  EXPECT_TRUE(Json::accept(outcome.out)) << outcome.out;
  EXPECT_EQ(outcome.err, "");
}

TEST(Solve, ColorsFollowTheirRules) {
  const auto colored = [](const std::string& text) { return text.find('\x1b') != std::string::npos; };
  EXPECT_FALSE(colored(run({"solve", "maze:9x9"}).out)) << "not a terminal";
  EXPECT_TRUE(colored(run({"solve", "maze:9x9", "--color", "always"}).out));
  ::setenv("CLICOLOR_FORCE", "1", 1);
  EXPECT_TRUE(colored(run({"solve", "maze:9x9"}).out));
  EXPECT_FALSE(colored(run({"solve", "maze:9x9", "--color=never"}).out));
  ::setenv("NO_COLOR", "1", 1);
  EXPECT_FALSE(colored(run({"solve", "maze:9x9"}).out));
  ::setenv("NO_COLOR", "", 1);
  EXPECT_TRUE(colored(run({"solve", "maze:9x9"}).out)) << "an empty NO_COLOR means nothing";
  ::unsetenv("NO_COLOR");
  ::unsetenv("CLICOLOR_FORCE");
}

TEST(Solve, VerifyConfirmsWhatSolveSaysAndRefutesWhatIsChanged) {
  const Folder folder;
  Json answer = solved({"maze:9x9,seed=2", "--robot", "disc 0.1"});
  const auto verdict = [&](const Json& json, std::vector<std::string> more, int code) {
    std::vector<std::string> arguments{"verify", "maze:9x9,seed=2", folder.write("a.json", json.dump()), "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return Json::parse(outcome.out);
  };
  const Json good = verdict(answer, {}, 0);
  EXPECT_EQ(good["schema"], "warren.verify/1");
  EXPECT_EQ(good["verified"], true);
  EXPECT_EQ(good["length"], answer["length"]);
  EXPECT_EQ(good["min_clearance"], answer["min_clearance"]);
  EXPECT_TRUE(good["first_violation"].is_null());

  EXPECT_EQ(verdict(answer, {"--clearance", "0.45"}, 1)["verified"], false) << "options override the answer";
  EXPECT_EQ(verdict(answer, {"--start", "1,1"}, 1)["verified"], false);
  Json longer = answer;
  longer["length"] = 1.0;
  EXPECT_EQ(verdict(longer, {}, 1)["verified"], false) << "a wrong length";
  Json shortcut = answer;
  shortcut["path"] = Json::array({answer["start"], answer["goal"]});
  shortcut.erase("length");
  const Json bad = verdict(shortcut, {}, 1);
  EXPECT_EQ(bad["first_violation"]["leg"], 0);
  EXPECT_EQ(bad["first_violation"]["distance"], 0.0);
  EXPECT_NE(bad["first_violation"]["obstacle"].get<std::string>().find("wall"), std::string::npos);
}

TEST(Solve, AnotherWorldsAnswerIsRefused) {
  const Folder folder;
  const std::string file = folder.path("a.json");
  ASSERT_EQ(run({"solve", "maze:9x9,seed=2", "--json", file, "--quiet"}).code, 0);
  check({{"verify", "maze:9x9,seed=3", file}, 65, "another world"});
  check({{"render", "maze:9x9,seed=3", "--answer", file, "-o", folder.path("a.svg")}, 65, "another world"});
}

TEST(Solve, WorldsSurviveBeingConverted) {
  const Folder folder;
  ASSERT_EQ(run({"generate", "maze", "12x15", "--seed", "4", "--loops", "0.2", "-o", folder.path("a.walls")}).code, 0);
  ASSERT_EQ(run({"convert", folder.path("a.walls"), "-o", folder.path("b.npy")}).code, 0);
  ASSERT_EQ(run({"convert", folder.path("b.npy"), "-o", folder.path("c.scene")}).code, 0);
  const Json a = Json::parse(run({"info", folder.path("a.walls"), "--json", "-"}).out);
  for (const char* name : {"b.npy", "c.scene"}) {
    const Json b = Json::parse(run({"info", folder.path(name), "--json", "-"}).out);
    for (const char* key : {"kind", "walls", "hash", "maze", "start", "goal", "box"}) EXPECT_EQ(a[key], b[key]) << key;
  }
  EXPECT_EQ(a["kind"], "maze");
  EXPECT_EQ(a["maze"], Json::array({12, 15}));
}

TEST(Solve, UnitWallsAndMergedWallsAreTheSameMaze) {
  const Folder folder;
  ASSERT_EQ(run({"generate", "maze", "9x9", "--unit-walls", "-o", folder.path("unit.npy")}).code, 0);
  ASSERT_EQ(run({"generate", "maze", "9x9", "-o", folder.path("merged.npy")}).code, 0);
  const Json unit = solved({folder.path("unit.npy")});
  const Json merged = solved({folder.path("merged.npy")});
  const Json named = solved({"maze:9x9"});
  EXPECT_EQ(unit["path"], merged["path"]);
  EXPECT_EQ(unit["world"]["hash"], named["world"]["hash"]);
  EXPECT_GT(unit["world"]["walls"], merged["world"]["walls"]);
}

TEST(Solve, PicturesHaveTheirLayers) {
  const Folder folder;
  ASSERT_EQ(run({"solve", "maze:9x9", "--svg", folder.path("a.svg"), "--json", folder.path("a.json")}).code, 0);
  const std::string svg = folder.read("a.svg");
  EXPECT_EQ(svg.rfind("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"", 0), 0U) << svg.substr(0, 80);
  for (const char* id : {"walls", "milestones", "edges", "search_tree", "path", "start", "goal"}) {
    EXPECT_NE(svg.find("<g id=\"" + std::string{id} + "\""), std::string::npos) << id;
  }
  EXPECT_NE(svg.find("<g id=\"world\" transform="), std::string::npos);
  EXPECT_NE(svg.find("<title>"), std::string::npos);
  EXPECT_NE(svg.find("seed 1"), std::string::npos);
  EXPECT_EQ(run({"solve", "maze:9x9", "--svg", "-"}).out.rfind("<svg", 0), 0U) << "alone on standard output";
  for (const char* name : {"b.svg", "b.png", "b.html"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(run({"render", "maze:9x9", "--answer", folder.path("a.json"), "-o", folder.path(name)}).code, 0);
  }
  EXPECT_EQ(folder.read("b.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_NE(folder.read("b.html").find("\"path\":{\"type\":\"f64\""), std::string::npos);
}

TEST(Solve, TheTraceIsChromesFormat) {
  const Folder folder;
  ASSERT_EQ(run({"solve", "maze:31x31", "--trace", folder.path("t.json"), "--quiet"}).code, 0);
  const Json trace = Json::parse(folder.read("t.json"));
  bool verified = false;
  for (const Json& event : trace["traceEvents"]) {
    ASSERT_TRUE(event["ph"] == "X" || event["ph"] == "M");
    EXPECT_GE(event.value("dur", 0.0), 0.0);
    verified = verified || event["name"] == "verify";
  }
  EXPECT_TRUE(verified) << "each stage stands in the trace";
}

TEST(Solve, AReaderThatGoesAwayIsNoError) {
  const Folder folder;
  const std::string pipe = folder.path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  Process process({"generate", "maze", "500x500", "-o", "-"}, "/dev/null", pipe);
  char byte = 0;
  while (::read(reader, &byte, 1) <= 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::close(reader);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.code, 128 + SIGPIPE);
}

TEST(Solve, StandardInputIsAWorld) {
  const Folder folder;
  const std::string world = folder.write("w", "0 0 4 0\n0 4 4 4\n0 0 0 4\n4 0 4 4\nstart 1 1\ngoal 3 3\n");
  EXPECT_EQ(run({"solve", "-"}, world).code, 0);
}

TEST(Render, ARoadmapOfALatticeSaysHowManyWallsItsWorldHas) {
  const Folder folder;
  const std::string roadmap = folder.path("a.roadmap");
  const std::string built = run({"build", "maze:260x260", "-o", roadmap}).out;  // kept with the index of its routes
  const std::size_t walls = built.find(" maze, ");
  ASSERT_NE(walls, std::string::npos) << built;
  const std::string said = built.substr(walls, built.find(" walls", walls) - walls + 6);
  const std::string drawn = run({"render", roadmap, "-o", folder.path("a.svg")}).out;
  EXPECT_NE(drawn.find(said), std::string::npos) << drawn;
}

TEST(Verify, AWrongLengthIsSaidWithTheRightOne) {
  const Folder folder;
  const std::string answer = folder.path("a.json");
  ASSERT_EQ(run({"solve", "maze:5x5", "--json", answer, "--quiet"}).code, 0);
  std::string text = folder.read("a.json");
  const std::size_t at = text.find("\"length\":") + 9;
  const std::string length = text.substr(at, text.find(',', at) - at);
  text.replace(at, length.size(), " 3.0");
  const std::string said = run({"verify", "maze:5x5", folder.write("b.json", text)}).out;
  EXPECT_NE(said.find("refuted, length: the answer says 3, its path has "), std::string::npos) << said;
  EXPECT_EQ(said.find("asked for"), std::string::npos) << said;
}

}  // namespace
}  // namespace warren::test
