// SPDX-License-Identifier: BSD-3-Clause
// `warren solve`, `verify` and `render` for cars.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* slalom = R"(bounds 0 0 12 6
robot car radius 0.2 turning 0.7
3 0 3 3.5
6 6 6 2.5
polygon 8.9 0 9.1 0 9.1 3.5 8.9 3.5
start 1 1 0
goal 11 1 0
)";

class SolveCar : public ::testing::Test {
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
  std::string file_ = folder_.write("slalom.scene", slalom);
};

/// From the poses alone: how each leg turns, and which way it goes.
void expect_legs_to_keep_the_radius(const Json& path, double turning_radius, bool reverses) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double dx = path[i][0].get<double>() - path[i - 1][0].get<double>();
    const double dy = path[i][1].get<double>() - path[i - 1][1].get<double>();
    const double turn = std::remainder(path[i][2].get<double>() - path[i - 1][2].get<double>(), 2 * M_PI);
    const double middle = path[i - 1][2].get<double>() + 0.5 * turn;
    const double ahead = dx * std::cos(middle) + dy * std::sin(middle);
    EXPECT_NEAR(dy * std::cos(middle) - dx * std::sin(middle), 0.0, 1e-9);
    EXPECT_LE(std::abs(turn), 0.5 * M_PI + 1e-8);
    if (!reverses) {
      EXPECT_GE(ahead, -1e-9);
    }
    if (std::abs(turn) > 1e-6) {
      EXPECT_NEAR(std::abs(ahead) / (2 * std::sin(std::abs(turn) / 2)), turning_radius, 1e-6);
    }
  }
}

TEST_F(SolveCar, EveryPlannerSolvesWithBothCurvesAndVerifies) {
  for (const std::string steering : {"dubins", "reeds-shepp"}) {
    for (const char* planner : {"rrt-connect", "rrt", "prm", "lazy-prm"}) {
      const Json answer = solved({"--planner", planner, "--steering", steering, "--seed", "3", "--optimise"});
      EXPECT_EQ(answer["status"], "solved");
      EXPECT_EQ(answer["verified"], true);
      EXPECT_EQ(answer["planner"], planner);
      EXPECT_EQ(answer["steering"], steering);
      EXPECT_EQ(answer["options"]["steering"], steering);
      EXPECT_GT(answer["length"], 12.0);
      EXPECT_LE(answer["length"], answer["raw_length"].get<double>() + 1e-9);
      EXPECT_GE(answer["min_clearance"], 0.0);
      EXPECT_EQ(answer["path"].front(), Json::parse("[1.0, 1.0, 0.0]"));
      EXPECT_EQ(answer["path"].back(), Json::parse("[11.0, 1.0, 0.0]"));
      expect_legs_to_keep_the_radius(answer["path"], 0.7, steering != "dubins");
      if (steering == "dubins") {
        EXPECT_EQ(answer["cusps"], 0);
      }
      const std::string file = folder_.write("answer.json", answer.dump());
      const Outcome verdict = run({"verify", file_, file});
      EXPECT_EQ(verdict.code, 0) << verdict.out << verdict.err;
    }
  }
}

/// As a polygon that turns goes, which another judge judges, but only where it faces.
TEST_F(SolveCar, ADifferentialDriveGoesStraightAndTurnsOnTheSpot) {
  const std::string outline = "polygon -0.3 -0.15 0.5 -0.15 0.5 0.15 -0.3 0.15";
  for (const std::vector<std::string>& planner : std::vector<std::vector<std::string>>{
           {"rrt-connect", "--optimise"}, {"prm"}, {"grid"}, {"anytime", "--iterations", "4"}}) {
    std::vector<std::string> words{"--robot", "car " + outline + " turning 0.3 steering differential", "--planner"};
    words.insert(words.end(), planner.begin(), planner.end());
    const Json answer = solved(words);
    EXPECT_EQ(answer["status"], "solved");
    EXPECT_EQ(answer["steering"], "differential");
    const Json& path = answer["path"];
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double dx = path[i][0].get<double>() - path[i - 1][0].get<double>();
      const double dy = path[i][1].get<double>() - path[i - 1][1].get<double>();
      const double theta = path[i][2].get<double>();
      const double turn = std::remainder(theta - path[i - 1][2].get<double>(), 2 * M_PI);
      EXPECT_TRUE(std::hypot(dx, dy) < 1e-9 || std::abs(turn) < 1e-9) << "leg " << i;
      EXPECT_NEAR(dy * std::cos(theta) - dx * std::sin(theta), 0.0, 1e-9) << "leg " << i;
    }
    const std::string file = folder_.write("answer.json", answer.dump());
    EXPECT_EQ(run({"verify", file_, file}).code, 0);
    EXPECT_EQ(run({"verify", file_, file, "--robot", outline}).code, 0);
    EXPECT_EQ(run({"verify", file_, file, "--robot", "car " + outline + " turning 0.3 steering reeds-shepp"}).code, 1);
  }
}

