// SPDX-License-Identifier: BSD-3-Clause
// `warren solve`, `verify`, `info`, `compare` and pictures for arms.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;

/// A Puma that must go round a pillar and over a table: the straight joint line is blocked.
constexpr const char* pillar = R"(robot puma560 radius 0.05
box 0.35 -0.1 -0.3 0.55 0.1 1.2
box -1 -1 -0.8 1 1 -0.7
sphere -0.6 0.2 0.3 0.15
start -0.9 0.3 -0.4 0 0 0
goal 0.9 0.3 -0.4 0 0 0
)";

class SolveArm : public ::testing::Test {
 protected:
  Json solved(std::vector<std::string> more, int code = 0) const { return solved_in(file_, std::move(more), code); }
  static Json solved_in(const std::string& file, std::vector<std::string> more, int code = 0) {
    std::vector<std::string> arguments{"solve", file, "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    SCOPED_TRACE(shown(arguments));
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return Json::parse(outcome.out);
  }
  Folder folder_;
  std::string file_ = folder_.write("pillar.scene", pillar);
};

TEST_F(SolveArm, EveryPlannerSolvesAndVerifies) {
  for (const char* planner : {"rrt-connect", "rrt", "prm", "lazy-prm"}) {
    const Json answer = solved({"--planner", planner, "--seed", "3"});
    EXPECT_EQ(answer["status"], "solved") << planner;
    EXPECT_EQ(answer["verified"], true);
    EXPECT_GT(answer["length"], 1.8);  // the blocked straight line
    EXPECT_EQ(answer["path"].front(), Json::parse("[-0.9, 0.3, -0.4, 0.0, 0.0, 0.0]"));
    EXPECT_EQ(answer["path"].back(), Json::parse("[0.9, 0.3, -0.4, 0.0, 0.0, 0.0]"));
  }
  const Json star = solved({"--planner", "prm", "--neighbours", "star", "--samples", "300"});
  EXPECT_EQ(star["verified"], true);
  EXPECT_EQ(star["options"]["neighbours"], "star");
}

TEST_F(SolveArm, AnswersAreTheSameForAnyNumberOfThreads) {
  for (const char* planner : {"rrt-connect", "prm"}) {
    std::string first;
    for (const char* threads : {"1", "2", "3", "8"}) {
      Json answer = solved({"--planner", planner, "--optimise", "--threads", threads});
      for (const char* key : {"stages_s", "solve_s", "threads", "peak_memory_bytes"}) answer.erase(key);
      if (first.empty()) first = answer.dump();
      EXPECT_EQ(answer.dump(), first);
    }
  }
}

TEST_F(SolveArm, APlaceOfTheToolIsAGoalInAnyPostureWithinTheLimits) {
  for (const char* planner : {"rrt-connect", "prm"}) {
    const Json answer = solved({"--planner", planner, "--goal", "0.2,0.5,0.3"});
    EXPECT_EQ(answer["status"], "solved");
    EXPECT_EQ(answer["goal"].size(), 3U);
    EXPECT_EQ(answer["path"].back().size(), 6U);
  }
  const std::string tool = folder_.write("tool.scene", std::string(pillar) + "# with a tool\n");
  const Json with_tool = solved_in(tool, {"--robot", "puma560 radius 0.04 tool 0.15", "--goal", "0.2,0.5,0.3"});
  EXPECT_EQ(with_tool["status"], "solved");
  const std::string in_file = folder_.write("place.scene",
                                            "robot puma560 radius 0.05\nsphere -0.8 -0.4 -0.8 0.2\n"
                                            "start 0 0 0 0 0 0\ngoal 0.5 0 -0.5\n");
  const Json study = solved_in(in_file, {});
  EXPECT_NEAR(study["path"].back()[0], 0.3048, 1e-4);
  EXPECT_NEAR(study["path"].back()[2], -2.8118, 1e-4);
}

TEST_F(SolveArm, EveryFailureHasItsCause) {
  struct Case {
    std::vector<std::string> arguments;
    const char* status;
    const char* cause;
  };
  const std::vector<Case> cases = {
      {{"--start", "0,0.3,-0.4,0,0,0"}, "start_blocked", "start_in_collision"},
      {{"--start", "0,-1,0,0,0,0"}, "start_blocked", "start_outside_limits"},
      {{"--goal", "0,0.3,-0.4,0,0,0"}, "goal_blocked", "goal_in_collision"},
      {{"--goal", "0,0,1,0,0,0"}, "goal_blocked", "goal_outside_limits"},
      {{"--goal", "2,0,0"}, "goal_blocked", "goal_out_of_reach"},
      {{"--goal", "0.45,0,0.3"}, "goal_blocked", "goal_in_collision"},
      {{"--planner", "rrt-connect", "--nodes", "2"}, "not_connected", "start_unconnected"},
      {{"--planner", "prm", "--samples", "1", "--neighbours", "1", "--seed", "6"}, "not_connected", ""},
  };
  for (const Case& c : cases) {
    const Json answer = solved(c.arguments, 1);
    EXPECT_EQ(answer["status"], c.status) << shown(c.arguments);
    if (*c.cause != 0) {
      EXPECT_EQ(answer["cause"], c.cause) << shown(c.arguments);
    }
  }
}

/// Two walls leave no way from one half to the other but close by the column: few samples find it.
TEST_F(SolveArm, RoadmapsTellWhyTheyDoNotConnect) {
  const std::string walled = folder_.write("walled.scene", R"(robot puma560 radius 0.05
box -0.02 0.25 -1 0.02 1 1
box -0.02 -1 -1 0.02 -0.25 1
start 0.3 0.3 -0.4 0 0 0
goal 2.7 0.3 -0.4 0 0 0
)");
  std::vector<std::string> causes;
  for (int seed = 1; seed <= 12; ++seed) {
    for (const char* samples : {"1", "4", "30"}) {
      const Outcome outcome = run({"solve", walled, "--json", "-", "--planner", "prm", "--samples", samples, "--seed",
                                   std::to_string(seed), "--neighbours", "3"});
      const Json answer = Json::parse(outcome.out);
      if (answer["status"] == "not_connected") causes.push_back(answer["cause"]);
    }
  }
  for (const char* cause : {"no_free_sample", "start_unconnected", "goal_unconnected", "different_components"}) {
    EXPECT_NE(std::count(causes.begin(), causes.end(), cause), 0) << cause;
  }
}

TEST_F(SolveArm, VerifyAgreesAndRefutesABrokenPath) {
  const std::string answer_file = folder_.path("answer.json");
  ASSERT_EQ(run({"solve", file_, "--json", answer_file, "--quiet"}).code, 0);
  const Outcome good = run({"verify", file_, answer_file});
  EXPECT_EQ(good.code, 0) << good.err;
  Json answer = Json::parse(folder_.read("answer.json"));
  answer["path"] = Json::array({answer["path"].front(), answer["path"].back()});
  folder_.write("answer.json", answer.dump());
  const Outcome bad = run({"verify", file_, answer_file});
  EXPECT_EQ(bad.code, 1);
  EXPECT_NE(bad.out.find("box 0"), std::string::npos) << bad.out;
}

TEST_F(SolveArm, ATableFromAFileIsTheArmItSays) {
  const std::string table = folder_.write("puma.dh", R"(angles degrees
joint 0 0 90 -160 160
joint 0 0.4318 0 -45 225
joint 0.15005 0.0203 -90 -225 45
joint 0.4318 0 90 -110 170
joint 0 0 -90 -100 100
joint 0 0 0 -266 266
)");
  const Json built_in = solved({});
  const std::string answer_file = folder_.path("answer.json");
  ASSERT_EQ(run({"solve", file_, "--robot", "arm " + table + " radius 0.05", "--json", answer_file, "--quiet"}).code,
            0);
  const Json from_file = Json::parse(folder_.read("answer.json"));
  EXPECT_NEAR(from_file["length"], built_in["length"], 1e-9);
  EXPECT_EQ(run({"verify", file_, answer_file}).code, 0);
  EXPECT_EQ(run({"solve", file_, "--robot", "arm /nowhere.dh radius 0.05"}).code, 66);
  EXPECT_EQ(run({"solve", file_, "--robot", "arm " + folder_.write("bad.dh", "joint 1\n") + " radius 0.05"}).code, 65);
}

TEST_F(SolveArm, OptimiseNeverLengthensAndSpreadsIdleJoints) {
  const Json answer = solved({"--optimise", "--goal", "0.9,0.3,-0.4,1,0,0", "--planner", "prm"});
  EXPECT_LE(answer["length"], answer["raw_length"]);
  EXPECT_EQ(answer["verified"], true);
  double before = 0.0;
  for (const Json& q : answer["path"]) {
    EXPECT_GE(q[3], before);  // joint 4 moves nothing, so it turns evenly
    before = q[3];
  }
}

TEST_F(SolveArm, SaysWhatIsWrongInOneLine) {
  struct Case {
    std::vector<std::string> arguments;
    const char* says;
  };
  const std::vector<Case> cases = {{{"--start", "0,0"}, "six joint angles"},
                                   {{"--goal", "0,0"}, "place of the tool"},
                                   {{"--sampler", "lattice", "--planner", "prm"}, "lattice"},
                                   {{"--contact", "allowed"}, "--contact"},
                                   {{"--planner", "visibility"}, "visibility"},
                                   {{"--via", "0,5"}, "six joint angles"},
                                   {{"--via", "0,0.3,-0.4,0,0,0"}, "way-point 1"},
                                   {{"--attach", "1"}, "--attach"},
                                   {{"--attach", "0", "--planner", "prm"}, "--attach"},
                                   {{"--attach", "1,x", "--planner", "prm"}, "--attach"},
                                   {{"--robot", "puma560 radius 0.05 limits wide"}, "wide"}};
  for (const Case& c : cases) {
    std::vector<std::string> arguments{"solve", file_};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << shown(arguments) << outcome.err;
    EXPECT_NE(outcome.err.find(c.says), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

TEST_F(SolveArm, RefusesWorldsThatAreFlat) {
  for (const char* line : {"0 0 1 1\n", "polygon 0 0 1 0 0 1\n", "bounds -2 -2 2 2\n"}) {
    const std::string flat = folder_.write("flat.scene", std::string(pillar) + line);
    const Outcome outcome = run({"solve", flat});
    EXPECT_EQ(outcome.code, 2) << line;
    EXPECT_NE(outcome.err.find("no height"), std::string::npos) << outcome.err;
  }
}

TEST_F(SolveArm, InfoAndCompareKnowArmScenes) {
  const Outcome info = run({"info", file_, "--json", "-"});
  EXPECT_EQ(info.code, 0);
  const Json facts = Json::parse(info.out);
  EXPECT_EQ(facts["kind"], "solids");
  EXPECT_EQ(facts["spheres"], 1);
  EXPECT_EQ(facts["boxes"], 2);
  const Outcome compared = run({"compare", file_, "--planners", "rrt-connect,prm", "--trials", "3", "--json", "-"});
  EXPECT_EQ(compared.code, 0) << compared.err;
  const Json rows = Json::parse(compared.out)["rows"];
  ASSERT_EQ(rows.size(), 2U);
  for (const Json& row : rows) EXPECT_EQ(row["solved"], 3);
}

TEST_F(SolveArm, DrawsThreeViewsWithTheSweepAndTheTrace) {
  const std::string svg = folder_.path("arm.svg");
  const std::string answer = folder_.path("answer.json");
  ASSERT_EQ(run({"solve", file_, "--svg", svg, "--json", answer, "--quiet"}).code, 0);
  const std::string again = folder_.path("again.svg");
  ASSERT_EQ(run({"render", file_, "--answer", answer, "-o", again, "--quiet"}).code, 0);
  for (const char* name : {"arm.svg", "again.svg"}) {
    const std::string text = folder_.read(name);
    for (const char* id : {"id=\"sweep\"", "id=\"trace\"", "id=\"arm_at_start\"", "id=\"polygons\"", "id=\"axes\""}) {
      EXPECT_NE(text.find(id), std::string::npos) << name << ' ' << id;
    }
  }
}

}  // namespace
}  // namespace warren::test
