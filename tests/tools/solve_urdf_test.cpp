// SPDX-License-Identifier: BSD-3-Clause
// Arms that a URDF describes: solved, judged, kept, timed, told, refused.
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/tools/process.hpp"

namespace warren::test {
namespace {

using Json = nlohmann::ordered_json;

/// A base that turns without end, a shoulder, an elbow, a slide with a ball at its end, and a finger that follows the
/// slide.
constexpr const char* crane_urdf = R"(<?xml version="1.0"?>
<robot name="crane">
  <link name="world"/>
  <link name="column"><collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.06" length="0.4"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0.25 0 0"/><geometry><box size="0.5 0.06 0.06"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0.2 0 0" rpy="0 1.5707963267948966 0"/><geometry><capsule radius="0.04" length="0.4"/></geometry></collision></link>
  <link name="hook"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <link name="finger"><collision><geometry><sphere radius="0.02"/></geometry></collision></link>
  <joint name="base" type="continuous"><parent link="world"/><child link="column"/><axis xyz="0 0 1"/><limit velocity="2" effort="1"/></joint>
  <joint name="shoulder" type="revolute"><parent link="column"/><child link="upper"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/><limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0.5 0 0"/><axis xyz="0 1 0"/><limit lower="-2.5" upper="2.5" velocity="1" effort="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="lower"/><child link="hook"/><origin xyz="0.5 0 0"/><axis xyz="1 0 0"/><limit lower="0" upper="0.2" velocity="0.5" effort="1"/></joint>
  <joint name="grip" type="prismatic"><parent link="hook"/><child link="finger"/><origin xyz="0.06 0 0"/><axis xyz="0 1 0"/><limit lower="0" upper="0.2" velocity="0.5" effort="1"/><mimic joint="slide" multiplier="0.1"/></joint>
</robot>
)";

constexpr const char* crane_srdf = R"(<robot name="crane">
  <group name="arm"><chain base_link="world" tip_link="hook"/></group>
  <disable_collisions link1="hook" link2="finger" reason="Adjacent"/>
</robot>
)";

/// A pillar and a turned board in the way.
constexpr const char* yard = R"(cylinder 0.7 0 0 0.7 0 1 0.1
obox 0 0.8 0.5 0 0 0.3826834 0.9238795 0.2 0.02 0.2
capsule 0 -0.8 0 0 -0.8 0.6 0.05
start -0.9 0.3 0.2 0
goal 0.9 0.3 0.2 0.1
)";

class SolveUrdf : public ::testing::Test {
 protected:
  SolveUrdf() {
    folder_.write("crane.srdf", crane_srdf);
    robot_ = "urdf " + folder_.write("crane.urdf", crane_urdf) + " srdf " + folder_.path("crane.srdf") + " group arm";
    file_ = folder_.write("yard.scene", "robot " + robot_ + "\n" + yard);
  }
  Json solved(std::vector<std::string> more, int code = 0) const {
    std::vector<std::string> arguments{"solve", file_, "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    SCOPED_TRACE(shown(arguments));
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return outcome.out.empty() ? Json() : Json::parse(outcome.out);
  }
  Folder folder_;
  std::string robot_;
  std::string file_;
};

TEST_F(SolveUrdf, EveryPlannerSolvesAndTheJudgeAgrees) {
  for (const char* planner : {"rrt-connect", "rrt", "prm", "lazy-prm", "anytime", "rrt-star"}) {
    std::vector<std::string> more{"--planner", planner, "--seed", "3"};
    const bool goes_on = std::string(planner) == "anytime" || std::string(planner) == "rrt-star";
    if (goes_on) more.insert(more.end(), {"--iterations", "6"});
    const Json answer = solved(more);
    EXPECT_EQ(answer["status"], "solved") << planner;
    EXPECT_EQ(answer["verified"], true) << planner;
    EXPECT_EQ(answer["joints"], Json::parse(R"(["base", "shoulder", "elbow", "slide"])"));
    EXPECT_EQ(answer["path"].front(), Json::parse("[-0.9, 0.3, 0.2, 0.0]"));
    EXPECT_LE(answer["lower_bound"], answer["length"]);
  }
}

TEST_F(SolveUrdf, EndsThatAreMovedOntoALimitAreTold) {
  const Json answer = solved({"--goal", "0.9,0.3,0.2,0.2000003"});
  EXPECT_EQ(answer["goal"][3], 0.2);
  EXPECT_EQ(answer["told"].back(), "goal: slide is moved from 0.2000003 onto its limit, 0.2");
  solved({"--goal", "0.9,0.3,0.2,0.2001"}, 1);
}

TEST_F(SolveUrdf, AnswersAreTheSameForAnyNumberOfThreads) {
  for (const char* planner : {"rrt-connect", "prm"}) {
    std::string first;
    for (const char* threads : {"1", "2", "8"}) {
      Json answer = solved({"--planner", planner, "--optimise", "--threads", threads});
      for (const char* key : {"stages_s", "solve_s", "threads", "peak_memory_bytes"}) answer.erase(key);
      if (first.empty()) first = answer.dump();
      EXPECT_EQ(answer.dump(), first);
    }
  }
}

TEST_F(SolveUrdf, SolidsBeyondWhatFloatsHoldAreAnswered) {
  for (const std::string solid : {R"(<box size="1e60 0.1 1"/>)", R"(<cylinder radius="1e60" length="1"/>)",
                                  R"(<cylinder radius="1" length="1e60"/>)", R"(<sphere radius="1e30"/>)"}) {
    SCOPED_TRACE(solid);
    const std::string urdf = folder_.write(
        "large.urdf", R"(<robot name="r"><link name="b"/><link name="l"><collision><geometry>)" + solid +
                          R"(</geometry></collision></link><joint name="j" type="revolute"><parent link="b"/>)"
                          R"(<child link="l"/><axis xyz="0 0 1"/><limit lower="-2" upper="2"/></joint></robot>)");
    const std::string scene =
        folder_.write("large.scene", "sphere 3 3 3 0.5\nrobot urdf " + urdf + "\nstart 0\ngoal 1\n");
    const Outcome outcome = run({"solve", scene, "--json", "-"});
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out, nullptr, false).value("status", ""), "start_blocked");
  }
}