TEST_F(SolveCar, OptionsAndTheRobotLineSaySteeringAndRadius) {
  const Json wide = solved({"--turning-radius", "1.1", "--steering", "reeds-shepp"});
  EXPECT_EQ(wide["robot"], "car radius 0.2 turning 1.1 steering reeds-shepp");
  expect_legs_to_keep_the_radius(wide["path"], 1.1, true);
  const Json long_car = solved({"--robot", "car polygon -0.3 -0.15 0.5 -0.15 0.5 0.15 -0.3 0.15 turning 0.6"});
  EXPECT_EQ(long_car["verified"], true);
  EXPECT_EQ(long_car["robot"], "car polygon -0.3 -0.15 0.5 -0.15 0.5 0.15 -0.3 0.15 turning 0.6");
  const std::string file = folder_.write("answer.json", long_car.dump());
  EXPECT_EQ(run({"verify", file_, file}).code, 0);
  // Its corners sweep wider than a disc of half its width would.
  EXPECT_EQ(run({"verify", file_, file, "--robot", "car radius 0.15 turning 0.6"}).code, 0);
}

TEST_F(SolveCar, AnswersAreTheSameForAnyNumberOfThreads) {
  for (const char* planner : {"rrt-connect", "prm", "lazy-prm"}) {
    std::string first;
    for (const char* threads : {"1", "2", "3", "8"}) {
      Json answer = solved({"--planner", planner, "--optimise", "--threads", threads});
      for (const char* key : {"stages_s", "solve_s", "threads", "peak_memory_bytes"}) answer.erase(key);
      if (first.empty()) first = answer.dump();
      EXPECT_EQ(answer.dump(), first);
    }
  }
}

TEST_F(SolveCar, VerifyRefutesTighterTurnsGearsAndWalls) {
  const Json answer = solved({"--steering", "reeds-shepp", "--seed", "1"});
  const std::string file = folder_.write("answer.json", answer.dump());
  EXPECT_EQ(run({"verify", file_, file}).code, 0);
  const Outcome wider = run({"verify", file_, file, "--robot", "car radius 0.2 turning 0.75 steering reeds-shepp"});
  EXPECT_EQ(wider.code, 1);
  EXPECT_NE(wider.out.find("turning radius"), std::string::npos) << wider.out;
  if (answer["cusps"] > 0) {
    const Outcome forwards = run({"verify", file_, file, "--robot", "car radius 0.2 turning 0.7"});
    EXPECT_EQ(forwards.code, 1);
    EXPECT_NE(forwards.out.find("gear"), std::string::npos) << forwards.out;
  }
  Json cut = answer;
  cut["path"] = Json::array({answer["path"].front(), answer["path"].back()});
  folder_.write("answer.json", cut.dump());
  EXPECT_EQ(run({"verify", file_, file}).code, 1);
}

TEST_F(SolveCar, TakesGoalsWithoutHeadingAndWayPoints) {
  for (const char* planner : {"rrt-connect", "prm"}) {
    const Json open = solved({"--goal", "11,1", "--planner", planner});
    EXPECT_EQ(open["goal"].size(), 2U);
    EXPECT_EQ(open["path"].back()[0], 11.0);
  }
  const Json guided = solved({"--via", "4.5,3;7.5,2"});
  int passed = 0;
  for (const Json& state : guided["path"]) {
    passed += (state[0] == 4.5 && state[1] == 3.0) || (state[0] == 7.5 && state[1] == 2.0) ? 1 : 0;
  }
  EXPECT_EQ(passed, 2);
}

TEST_F(SolveCar, EndsWithoutAPathAreAnswers) {
  EXPECT_EQ(solved({"--start", "3,1,0"}, 1)["status"], "start_blocked");
  EXPECT_EQ(solved({"--goal", "9,1"}, 1)["status"], "goal_blocked");
  for (const char* planner : {"prm", "lazy-prm"}) {
    const Json answer = solved({"--planner", planner, "--samples", "3"}, 1);
    EXPECT_EQ(answer["status"], "not_connected");
    EXPECT_GT(answer["components"]["nearest_gap"], 0.0);
  }
}

