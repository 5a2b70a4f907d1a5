// SPDX-License-Identifier: BSD-3-Clause
// What --explain tells, against what is known of the worlds otherwise: components, the gap, the narrowest place, hints.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/tools/grid_worlds.hpp"
#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Words = std::vector<std::string>;

/// A wall from below and one from above leave a gap of 0.6 at x = 5.
constexpr const char* gap_world = "bounds 0 0 10 4\nwall 5 0 5 1.7\nwall 5 2.3 5 4\nstart 1 1\ngoal 9 3\n";
/// The same without the gap.
constexpr const char* shut_world = "bounds 0 0 10 4\nwall 5 0 5 4\nstart 1 1\ngoal 9 3\n";

Json explained(const Words& words, int code = 0) {
  const Outcome outcome = run(joined(words, {"--explain", "--json", "-"}));
  EXPECT_EQ(outcome.code, code) << shown(words) << outcome.err;
  const Json answer = Json::parse(outcome.out, nullptr, false);
  EXPECT_TRUE(answer.contains("explained")) << outcome.out;
  return answer.value("explained", Json());
}

/// The options apart by blanks.
std::string text_of(const Json& hint) {
  std::string text;
  for (const Json& word : hint["options"]) text += (text.empty() ? "" : " ") + word.get<std::string>();
  return text;
}

bool any_hint(const Json& told, const std::string& said) {
  const auto& hints = told["hints"];
  return std::any_of(hints.begin(), hints.end(),
                     [&](const Json& hint) { return text_of(hint).find(said) != std::string::npos; });
}

TEST(Explain, AMazeIsOneComponentAndAllOfItIsKept) {
  const Json told = explained({"solve", "maze:9x11"});
  EXPECT_EQ(told["samples"]["drawn"], 99);
  EXPECT_EQ(told["samples"]["kept"], 99);
  EXPECT_EQ(told["components"]["count"], 1);
  EXPECT_EQ(told["components"]["milestones"], 101);
  EXPECT_EQ(told["components"]["largest"], 101);
  EXPECT_EQ(told["components"]["joined"], true);
  EXPECT_EQ(told["motions"]["free"], 100);  // a tree
  EXPECT_EQ(told["hints"].size(), 0U);
}

TEST(Explain, PlannersThatGetBetterAreToldMoreTurns) {
  const Folder folder;
  const std::string shut = folder.write("shut.scene", shut_world);
  EXPECT_TRUE(any_hint(explained({"solve", shut, "--planner", "anytime", "--iterations", "8"}, 1), "--iterations 32"));
  const std::string open = folder.write("open.scene", "bounds 0 0 10 4\nwall 5 0 5 3\nstart 1 1\ngoal 9 1\n");
  EXPECT_TRUE(any_hint(explained({"solve", open, "--planner", "rrt-star", "--iterations", "20"}), "--iterations 80"));
}

TEST(Explain, AWallMakesTwoComponentsAndTheGapStandsAtIt) {
  const Folder folder;
  const std::string world = folder.write("w.scene", shut_world);
  const Words words{"solve", world, "--planner", "prm", "--sampler", "uniform", "--samples", "200"};
  const Json told = explained(words, 1);
  const Json& parts = told["components"];
  EXPECT_EQ(parts["count"], 2);
  EXPECT_EQ(parts["joined"], false);
  EXPECT_EQ(parts["of_start"].get<int>() + parts["of_goal"].get<int>(), parts["milestones"].get<int>());
  EXPECT_EQ(parts["largest"], std::max(parts["of_start"], parts["of_goal"]));
  EXPECT_TRUE(any_hint(told, "--samples"));
  EXPECT_FALSE(any_hint(told, "--sampler bridge")) << "nothing lies in an obstacle here";
  const std::string text = run(joined(words, {"--explain"})).out;
  const std::size_t gap = text.find("between what start and goal reach, from ");
  ASSERT_NE(gap, std::string::npos) << text;
  const double from = std::strtod(text.c_str() + gap + 40, nullptr);
  EXPECT_TRUE(from > 3.0 && from < 5.0) << text;
}