TEST_F(SolveUrdf, WhatIsTooLargeToBeVerifiedIsRefused) {
  const std::string scene =
      folder_.write("large.scene", "cylinder 5 0 0 5 0 1e9 1\nrobot " + robot_ + "\nstart 0 0 0 0\ngoal 0.5 0 0 0\n");
  const Outcome outcome = run({"solve", scene});
  EXPECT_EQ(outcome.code, 65) << outcome.err;
  EXPECT_NE(outcome.err.find("larger or farther away than 1e5 m"), std::string::npos) << outcome.err;
}

TEST_F(SolveUrdf, AJointWithoutEndGoesTheShorterWay) {
  const Json answer = solved({"--start", "4.6,-1,0,0", "--goal", "-1.68,-1,0,0"});
  EXPECT_EQ(answer["status"], "solved");
  EXPECT_NEAR(answer["length"], 2.0 * M_PI - 6.28, 1e-9);
  EXPECT_EQ(answer["optimal"], true);
  const std::string file = folder_.path("short.json");
  ASSERT_EQ(run({"solve", file_, "--start", "4.6,-1,0,0", "--goal", "-1.68,-1,0,0", "--json", file, "--quiet"}).code,
            0);
  EXPECT_EQ(run({"verify", file_, file}).code, 0);
}

TEST_F(SolveUrdf, StatesOfFewJointsAreNoPlaces) {
  const std::string robot = folder_.write(
      "rail.urdf",
      R"(<robot name="r"><link name="b"/><link name="t"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>)"
      R"(<joint name="x" type="prismatic"><parent link="b"/><child link="t"/><axis xyz="1 0 0"/><limit lower="-5" upper="5"/></joint></robot>)");
  file_ = folder_.write("rail.scene", "robot urdf " + robot + "\nsphere 0 2 0 1\nstart -2\ngoal 2\n");
  const Json narrowest = solved({"--explain"})["explained"]["narrowest"];
  EXPECT_NEAR(narrowest["clearance"], 0.95, 1e-3);
  EXPECT_TRUE(narrowest["place"].is_null()) << narrowest;
}

/// The first goal is farther than the way to the second. Of one joint and of two.
TEST_F(SolveUrdf, SeveralNamedGoalsAreBoundedAndToldTogether) {
  const std::string slides =
      R"(<robot name="r"><link name="b"/><link name="s"/><link name="t"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>)"
      R"(<joint name="x" type="prismatic"><parent link="b"/><child link="s"/><axis xyz="1 0 0"/><limit lower="-5" upper="5"/></joint>)"
      R"(<joint name="y" type="prismatic"><parent link="s"/><child link="t"/><axis xyz="0 1 0"/><limit lower="-5" upper="5"/></joint></robot>)";
  const std::string robot = "robot urdf " + folder_.write("slides.urdf", slides);
  const std::string file = folder_.path("goals.json");
  const auto expect_second = [&](const std::string& lines, const Json& goals, double bound) {
    const std::string scene = folder_.write("goals.scene", robot + lines);
    ASSERT_EQ(run({"solve", scene, "--planner", "rrt-star", "--iterations", "6", "--json", file, "--quiet"}).code, 0);
    const Json answer = Json::parse(folder_.read("goals.json"));
    EXPECT_EQ(answer["goals"], goals);
    EXPECT_EQ(answer["goal"], goals[0]);
    EXPECT_EQ(answer["goal_index"], 1);
    EXPECT_NEAR(answer["lower_bound"], bound, 1e-9);
    const Outcome verdict = run({"verify", scene, file});
    EXPECT_EQ(verdict.code, 0) << verdict.err;
    EXPECT_NE(verdict.out.find("lower bound checked"), std::string::npos) << verdict.out;
  };
  expect_second("\nbox -0.8 0.45 -0.3 0.8 0.55 0.3\nstart joints x 0 y 0\ngoal joints x 0 y -3\ngoal joints x 0 y 1\n",
                Json::parse("[[0.0, 1.0], [0.0, -3.0]]"), 1.0);
  expect_second(" base s tip t\nbox 1 1 1 2 2 2\nstart 0\ngoal joints y -3\ngoal joints y 1\n",
                Json::parse("[[1.0], [-3.0]]"), 1.0);
}