TEST_F(SolveCar, SaysWhatIsWrongInOneLine) {
  struct Case {
    std::vector<std::string> arguments;
    const char* says;
  };
  const std::vector<Case> cases = {{{"--steering", "ackermann"}, "--steering"},
                                   {{"--turning-radius", "0"}, "--turning-radius"},
                                   {{"--turning-radius", "x"}, "--turning-radius"},
                                   {{"--start", "0,0"}, "X,Y,THETA"},
                                   {{"--planner", "visibility"}, "a car"},
                                   {{"--robot", "car radius 1"}, "no turning radius"},
                                   {{"--robot", "disc 0.2", "--steering", "dubins"}, "--steering"}};
  for (const Case& c : cases) {
    std::vector<std::string> arguments{"solve", file_};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << shown(arguments) << outcome.err;
    EXPECT_NE(outcome.err.find(c.says), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

TEST_F(SolveCar, DrawsCurvesAsArcs) {
  for (const char* planner : {"rrt-connect", "prm"}) {
    ASSERT_EQ(run({"solve", file_, "--planner", planner, "--svg", folder_.path("car.svg"), "--json",
                   folder_.path("car.json"), "--quiet"})
                  .code,
              0);
    const std::string text = folder_.read("car.svg");
    for (const char* id : {"id=\"sweep\"", "id=\"edges\"", "id=\"path\""}) {
      ASSERT_NE(text.find(id), std::string::npos) << id;
    }
    EXPECT_NE(text.find("A0.7 0.7 0 0 ", text.find("id=\"path\"")), std::string::npos);
  }
  ASSERT_EQ(run({"render", file_, "--answer", folder_.path("car.json"), "-o", folder_.path("again.svg")}).code, 0);
  EXPECT_NE(folder_.read("again.svg").find("A0.7 0.7 0 0 "), std::string::npos);
  ASSERT_EQ(run({"render", file_, "--answer", folder_.path("car.json"), "-o", folder_.path("again.png")}).code, 0);
}

/// Free but for a block of 8 x 6 cells from (12, 3) on.
std::string map_with_a_block() {
  std::string text = "type octile\nheight 12\nwidth 24\nmap\n";
  for (int y = 11; y >= 0; --y) {
    for (int x = 0; x < 24; ++x) text += x >= 12 && x < 20 && y >= 3 && y < 9 ? '@' : '.';
    text += '\n';
  }
  return text;
}

TEST(SolveCarOnMaps, TheWholeBodyIsJudgedByTheCells) {
  const Folder folder;
  const std::string map = folder.write("block.map", map_with_a_block());
  const std::string ahead = "car polygon 8 -0.4 9 -0.4 9 0.4 8 0.4 turning 1";  // far from its reference point
  const std::string small = "car radius 0.3 turning 1 steering reeds-shepp";
  struct Case {
    const std::string& robot;
    const char* start;
    const char* goal;
    const char* status;
  };
  const Case all[] = {{ahead, "6,6,0", "7,6,0", "start_blocked"},  // the reference point is free, the body in the block
                      {ahead, "2,6,0", "6,6,0", "goal_blocked"},
                      {ahead, "16,6,1.5707963", "16,6,1.5707963", "start_blocked"},  // out of the map
                      {ahead, "16,6,3.14159265", "15,6,3.14159265", "solved"},  // the reference point is in the block
                      {small, "16,6,0", "17,6,0", "start_blocked"},
                      {small, "2,2,0", "16,6", "goal_blocked"},
                      {small, "2,6,0", "22,6,0", "solved"}};
  for (const char* planner : {"rrt-connect", "prm"}) {
    for (const Case& c : all) {
      const std::vector<std::string> words{"solve",  map,    "--robot", c.robot, "--start",   c.start,
                                           "--goal", c.goal, "--json",  "-",     "--planner", planner};
      SCOPED_TRACE(shown(words));
      const Outcome outcome = run(words);
      EXPECT_EQ(outcome.code, std::string_view(c.status) == "solved" ? 0 : 1) << outcome.err;
      const Json answer = Json::parse(outcome.out);
      EXPECT_EQ(answer["status"], c.status);
      if (outcome.code != 0) continue;
      EXPECT_EQ(run({"verify", map, folder.write("answer.json", answer.dump())}).code, 0);
    }
  }
  const std::string inside = R"({"path": [[16, 6, 0], [17, 6, 0]], "robot": "car radius 0.3 turning 1"})";
  EXPECT_EQ(run({"verify", map, folder.write("inside.json", inside), "--start", "16,6,0", "--goal", "17,6,0"}).code, 1);
}

TEST(SolveCarOnMaps, AWallAcrossTheBodyBlocksTheStart) {
  const Folder folder;
  const std::string scene = folder.write("wall.scene",
                                         "bounds 0 0 30 10\nwall 0 5 30 5\n"
                                         "robot car polygon -1 -0.9 3.6 -0.9 3.6 0.9 -1 0.9 turning 2\n"
                                         "start 3 5 0\ngoal 20 5 0\n");
  const Outcome outcome = run({"solve", scene, "--json", "-"});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["status"], "start_blocked");
  const std::string driven = R"({"path": [[3, 5, 0], [20, 5, 0]]})";
  EXPECT_EQ(run({"verify", scene, folder.write("driven.json", driven)}).code, 1);
}

}  // namespace
}  // namespace warren::test