/// The nearer end of the two walls is as far as is said.
void expect_at_the_gap(const Json& narrow) {
  SCOPED_TRACE(narrow.dump());
  const double x = narrow["place"][0].get<double>();
  const double y = narrow["place"][1].get<double>();
  const double room = std::min(std::hypot(x - 5.0, y - 1.7), std::hypot(x - 5.0, y - 2.3));
  EXPECT_NEAR(narrow["clearance"].get<double>(), room, 2e-3);
  EXPECT_GE(narrow["clearance"], 0.1);
  EXPECT_LE(narrow["clearance"], 0.3 + 1e-9);
}

TEST(Explain, TheNarrowestPlaceIsWhereTheGapIs) {
  const Folder folder;
  const std::string world = folder.write("w.scene", gap_world);
  const std::string answer = folder.path("a.json");
  for (const char* planner : {"prm", "lazy-prm", "voronoi", "grid"}) {
    const Words words{"solve", world, "--planner", planner, "--clearance", "0.1", "--seed", "3"};
    const Json told = explained(words);
    const Json& narrow = told["narrowest"];
    expect_at_the_gap(narrow);
  }
  ASSERT_EQ(run({"solve", world, "--clearance", "0.1", "--json", answer, "--quiet"}).code, 0);
  const Outcome verified = run({"verify", world, answer, "--explain", "--json", "-"});
  expect_at_the_gap(Json::parse(verified.out)["narrowest"]);
  EXPECT_NE(run({"verify", world, answer, "--explain"}).out.find("of room on leg"), std::string::npos);
}

TEST(Explain, ABlockedEndIsToldWhereItFits) {
  const Folder folder;
  const std::string world = folder.write("w.scene", gap_world);
  const Json told = explained({"solve", world, "--robot", "disc 0.2", "--start", "5,1"}, 1);
  EXPECT_TRUE(any_hint(told, "--start ")) << told;
}

TEST(Explain, TreesThatGiveUpAreToldOfNodes) {
  const Folder folder;
  const std::string world = folder.write("w.scene", shut_world);
  const Json told = explained({"solve", world, "--robot", "polygon 0 0 0.3 0 0 0.3", "--start", "1,1,0", "--goal",
                               "9,3,0", "--planner", "rrt", "--nodes", "50"},
                              1);
  EXPECT_EQ(told["samples"]["dropped"], 0);
  EXPECT_GE(told["motions"]["free"], 49);
  EXPECT_TRUE(any_hint(told, "--nodes"));
}

TEST(Explain, AKeptRoadmapIsExplainedAsAnswersAre) {
  const Folder folder;
  const std::string world = folder.write("w.scene", gap_world);
  const std::string roadmap = folder.path("r.roadmap");
  ASSERT_EQ(run({"build", world, "--planner", "prm", "--samples", "300", "-o", roadmap}).code, 0);
  const Json told = explained({"query", roadmap});
  EXPECT_EQ(told["components"]["joined"], true);
  check({{"query", roadmap, "--batch", world, "--explain"}, 2, "--explain: is for one question"});
  check({{"query", roadmap, "--batch", world, "--dpi", "96"}, 2, "--dpi: is for one question"});
  check({{"query", roadmap, "--matrix", world, world, "--path", "p.csv"}, 2, "--path: is for one question"});
}

/// The command with the hint's options instead of its own.
Words followed(Words words, const Json& hint) {
  const Json& options = hint["options"];
  const std::string name = options[0].get<std::string>();
  const auto old = std::find(words.begin(), words.end(), name.substr(0, name.find('=')));
  if (old != words.end()) words.erase(old, old + 2);
  for (const Json& word : options) words.push_back(word.get<std::string>());
  return words;
}