/// Their states in a file have two numbers, as places of the plane.
TEST_F(SolveUrdf, StopsOfTwoJointsAreStates) {
  const auto part = [](const std::string& name) {
    return "<link name=\"" + name + "\"><collision><origin xyz=\"0.5 0 0\"/><geometry><box size=\"0.8 0.1 0.1\"/>" +
           "</geometry></collision></link>";
  };
  const auto joint = [](const std::string& from, const std::string& to) {
    return "<joint name=\"" + to + "j\" type=\"continuous\"><parent link=\"" + from + "\"/><child link=\"" + to +
           "\"/><origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/></joint>";
  };
  const std::string urdf = folder_.write("two.urdf", "<robot name=\"r\"><link name=\"b\"/>" + part("l") + part("m") +
                                                         joint("b", "l") + joint("l", "m") + "</robot>");
  const std::string scene = folder_.write("two.scene", "sphere 1 1.6 0 0.2\nrobot urdf " + urdf + "\n");
  const std::string file = folder_.path("two.json");
  for (const std::string option : {"--via", "--visit"}) {
    ASSERT_EQ(run({"solve", scene, "--start", "0.1,0", "--goal", "0.4,0.3", option, "4.6,0.2;-8,0.5", "--json", file,
                   "--quiet"})
                  .code,
              0);
    const Outcome good = run({"verify", scene, file});
    EXPECT_EQ(good.code, 0) << good.out << good.err;
    const Outcome drawn = run({"render", scene, "--answer", file, "-o", "-"});
    EXPECT_NE(drawn.out.find("id=\"trace\""), std::string::npos) << "all of the path " << drawn.err;
    Json other = Json::parse(folder_.read("two.json"));
    other[option.substr(2)][0][1] = 0.3;
    folder_.write("two.json", other.dump());
    EXPECT_EQ(run({"verify", scene, file}).code, 1);
  }
}

/// Three numbers are the state of three joints, or refused where a place may be meant.
TEST_F(SolveUrdf, ThreeNumbersOfThreeJointsAreNoPlace) {
  const std::string three =
      "cylinder 9 0 0 9 0 1 0.1\nrobot urdf " + folder_.path("crane.urdf") + " base world tip lower";
  const auto scene = [&](const std::string& lines) { return folder_.write("three.scene", three + lines); };
  const std::string plain = scene("\nstart 0 0 0\ngoal 0.4 0.3 0.2\n");
  const Outcome state = run({"solve", plain, "--json", "-"});
  ASSERT_EQ(state.code, 0) << state.err;
  EXPECT_EQ(Json::parse(state.out)["path"].back(), Json::parse("[0.4, 0.3, 0.2]"));
  const std::string named = "\nstart joints base 0 shoulder 0 elbow 0\ngoal 0.4 0.3 0.2\n";
  for (const std::string& lines : {named, std::string(" tool upper\nstart 0 0 0\ngoal 0.4 0.3 0.2\n")}) {
    const Outcome unclear = run({"solve", scene(lines), "--json", "-"});
    EXPECT_EQ(unclear.code, 2);
    EXPECT_NE(unclear.err.find("may be a place of the tool or the state of three joints"), std::string::npos);
  }
  EXPECT_EQ(run({"solve", scene(named), "--goal", "0.4,0.3,0.2", "--quiet"}).code, 0);
  const std::string request = folder_.write(
      "three.yaml",
      "start_state: {joint_state: {name: [base, shoulder, elbow], position: [0, 0, 0]}}\n"
      "goal_constraints: [{position_constraints: [{link_name: lower, constraint_region: {primitive_poses: "
      "[{position: [0.4, 0.3, 0.2]}]}}]}]\n");
  EXPECT_EQ(run({"solve", plain, "--request", request, "--json", "-"}).code, 2);
}

/// Joints that an end names beside those that move stand where it says, or it is refused.
TEST_F(SolveUrdf, EndsNameJointsThatMoveFollowOrAreHeld) {
  const auto asked = [&](const std::string& start, const std::string& goal) {
    const std::string ends = "\nstart joints base 0 shoulder 0 elbow 0 slide 0" + start +
                             "\ngoal joints base 0.5 shoulder 0 elbow 0 slide 0.1" + goal + "\n";
    return run({"solve", folder_.write("ends.scene", "sphere 9 9 9 1\nrobot " + robot_ + ends), "--json", "-"});
  };
  for (const auto& [start, goal] :
       {std::pair("", ""), {" grip 0", ""}, {"", " grip 0.01"}, {" lamp 0", " lamp 0\nhold lamp 0"}}) {
    const Outcome taken = asked(start, goal);
    EXPECT_EQ(taken.code, 0) << taken.err;
  }
  for (const auto& [start, goal, says] : {std::tuple(" elbw 1", "", "the start names joint 'elbw', which"),
                                          {"", " elbw 1", "the goal names joint 'elbw', which"},
                                          {"", " grip 0.5", "joint 'grip' at 0.5, but it is at 0.01 there"},
                                          {" grip 0.5", "", "joint 'grip' at 0.5, but it is at 0 there"},
                                          {"", "\ntool finger\ngroup hand", "ends.scene:6: `group` says another"},
                                          {"", "\nallow hook fingr", "ends.scene:5: "},
                                          {"", "\nattach hook fingr sphere 0 0 0 1", "(found: fingr)"}}) {
    const Outcome refused = asked(start, goal);
    EXPECT_EQ(refused.code, std::string(says).find("joint") == std::string::npos ? 65 : 2) << says;
    EXPECT_NE(refused.err.find(says), std::string::npos) << refused.err;
  }
}

