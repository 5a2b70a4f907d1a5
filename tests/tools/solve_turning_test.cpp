// SPDX-License-Identifier: BSD-3-Clause
// `warren solve` and `warren verify` for polygons that turn.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;

/// A bar that must turn to pass a bend.
constexpr const char* bend = R"(bounds -6 -6 6 6
robot polygon -1 -0.2 1 -0.2 1 0.2 -1 0.2
polygon -6 1 3.5 1 3.5 6 -6 6
polygon -6 -6 5 -6 5 -3 1 -3 1 -1 -6 -1
start -4.5 0 0
goal 4.7 4 1.5707963267948966
)";

class SolveTurning : public ::testing::Test {
 protected:
  Json solved(std::vector<std::string> more, int code = 0) const {
    std::vector<std::string> arguments{"solve", file_, "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    SCOPED_TRACE(shown(arguments));
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return Json::parse(outcome.out);
  }
  Folder folder_;
  std::string file_ = folder_.write("bend.scene", bend);
};

TEST_F(SolveTurning, EveryPlannerSolvesAndVerifies) {
  for (const char* planner : {"rrt-connect", "rrt", "prm", "lazy-prm"}) {
    const Json answer = solved({"--planner", planner, "--seed", "3"});
    EXPECT_EQ(answer["status"], "solved") << planner;
    EXPECT_EQ(answer["verified"], true);
    EXPECT_EQ(answer["planner"], planner);
    EXPECT_GT(answer["length"], 10.0);  // round the bend
    EXPECT_GE(answer["turn_rad"], 1.57);
    EXPECT_EQ(answer["path"].front(), Json::parse("[-4.5, 0.0, 0.0]"));
    EXPECT_EQ(answer["path"].back()[1], 4.0);
  }
}

/// Two obstacles leave a gap that the bar fits through lengthways; known lengths by hand.
TEST_F(SolveTurning, AtAFixedAngleThePathIsTheShortest) {
  const std::string straight = folder_.write("gap.scene", R"(bounds -6 -6 6 6
robot polygon -1 -0.2 1 -0.2 1 0.2 -1 0.2
polygon -1 -4 1 -4 1 2 -1 2
start -4 0 0
goal 4 0 0
)");
  // Round the box grown by the body: from (-4, 0) over (-2, 2.2) and (2, 2.2) to (4, 0).
  const double shortest = 4.0 + 2.0 * std::sqrt(4.0 + 2.2 * 2.2);
  for (const std::vector<std::string>& planner :
       {std::vector<std::string>{"visibility"}, std::vector<std::string>{"cells", "--doors", "funnel"}}) {
    std::vector<std::string> arguments{"solve", straight, "--json", "-", "--planner"};
    arguments.insert(arguments.end(), planner.begin(), planner.end());
    const Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json answer = Json::parse(outcome.out);
    EXPECT_EQ(answer["verified"], true);
    EXPECT_NEAR(answer["length"], shortest, 1e-7);
    EXPECT_EQ(answer["turn_rad"], 0.0);
    EXPECT_EQ(answer["roadmap"].contains("cells"), planner.front() == "cells");
    EXPECT_EQ(run({"solve", file_, "--planner", planner.front()}).code, 2);  // start and goal turn
  }
  const Outcome middles = run({"solve", straight, "--planner", "cells", "--json", "-"});
  EXPECT_GT(Json::parse(middles.out)["length"], shortest);
}

/// Ten convex polygons and a kite, whose Minkowski sums overlap: the study's scene poly-easy and its oracle.
TEST_F(SolveTurning, AtAFixedAngleTheStudysSceneHasItsLength) {
  const std::string scene = folder_.write("easy.scene", R"(bounds -4.29 -2.32 5.12 2.78
robot polygon 0.10 0.63 0.22 0.41 0.49 0.20 0.48 0.82
polygon 0.81 -0.87 1.03 -1.32 1.49 -1.38 1.76 -1.01 1.31 -0.47 0.81 -0.51
polygon 0.32 0.90 1.22 0.71 1.22 1.39 1.03 1.60 0.78 1.56 0.53 1.42 0.35 1.11
polygon -0.34 1.75 0.29 1.85 0.19 2.55 0.17 2.59 -0.32 2.68
polygon 2.01 0.10 2.18 -0.15 2.39 -0.25 2.74 -0.09 2.89 0.13 2.76 0.51 2.31 0.58
polygon -1.81 0.41 -1.73 -0.37 -0.96 -0.42 -1.25 0.06 -1.60 0.32
polygon -0.55 -0.22 0.10 0.07 0.23 0.13 0.25 0.18 0.29 0.62 -0.16 0.72
polygon 2.01 -1.07 2.02 -1.08 2.61 -0.82 2.92 -0.57 2.74 -0.34 2.30 -0.36
polygon -2.09 2.05 -1.88 1.52 -1.53 1.35 -1.32 1.32 -1.27 1.50 -1.33 1.78 -1.37 1.91 -1.64 2.04 -2.04 2.13
polygon 1.47 1.45 1.66 1.34 2.23 1.12 2.37 1.39 2.01 1.90 1.68 1.94
polygon -1.19 -2.00 -1.11 -2.03 -0.54 -2.22 -0.53 -1.57 -0.90 -1.58 -1.08 -1.73 -1.18 -1.91
start -3.14 0.23 0
goal 3.86 0.23 0
)");
  for (const char* search : {"astar", "dijkstra"}) {
    const Outcome outcome =
        run({"solve", scene, "--planner", "cells", "--doors", "funnel", "--search", search, "--json", "-"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NEAR(Json::parse(outcome.out)["length"], 8.897707, 1e-6);
  }
}

TEST_F(SolveTurning, AnswersAreTheSameForAnyNumberOfThreads) {
  std::string first;
  for (const char* threads : {"1", "2", "3", "8"}) {
    Json answer = solved({"--trees", "3", "--optimise", "--threads", threads});
    for (const char* key : {"stages_s", "solve_s", "threads", "peak_memory_bytes"}) answer.erase(key);
    if (first.empty()) first = answer.dump();
    EXPECT_EQ(answer.dump(), first);
  }
}

TEST_F(SolveTurning, OptimiseNeverLengthensAndIsVerified) {
  const Json answer = solved({"--optimise"});
  EXPECT_LE(answer["length"], answer["raw_length"]);
  EXPECT_EQ(answer["verified"], true);
}

TEST_F(SolveTurning, TakesGoalsWithoutHeadingAndWayPoints) {
  const Json open = solved({"--goal", "4.7,4"});
  EXPECT_EQ(open["goal"].size(), 2U);
  EXPECT_EQ(open["path"].back()[0], 4.7);
  const Json roadmap = solved({"--goal", "4.7,4", "--planner", "lazy-prm"});
  EXPECT_EQ(roadmap["verified"], true);
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{}, {"--optimise"}}) {
    std::vector<std::string> words{"--via", "2,0,0;4.5,0"};
    words.insert(words.end(), more.begin(), more.end());
    const Json guided = solved(words);
    bool passed = false;
    for (const Json& state : guided["path"]) passed = passed || (state[0] == 4.5 && state[1] == 0.0);
    EXPECT_TRUE(passed) << "what is shortened passes it, too";
  }
}

TEST_F(SolveTurning, VerifyAgreesAndRefutesABrokenPath) {
  const std::string answer_file = folder_.path("answer.json");
  ASSERT_EQ(run({"solve", file_, "--json", answer_file, "--quiet"}).code, 0);
  const Outcome good = run({"verify", file_, answer_file});
  EXPECT_EQ(good.code, 0) << good.err;
  Json answer = Json::parse(folder_.read("answer.json"));
  answer["path"] = Json::array({answer["path"].front(), answer["path"].back()});
  folder_.write("answer.json", answer.dump());
  EXPECT_EQ(run({"verify", file_, answer_file}).code, 1);
}

TEST_F(SolveTurning, SaysWhatIsWrongInOneLine) {
  struct Case {
    std::vector<std::string> arguments;
    const char* says;
  };
  const std::vector<Case> cases = {{{"--start", "0,0"}, "X,Y,THETA"},
                                   {{"--start", "0,0,2000"}, "--start: a heading is at most 1000 rad"},
                                   {{"--goal", "0,0,-1e16"}, "--goal: a heading"},
                                   {{"--via", "0,0,1e16"}, "--via: a heading"},
                                   {{"--start", "0,0,2000", "--planner", "grid", "--cell", "1"}, "--start: a heading"},
                                   {{"--sampler", "lattice"}, "lattice"},
                                   {{"--step", "0"}, "--step"},
                                   {{"--goal-bias", "2", "--planner", "rrt"}, "--goal-bias"},
                                   {{"--goal-bias", "0.1"}, "rrt"},
                                   {{"--trees", "0"}, "--trees"},
                                   {{"--contact", "allowed"}, "--contact"},
                                   {{"--samples", "10"}, "--samples"},
                                   {{"--via", "0,5"}, "way-point 1"},
                                   {{"--via", "0,0,0,0"}, "--via"},
                                   {{"--planner", "prm", "--neighbours", "star", "--radius", "2"}, "PRM*"}};
  for (const Case& c : cases) {
    std::vector<std::string> arguments{"solve", file_};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << shown(arguments) << outcome.err;
    EXPECT_NE(outcome.err.find(c.says), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

TEST_F(SolveTurning, EndsWithoutAPathAreAnswers) {
  EXPECT_EQ(solved({"--start", "0,3,0"}, 1)["status"], "start_blocked");
  EXPECT_EQ(solved({"--goal", "0,3"}, 1)["status"], "goal_blocked");
  const Json answer = solved({"--nodes", "2"}, 1);  // start and goal are two
  EXPECT_EQ(answer["status"], "not_connected");
  EXPECT_GT(answer["components"]["nearest_gap"], 0.0);
}

TEST_F(SolveTurning, DrawsTheSweepAndTheTree) {
  const std::string svg = folder_.path("sweep.svg");
  ASSERT_EQ(run({"solve", file_, "--svg", svg, "--quiet"}).code, 0);
  const std::string text = folder_.read("sweep.svg");
  EXPECT_NE(text.find("id=\"sweep\""), std::string::npos);
  EXPECT_NE(text.find("id=\"edges\""), std::string::npos);
}

}  // namespace
}  // namespace warren::test