TEST(Explain, EveryHintIsTaken) {
  const Folder folder;
  const std::string shut = folder.write("w.scene", shut_world);
  const std::string slit = folder.write("s.scene",
                                        "bounds 0 0 10 4\npolygon 4 0 6 0 6 2.1 4 2.1\npolygon 4 2.2 6 2.2 6 4 4 4\n"
                                        "start 1 1\ngoal 9 3\n");
  const std::string map = folder.write("a.map", "type octile\nheight 3\nwidth 5\nmap\n..@..\n..@..\n..@..\n");
  const Words turning{"--robot", "polygon 0 0 0.3 0 0 0.3", "--start", "1,1,0", "--goal", "9,3,0"};
  const Words ends{"--start", "0.5,0.5", "--goal", "4.5,0.5"};
  std::vector<Words> asked;
  for (const char* sampler : {"uniform", "halton", "random", "bridge", "gaussian", "mixture"}) {
    for (const char* planner : {"prm", "lazy-prm"}) {
      for (const std::string& world : {shut, slit}) {
        asked.push_back({"solve", world, "--planner", planner, "--sampler", sampler, "--samples", "30"});
      }
    }
  }
  asked.push_back(
      {"solve", shut, "--robot", "disc 0.2", "--clearance", "0.1", "--samples", "2147483648", "--budget", "1ms"});
  asked.push_back({"solve", shut, "--robot", "disc 0.2", "--radius", "0.4", "--samples", "50"});
  asked.push_back({"solve", shut, "--robot", "disc 0.2", "--neighbours", "4096", "--samples", "50"});
  for (const char* planner : {"voronoi", "grid"})
    asked.push_back({"solve", shut, "--planner", planner, "--robot", "disc 0.2"});
  for (const char* planner : {"rrt", "rrt-connect"})
    asked.push_back(joined({"solve", shut, "--planner", planner, "--nodes", "50", "--step", "0.2"}, turning));
  asked.push_back(joined({"solve", shut, "--planner", "grid", "--cell", "0.5", "--angles", "8"}, turning));
  for (const char* planner : {"prm", "lazy-prm", "grid", "voronoi"})
    asked.push_back(joined({"solve", map, "--planner", planner}, ends));
  asked.push_back({"solve", slit, "--robot", "disc 0.2", "--start", "5,1"});
  asked.push_back({"solve", slit, "--start", "12,1"});
  for (const Words& words : asked) {
    SCOPED_TRACE(shown(words));
    const Outcome outcome = run(joined(words, {"--explain", "--json", "-"}));
    ASSERT_FALSE(outcome.out.empty()) << outcome.err;
    const Json answer = Json::parse(outcome.out);
    for (const Json& hint : answer["explained"]["hints"]) {
      if (hint["options"].empty()) continue;
      const Outcome tried = run(joined(followed(words, hint), {"--budget", "3s", "--json", "-"}));
      EXPECT_NE(tried.code, 2) << hint << tried.err;
      if (answer.contains("blocked") && !answer["blocked"].is_null()) {
        EXPECT_NE(Json::parse(tried.out)["status"], answer["status"]) << hint;
      }
    }
    EXPECT_TRUE(answer["status"] != "not_connected" || !answer["explained"]["hints"].empty());
  }
}

TEST(Explain, KeptRoadmapsAreToldToBeBuiltWithMore) {
  const Folder folder;
  const std::string world = folder.write("w.scene", shut_world);
  const std::string roadmap = folder.path("r.roadmap");
  const Words build{"build", world, "--planner", "prm", "--samples", "300", "-o", roadmap};
  ASSERT_EQ(run(build).code, 0);
  const Json told = explained({"query", roadmap}, 1);
  EXPECT_TRUE(any_hint(told, "--samples 1200")) << told;
  EXPECT_NE(run({"query", roadmap, "--explain"}).out.find("warren build with --samples 1200"), std::string::npos);
  for (const Json& hint : told["hints"]) {
    EXPECT_EQ(hint["command"], "build");
    EXPECT_NE(run(followed(build, hint)).code, 2) << hint;
  }
}

TEST(Explain, ARunThatEndsBeforeItsWorldIsReadIsToldToTakeLonger) {
  for (const Words& words : {Words{"solve", "maze:9x11"}, Words{"query", "absent.roadmap"}}) {
    const Json told = explained(joined(words, {"--budget", "1us"}), 124);
    ASSERT_EQ(told["hints"].size(), 1U) << told;
    EXPECT_NE(told["hints"][0]["why"].get<std::string>().find("--budget"), std::string::npos) << told;
    EXPECT_EQ(told["components"], nullptr);
  }
}

TEST(Explain, IsTheSameForAnyNumberOfThreads) {
  const Folder folder;
  const std::string world = folder.write("w.scene", gap_world);
  for (const char* planner : {"prm", "rrt-connect", "lazy-prm"}) {
    const Words words{"solve",   world,   "--planner", planner, "--robot",  "polygon 0 0 0.2 0 0 0.2",
                      "--start", "1,1,0", "--goal",    "9,3,0", "--threads"};
    EXPECT_EQ(explained(joined(words, {"1"})), explained(joined(words, {"3"}))) << planner;
  }
}

}  // namespace
}  // namespace warren::test