TEST_F(SolveUrdf, PlacesAndPosesOfTheToolAreGoals) {
  const Json place = solved({"--goal", "0.4,0.5,0.5"});
  EXPECT_EQ(place["status"], "solved");
  EXPECT_EQ(place["path"].back().size(), 4U);
  const Json pose = solved({"--goal-pose", "-1.0,0,0.4,0,0,1,0"});  // stretched out to the other side
  EXPECT_EQ(pose["status"], "solved");
  EXPECT_EQ(pose["verified"], true);
  const std::string file = folder_.path("pose.json");
  ASSERT_EQ(run({"solve", file_, "--goal-pose", "-1.0,0,0.4,0,0,1,0", "--json", file, "--quiet"}).code, 0);
  EXPECT_EQ(run({"verify", file_, file}).code, 0);
  for (const auto& goal : {std::pair{"--goal", "5,5,5"}, {"--goal-pose", "5,5,5,0,0,0,1"}}) {
    const Json far = solved({goal.first, goal.second}, 1);
    EXPECT_EQ(far["status"], "goal_blocked") << goal.first;
    EXPECT_EQ(far["cause"], "goal_out_of_reach") << goal.first;
  }
  const Json low = solved({"--goal", "0,0,-0.85"}, 1);  // as far as the arm is long, and no posture gets there
  EXPECT_EQ(low["status"], "not_connected");
  EXPECT_EQ(low["cause"], "goal_not_found");
}

TEST_F(SolveUrdf, EndsThatAreBlockedAreTold) {
  const Json in_pillar = solved({"--start", "0,0,0,0"}, 1);
  EXPECT_EQ(in_pillar["status"], "start_blocked");
  EXPECT_EQ(in_pillar["cause"], "start_in_collision");
  EXPECT_EQ(in_pillar["blocked"]["free_place"].size(), 4U);
  const Json beyond = solved({"--goal", "0.9,0.3,0.2,0.3"}, 1);
  EXPECT_EQ(beyond["cause"], "goal_outside_limits");
  EXPECT_NE(beyond["blocked"]["by"].get<std::string>().find("slide"), std::string::npos) << beyond["blocked"];
  const Json rounded = solved({"--goal", "0.9,0.3,0.2,0.2000009"});  // a file that rounds its limits
  EXPECT_EQ(rounded["path"].back()[3], 0.2);
}

TEST_F(SolveUrdf, ARoadmapIsKeptAndKnowsItsRobot) {
  const std::string roadmap = folder_.path("crane.roadmap");
  const Outcome built = run({"build", file_, "-o", roadmap, "--samples", "400", "--quiet"});
  ASSERT_EQ(built.code, 0) << built.err;
  const Outcome asked =
      run({"query", roadmap, "--start", "-0.9,0.3,0.2,0", "--goal", "0.9,0.3,0.2,0.1", "--json", "-"});
  EXPECT_EQ(asked.code, 0) << asked.err;
  EXPECT_EQ(Json::parse(asked.out)["verified"], true);
  std::string other = crane_urdf;
  other.replace(other.find("radius=\"0.05\""), 13, "radius=\"0.07\"");
  folder_.write("crane.urdf", other);
  const Outcome stale = run({"query", roadmap, "--start", "-0.9,0.3,0.2,0", "--goal", "0.9,0.3,0.2,0.1"});
  EXPECT_EQ(stale.code, 65);
  EXPECT_NE(stale.err.find("another arm"), std::string::npos) << stale.err;
}

/// The robot lacks what a scene of MoveIt names; what is written of the two is read back.
TEST_F(SolveUrdf, AnswersAndRoadmapsOfMoveItsScenesAreReadBack) {
  const std::string scene = folder_.write("yard.yaml", R"(robot_model_name: crane
allowed_collision_matrix: {entry_names: [hook, lamp], entry_values: [[false, true], [true, false]]}
world:
  collision_objects:
    - id: pillar
      primitives: [{type: cylinder, dimensions: [1, 0.1]}]
      primitive_poses: [{position: [0.7, 0, 0.5]}]
)");
  const std::vector<std::string> ends{"--start", "-0.9,0.3,0.2,0", "--goal", "0.9,0.3,0.2,0.1"};
  const auto asked = [&](std::vector<std::string> words) {
    words.insert(words.end(), ends.begin(), ends.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << shown(words) << outcome.err;
  };
  const std::string answer = folder_.path("yard.json");
  const std::string roadmap = folder_.path("yard.roadmap");
  asked({"solve", scene, "--robot", robot_, "--json", answer, "--quiet"});
  EXPECT_EQ(run({"verify", scene, answer}).code, 0);
  EXPECT_EQ(run({"render", scene, "--answer", answer, "-o", folder_.path("yard.svg")}).code, 0);
  ASSERT_EQ(run({"build", scene, "--robot", robot_, "-o", roadmap, "--samples", "200", "--quiet"}).code, 0);
  asked({"query", roadmap, "--json", "-"});
  EXPECT_EQ(run({"update", roadmap, scene, "-o", folder_.path("new.roadmap"), "--quiet"}).code, 0);
  asked({"query", folder_.path("new.roadmap"), "--json", "-"});
}

/// Objects in the frame of a link: who knows the robot reads them, the others are told.
TEST_F(SolveUrdf, ScenesOfMoveItMayHavePosesInFramesOfLinks) {
  const std::string scene = folder_.write("frames.yaml", R"(robot_model_name: crane
robot_state: {joint_state: {name: [base], position: [0.1]}}
world:
  collision_objects:
    - id: pillar
      header: {frame_id: column}
      primitives: [{type: cylinder, dimensions: [1, 0.1]}]
      primitive_poses: [{position: [0.7, 0, 0.5]}]
)");
  const std::string answer = folder_.path("frames.json");
  const std::string roadmap = folder_.path("frames.roadmap");
  const std::string plain = folder_.path("frames.scene");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"solve", scene, "--robot", robot_, "--start", "-0.9,0.3,0.2,0", "--goal",
                                 "0.9,0.3,0.2,0.1", "--json", answer, "--quiet"},
        {"verify", scene, answer},
        {"render", scene, "--answer", answer, "-o", folder_.path("frames.svg")},
        {"info", scene, "--robot", robot_},
        {"convert", scene, "--robot", robot_, "-o", plain},
        {"verify", plain, answer},
        {"build", scene, "--robot", robot_, "-o", roadmap, "--samples", "50", "--quiet"},
        {"update", roadmap, scene, "-o", roadmap + "2", "--quiet"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << shown(words) << outcome.err;
  }
  std::string open = folder_.read("frames.yaml");  // says no more where joint base is
  open.erase(open.find("robot_state"), open.find("world:") - open.find("robot_state"));
  const Outcome unsaid = run({"update", roadmap, folder_.write("open.yaml", open), "-o", roadmap + "3"});
  EXPECT_EQ(unsaid.code, 65);
  EXPECT_NE(unsaid.err.find("this frame moves with joint base"), std::string::npos) << unsaid.err;
  const Outcome unknown = run({"convert", scene, "-o", plain});
  EXPECT_EQ(unknown.code, 65);
  EXPECT_NE(unknown.err.find("frames.yaml:6: nobody says where this frame is"), std::string::npos) << unknown.err;
  const Outcome ignored = run({"convert", file_, "--robot", robot_, "-o", plain});
  EXPECT_EQ(ignored.code, 2);
  EXPECT_NE(ignored.err.find("--robot: is for --simplify"), std::string::npos) << ignored.err;
  EXPECT_EQ(run({"info", scene}).code, 65);
  for (const std::string& other : {file_, roadmap, folder_.path("crane.urdf"), std::string("maze:5x5")}) {
    const Outcome passed_over = run({"info", other, "--robot", robot_});
    EXPECT_EQ(passed_over.code, 2) << other;
    EXPECT_NE(passed_over.err.find("--robot: is for a scene or request of MoveIt"), std::string::npos) << other;
  }
}

/// As if the URDF had one fixed joint more; the tool's goals are in the world, and so is what stands in it.
TEST_F(SolveUrdf, ARobotStandsAnywhere) {
  const auto words = [](std::string robot) { return robot.replace(robot.find("crane.urdf"), 10, "far.urdf"); };
  std::string far = crane_urdf;
  far.replace(far.find("<link name=\"world\"/>"), 21,
              R"(<link name="ground"/><link name="world"/><joint name="put" type="fixed"><parent link="ground"/>)"
              R"(<child link="world"/><origin xyz="30 -20 0.5"/></joint>)");
  folder_.write("far.urdf", far);
  const std::string stands = robot_ + " base-pose 30 -20 0.5 0 0 0 1";
  const std::string ends = "\nstart -0.9 0.3 0.2 0\ngoal 0.9 0.3 0.2 0.1\n";
  const std::string yard_there = "\ncylinder 30.7 -20 0.5 30.7 -20 1.5 0.1" + ends;
  const std::string scene = folder_.write("there.scene", "robot " + stands + yard_there);
  const std::string fixed = folder_.write("fixed.scene", "robot " + words(robot_) + yard_there);
  const std::string answer = folder_.path("there.json");
  for (const auto& [file, json] : {std::pair(scene, answer), {fixed, folder_.path("fixed.json")}})
    ASSERT_EQ(run({"solve", file, "--json", json, "--quiet"}).code, 0);
  const Json here = Json::parse(folder_.read("there.json"));
  EXPECT_EQ(here["path"], Json::parse(folder_.read("fixed.json"))["path"]);
  EXPECT_EQ(here["robot"].get<std::string>(), stands);
  const std::string plain = folder_.write("here.scene", "robot " + robot_ + "\ncylinder 0.7 0 0 0.7 0 1 0.1" + ends);
  const Json at_origin = Json::parse(run({"solve", plain, "--json", "-"}).out);
  EXPECT_NEAR(here["min_clearance"].get<double>(), at_origin["min_clearance"].get<double>(), 1e-7) << "as sharp";
  for (const std::vector<std::string>& asked : {std::vector<std::string>{"verify", scene, answer},
                                                {"render", scene, "--answer", answer, "-o", folder_.path("there.svg")},
                                                {"solve", scene, "--goal-pose", "29,-20,0.9,0,0,1,0", "--quiet"}}) {
    const Outcome outcome = run(asked);
    EXPECT_EQ(outcome.code, 0) << shown(asked) << outcome.err;
  }
  const Outcome out_of_reach = run({"solve", scene, "--goal-pose", "30,-10,0.5,0,0,1,0"});
  EXPECT_EQ(out_of_reach.code, 1);
  EXPECT_NE(out_of_reach.out.find("it is 10 from the base"), std::string::npos) << out_of_reach.out;
}

/// Of MoveIt: the state of the scene has it, then the request's; `convert` keeps it.
TEST_F(SolveUrdf, ARobotStandsWhereMoveItHasIt) {
  folder_.write("crane.srdf", std::string(crane_srdf).replace(22, 0, R"(<virtual_joint name="wheels" type="planar"
    parent_frame="odom" child_link="world"/>)"));
  const std::string state =
      "multi_dof_joint_state: {header: {frame_id: odom}, joint_names: [wheels], transforms: "
      "[{translation: [4, 0, 0], rotation: [0, 0, 1, 0]}]}";
  const std::string scene = folder_.write("there.yaml", "robot_model_name: crane\nrobot_state: {" + state + R"(}
world:
  collision_objects:
    - id: pillar
      header: {frame_id: odom}
      primitives: [{type: cylinder, dimensions: [1, 0.1]}]
      primitive_poses: [{position: [3.3, 0, 0.5]}]
)");
  const std::string request = folder_.write(
      "r.yaml",
      "group_name: arm\nstart_state: {joint_state: {name: [base, shoulder, elbow, slide], position: [-0.9, "
      "0.3, 0.2, 0]}, " +
          state +
          "}\ngoal_constraints: [{joint_constraints: [{joint_name: base, position: "
          "0.9}, {joint_name: shoulder, position: 0.3}, {joint_name: elbow, position: 0.2}, {joint_name: slide, "
          "position: 0.1}]}]\n");
  const std::string answer = folder_.path("there.json");
  const std::string plain = folder_.path("there.scene");
  const std::string roadmap = folder_.path("there.roadmap");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"solve", scene, "--robot", robot_, "--request", request, "--json", answer, "--quiet"},
        {"verify", scene, answer},
        {"render", scene, "--answer", answer, "-o", folder_.path("there.svg")},
        {"convert", scene, "--request", request, "--robot", robot_, "-o", plain},
        {"verify", plain, answer},
        {"solve", plain, "--robot", robot_, "--request", request, "--quiet"},
        {"build", scene, "--robot", robot_, "-o", roadmap, "--samples", "50", "--quiet"},
        {"update", roadmap, plain, "-o", roadmap + "2", "--quiet"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << shown(words) << outcome.err;
  }
  EXPECT_NE(folder_.read("there.scene").find("base-pose 4 0 0 0 0 1 0\n"), std::string::npos);
  EXPECT_EQ(Json::parse(folder_.read("there.json"))["start"], Json::parse("[-0.9, 0.3, 0.2, 0.0]"));
  const Outcome blocked = run({"solve", plain, "--robot", robot_, "--start", "0,0,0,0"});
  EXPECT_NE(blocked.out.find("cylinder 0: at 3.3 0 0.5"), std::string::npos) << blocked.out;
  const Outcome unknown = run({"info", scene});
  EXPECT_EQ(unknown.code, 65);
  EXPECT_NE(unknown.err.find("there.yaml:2: only the SRDF's virtual joint"), std::string::npos) << unknown.err;
}

TEST_F(SolveUrdf, AnAnswerOfOtherJointsIsNeitherKeptNorDrawn) {
  const std::string answer = folder_.path("old.json");
  ASSERT_EQ(run({"solve", file_, "--json", answer, "--quiet"}).code, 0);
  EXPECT_EQ(run({"solve", file_, "--keep-to", answer, "--unless-gain", "0.99", "--quiet"}).code, 0);
  std::string swapped = folder_.read("old.json");
  swapped.replace(swapped.find("[\"base\", \"shoulder\""), 19, "[\"shoulder\", \"base\"");
  folder_.write("old.json", swapped);
  const Outcome kept = run({"solve", file_, "--keep-to", answer, "--json", "-"});
  EXPECT_EQ(kept.code, 2);
  EXPECT_NE(kept.err.find("--keep-to: the path is of other joints than the robot's"), std::string::npos) << kept.err;
  const Outcome drawn = run({"render", file_, "--answer", answer, "-o", folder_.path("old.svg")});
  EXPECT_EQ(drawn.code, 65);
  EXPECT_NE(drawn.err.find("old.json: key \"joints\": the robot has other joints"), std::string::npos) << drawn.err;
}

/// What is carried is a part of the body: of another roadmap, and of another world.
TEST_F(SolveUrdf, ARoadmapIsUpdatedToWhatTheChangedWorldSaysOfTheArm) {
  const std::string roadmap = folder_.path("crane.roadmap");
  ASSERT_EQ(run({"build", file_, "-o", roadmap, "--samples", "600", "--quiet"}).code, 0);
  const std::string laden = folder_.write(
      "laden.scene", "robot " + robot_ + "\n" + yard + "attach hook sphere 0.25 0 0 0.15\nallow upper hook\n");
  const std::vector<std::string> ends{"--start", "-0.9,0.3,0.2,0", "--goal", "0.9,0.3,0.2,0.1", "--json", "-"};
  const auto asked = [&](const std::string& kept) {
    std::vector<std::string> words{"query", kept};
    words.insert(words.end(), ends.begin(), ends.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  };
  const std::string changed = folder_.path("laden.roadmap");
  ASSERT_EQ(run({"update", roadmap, laden, "-o", changed, "--quiet"}).code, 0);
  EXPECT_EQ(run({"verify", laden, folder_.write("laden.json", asked(changed))}).code, 0);
  EXPECT_EQ(Json::parse(folder_.read("laden.json"))["robot"].get<std::string>(), robot_ + " allow upper hook");
  EXPECT_EQ(run({"verify", laden, folder_.write("bare.json", asked(roadmap))}).code, 65) << "of another world";
  const std::string back = folder_.path("back.roadmap");
  ASSERT_EQ(run({"update", changed, file_, "-o", back, "--quiet"}).code, 0);
  EXPECT_EQ(Json::parse(asked(back))["path"], Json::parse(asked(roadmap))["path"]);
  EXPECT_EQ(Json::parse(asked(back))["robot"], Json(robot_));
}

/// The group is said twice in the old world, once in the robot's line of the new one.
TEST_F(SolveUrdf, AnUpdateKeepsTheGroupThatTheChangedWorldDoesNotName) {
  const std::string twice = folder_.write("twice.scene", "robot " + robot_ + "\n" + yard + "group arm\n");
  const std::string roadmap = folder_.path("twice.roadmap");
  ASSERT_EQ(run({"build", twice, "-o", roadmap, "--samples", "50", "--quiet"}).code, 0);
  ASSERT_EQ(run({"update", roadmap, file_, "-o", roadmap + "2", "--quiet"}).code, 0);
  EXPECT_NE(run({"info", roadmap + "2"}).out.find("group arm"), std::string::npos);
  const std::string request = folder_.write("g.yaml", "group_name: arm\nstart_state: {}\n");
  std::string ends = robot_;
  ends = ends.substr(0, ends.find(" srdf")) + " base world tip hook";
  const std::string scene = folder_.write("ends.scene", "robot " + ends + "\n" + yard);
  const Outcome refused = run({"solve", scene, "--request", request, "--json", "-"});
  EXPECT_EQ(refused.code, 65);
  EXPECT_NE(refused.err.find("g.yaml:1: the robot's line says base and tip"), std::string::npos) << refused.err;
}

TEST_F(SolveUrdf, ATwiceSaidToolOrGroupIsRefusedWhereItDiffers) {
  const std::string request =
      folder_.write("request.yaml", "group_name: arms\nstart_state: {joint_state: {name: [base], position: [0.1]}}\n");
  const Outcome outcome = run({"solve", file_, "--robot", robot_, "--request", request, "--json", "-"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--robot: says group arm, the request arms"), std::string::npos) << outcome.err;
  std::string ends = robot_;
  ends.replace(ends.rfind("group arm"), 9, "base world tip hook");
  const std::string crane = folder_.write("m.yaml", "robot_model_name: crane\nworld: {collision_objects: []}\n");
  const Outcome both = run({"solve", crane, "--robot", ends, "--request", request, "--json", "-"});
  EXPECT_EQ(both.code, 2);
  EXPECT_NE(both.err.find("--robot: says base and tip, the request group arms"), std::string::npos) << both.err;
}

/// A joint that follows one that is held stands where that one takes it, whatever else is said of it.
TEST_F(SolveUrdf, EndsHaveWhatFollowsAHeldJointWhereItIs) {
  const auto asked = [&](const std::string& grip) {
    std::string robot = robot_;
    robot.replace(robot.rfind("group arm"), 9, "base world tip lower");
    const std::string text = "sphere 9 9 9 1\nrobot " + robot +
                             "\nhold slide 0.1\nhold grip 0.15\nstart joints base 0 shoulder 0 elbow 0\n"
                             "goal joints base 0.5 shoulder 0 elbow 0 grip " +
                             grip + "\n";
    return run({"solve", folder_.write("held.scene", text), "--json", "-"});
  };
  EXPECT_EQ(asked("0.01").code, 0) << asked("0.01").err;
  EXPECT_NE(asked("0.15").err.find("joint 'grip' at 0.15, but it is at 0.01 there"), std::string::npos);
}

/// Whatever files, folders and links are called, what is written is read back.
TEST_F(SolveUrdf, BracketsInNamesAreOfTheName) {
  folder_.write("crane[1].urdf", crane_urdf);
  std::string robot = robot_;
  robot.replace(robot.find("crane.urdf"), 10, "crane[1].urdf");
  const std::string scene = folder_.write("b.scene", "robot " + robot + "\n" + yard);
  const std::string answer = folder_.path("b.json");
  ASSERT_EQ(run({"solve", scene, "--json", answer, "--quiet"}).code, 0);
  EXPECT_EQ(run({"verify", scene, answer}).code, 0);
  EXPECT_EQ(run({"solve", file_, "--robot", robot, "--json", "-"}).code, 0);
  std::string swapped = folder_.read("b.json");
  swapped.replace(swapped.find("[\"base\", \"shoulder\""), 19, "[\"shoulder\", \"base\"");
  const Outcome other = run({"verify", scene, folder_.write("s.json", swapped)});
  EXPECT_EQ(other.code, 65);
  EXPECT_NE(other.err.find("key \"joints\""), std::string::npos) << other.err;
}

TEST_F(SolveUrdf, ASceneOfARequestHasItsGroupAndReadsItsLinksBack) {
  const std::string request =
      folder_.write("r.yaml",
                    "group_name: arm\nstart_state: {joint_state: {name: [base, shoulder, elbow, slide], "
                    "position: [0, 0, 0, 0]}}\ngoal_constraints: [{joint_constraints: [{joint_name: base, "
                    "position: 0.5}, {joint_name: shoulder, position: 0}, {joint_name: elbow, position: 0}, "
                    "{joint_name: slide, position: 0}]}]\n");
  const std::string yaml = folder_.write("m.yaml", "robot_model_name: crane\nworld: {collision_objects: []}\n");
  const std::string scene = folder_.path("m.scene");
  ASSERT_EQ(run({"convert", yaml, "--request", request, "-o", scene, "--quiet"}).code, 0);
  EXPECT_NE(folder_.read("m.scene").find("group arm\n"), std::string::npos);
  const std::string robot = robot_.substr(0, robot_.rfind(" group arm"));
  const Outcome solved = run({"solve", scene, "--robot", robot, "--json", "-"});
  ASSERT_EQ(solved.code, 0) << solved.err;
  EXPECT_EQ(Json::parse(solved.out)["joints"].size(), 4U);
  const std::string odd = folder_.write(
      "odd.scene", "robot " + robot_ + "\n" + yard + "attach hook box sphere obox 0 0 0 0 0 0 1 0.1 0.1 0.1\n");
  const Outcome info = run({"info", odd});
  EXPECT_EQ(info.err.find("expected a number"), std::string::npos) << info.err;
}

TEST_F(SolveUrdf, IsTimedByItsFile) {
  const std::string path = folder_.path("crane.csv");
  const Outcome outcome = run({"solve", file_, "--path", path, "--joint-speed", "file", "--quiet"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(folder_.read("crane.csv").substr(0, 20), "t,s,q1,q2,q3,q4,spee");
  EXPECT_EQ(run({"solve", file_, "--path", path, "--joint-speed", "1,1,1", "--quiet"}).code, 2);
}

/// What is read as straight lines between rows goes the way that was judged: the shorter one, over more than one leg.
TEST_F(SolveUrdf, AJointWithoutEndCountsOnInFiles) {
  const std::string path = folder_.path("turns.csv");
  const std::vector<std::string> common{"solve",  file_,         "--start", "4.6,-1,0,0", "--via",  "-1.68,-1,0,0",
                                        "--goal", "-1.6,-1,0,0", "--path",  path,         "--quiet"};
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--joint-speed", "1"}, {"--joint-speed", "1", "--every", "10ms"}}) {
    std::vector<std::string> words = common;
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.code, 0) << shown(words) << outcome.err;
    std::istringstream rows(folder_.read("turns.csv"));
    std::string row;
    std::getline(rows, row);
    const int commas = more.empty() ? 1 : 2;
    double last = 4.6;
    while (std::getline(rows, row)) {
      std::istringstream numbers(row);
      std::string number;
      for (int i = 0; i <= commas; ++i) std::getline(numbers, number, ',');
      EXPECT_LT(std::abs(std::stod(number) - last), 0.1) << row;
      last = std::stod(number);
    }
    EXPECT_NEAR(last, 2.0 * M_PI - 1.6, 1e-12);
  }
}

TEST_F(SolveUrdf, InfoTellsWhatIsInIt) {
  const Outcome outcome =
      run({"info", folder_.path("crane.urdf"), "--srdf", folder_.path("crane.srdf"), "--group", "arm"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* said : {"base: turns without end", "slide: slides 0 to 0.2 m", "moving joints"}) {
    EXPECT_NE(outcome.out.find(said), std::string::npos) << outcome.out;
  }
}

TEST_F(SolveUrdf, InfoReadsAPipeOnce) {
  const std::string pipe = folder_.path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(pipe) << crane_urdf; });
  const Outcome outcome = run({"info", "-"}, pipe);
  writer.join();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("slide: slides 0 to 0.2 m"), std::string::npos) << outcome.out;
}

TEST_F(SolveUrdf, SaysWhatIsWrongInOneLine) {
  struct Case {
    std::vector<std::string> arguments;
    const char* says;
    int code;
  };
  const std::vector<Case> cases = {{{"--start", "0,0"}, "4 joint values", 2},
                                   {{"--goal", "0,0"}, "place of the tool", 2},
                                   {{"--via", "0,0"}, "4 joint values", 2},
                                   {{"--goal-pose", "0,0,1,0,0,0,0"}, "quaternion", 2},
                                   {{"--robot", "urdf " + folder_.path("none.urdf")}, "none.urdf", 66},
                                   {{"--robot", robot_ + "s"}, "arms", 65}};
  for (const Case& c : cases) {
    std::vector<std::string> arguments{"solve", file_};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, c.code) << shown(arguments) << outcome.err;
    EXPECT_NE(outcome.err.find(c.says), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

}  // namespace
}  // namespace warren::test
