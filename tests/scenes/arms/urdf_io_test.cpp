// SPDX-License-Identifier: BSD-3-Clause
// Robots of a few links, whose frames are worked out here by Eigen's own rotations.
#include "scenes/arms/arm_files_io.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/arms/test_meshes.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

std::string link(const std::string& name, const std::string& solid = "<sphere radius=\"0.1\"/>") {
  if (solid.empty()) return fmt::format("<link name=\"{}\"/>\n", name);
  return fmt::format("<link name=\"{}\"><collision><geometry>{}</geometry></collision></link>\n", name, solid);
}
std::string joint(const std::string& name, const std::string& kind, const std::string& above, const std::string& below,
                  const std::string& more = "<limit lower=\"-1\" upper=\"2\" velocity=\"0.5\"/>") {
  return fmt::format("<joint name=\"{}\" type=\"{}\"><parent link=\"{}\"/><child link=\"{}\"/>{}</joint>\n", name, kind,
                     above, below, more);
}
std::string robot(const std::string& parts) { return "<robot name=\"tried\">\n" + parts + "</robot>\n"; }

/// A trunk that rises, two arms of two joints on it, fingers on one that follow each other, a head.
std::string two_arms() {
  std::string text = link("base", "<box size=\"1 2 0.5\"/>") + link("trunk", "<cylinder radius=\"0.2\" length=\"1\"/>");
  text += joint("rise", "prismatic", "base", "trunk",
                "<origin xyz=\"0 0 0.5\"/><axis xyz=\"0 0 2\"/><limit lower=\"0.1\" upper=\"0.4\"/>");
  for (const std::string side : {"right", "left"}) {
    text += link(side + "_upper", "<capsule radius=\"0.1\" length=\"0.5\"/>") + link(side + "_bare", "") +
            link(side + "_hand");
    text += joint(side + "_1", "revolute", "trunk", side + "_upper",
                  fmt::format("<origin xyz=\"0 {} 1\" rpy=\"0.3 -0.2 0.1\"/><axis xyz=\"1 1 0\"/>"
                              "<limit lower=\"-1\" upper=\"2\" velocity=\"0.5\"/>",
                              side == "left" ? 0.5 : -0.5));
    text += joint(side + "_2", "continuous", side + "_upper", side + "_bare",
                  "<origin xyz=\"0.6 0 0\"/><axis xyz=\"0 1 0\"/>");
    text += joint(side + "_3", "fixed", side + "_bare", side + "_hand", "<origin xyz=\"0.2 0 0\" rpy=\"0 0 1.5\"/>");
  }
  text += link("finger") + link("thumb") + link("head");
  text += joint("finger_joint", "prismatic", "left_hand", "finger",
                "<axis xyz=\"0 1 0\"/><limit lower=\"0\" upper=\"0.04\"/>");
  text +=
      joint("thumb_joint", "prismatic", "left_hand", "thumb",
            "<axis xyz=\"0 -1 0\"/><limit lower=\"0\" upper=\"0.06\"/><mimic joint=\"finger_joint\" multiplier=\"2\" "
            "offset=\"0.01\"/>");
  text += joint("neck", "revolute", "trunk", "head", "<limit lower=\"0.5\" upper=\"1\"/>");
  return robot(text);
}

const char* const groups = R"(<robot name="tried">
<group name="left"><chain base_link="trunk" tip_link="left_hand"/></group>
<group name="right"><joint name="right_2"/><joint name="right_1"/><joint name="right_3"/></group>
<group name="both"><group name="right"/><group name="left"/></group>
<group name="whole"><group name="both"/><joint name="rise"/><link name="base"/><group name="whole"/></group>
<group name="gripper"><link name="finger"/><joint name="thumb_joint"/></group>
<group name="hand to hand"><chain base_link="right_hand" tip_link="left_hand"/></group>
<group name="lost"><joint name="none"/></group>
<group name="none"><joint name="right_3"/></group>
<group name="drives"><joint name="base_joint"/></group>
<virtual_joint name="base_joint" type="planar" parent_frame="odom" child_link="base"/>
<passive_joint name="neck"/>
<disable_collisions link1="left_hand" link2="trunk" reason="Never"/>
<disable_collisions link1="nobody" link2="trunk"/>
</robot>)";

/// Read from a folder of its own.
class Urdf : public ::testing::Test {
 protected:
  ArmModel read(const std::string& text, ArmFiles files = {}) const {
    files.urdf = directory_.write("robot.urdf", text);
    if (!files.group.empty()) files.srdf = directory_.write("robot.srdf", groups);
    return read_urdf(files, {});
  }
  ArmModel read_group(const std::string& name) const {
    ArmFiles files;
    files.group = name;
    return read(two_arms(), files);
  }
  void expect_refused(const std::string& text, const ArmFiles& files, const std::string& says) const {
    SCOPED_TRACE(says);
    const std::string said = test::refusal<PlacedError>([&] { read(text, files); });
    EXPECT_NE(said.find(says), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }

  TemporaryDirectory directory_;
};

std::vector<std::string> names(const ArmModel& model) {
  std::vector<std::string> all;
  for (const ArmVariable& variable : model.variables) all.push_back(variable.name);
  return all;
}
std::vector<std::string> pairs(const ArmModel& model) {
  std::vector<std::string> all;
  for (const auto& [a, b] : model.pairs) all.push_back(model.links[a].name + " " + model.links[b].name);
  return all;
}
bool has(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}
Eigen::Isometry3d at(double x, double y, double z) { return Eigen::Isometry3d(Eigen::Translation3d(x, y, z)); }
Eigen::AngleAxisd about(const Vec3& axis, double angle) { return {angle, axis.normalized()}; }

Eigen::Isometry3d pose_in(const ArmModel& model, int frame, const std::vector<double>& state) {
  if (frame == base_frame) return Eigen::Isometry3d::Identity();
  const ArmJoint& j = model.joints[static_cast<std::size_t>(frame)];
  const double value = j.multiplier * state[j.variable] + j.offset;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (j.slides) {
    motion.translation() = value * j.axis;
  } else {
    motion.linear() = about(j.axis, value).toRotationMatrix();
  }
  return pose_in(model, j.parent, state) * j.origin * motion;
}
Eigen::Isometry3d pose_of(const ArmModel& model, const std::string& name, const std::vector<double>& state) {
  for (const ArmLink& l : model.links)
    if (l.name == name) return pose_in(model, l.frame, state) * l.solids[0].pose;
  ADD_FAILURE() << "no link " << name;
  return Eigen::Isometry3d::Identity();
}
/// Of an arm on the trunk, which is so high.
Eigen::Isometry3d hand(double side, double high, double first, double second) {
  return at(0, 0, high) * at(0, side, 1) * about({0, 0, 1}, 0.1) * about({0, 1, 0}, -0.2) * about({1, 0, 0}, 0.3) *
         about({1, 1, 0}, first) * at(0.6, 0, 0) * about({0, 1, 0}, second) * at(0.2, 0, 0) * about({0, 0, 1}, 1.5);
}
void expect_near(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  EXPECT_LT((a.matrix() - b.matrix()).norm(), 1e-14);
}

TEST_F(Urdf, AllJointsThatMoveOnTheirOwnMoveDepthFirstByName) {
  const ArmModel model = read(two_arms());
  EXPECT_EQ(model.name, "tried");
  EXPECT_EQ(names(model),
            (std::vector<std::string>{"rise", "left_1", "left_2", "finger_joint", "neck", "right_1", "right_2"}));
  EXPECT_TRUE(model.variables[0].slides);
  EXPECT_EQ(model.variables[0].low, 0.1);
  EXPECT_EQ(model.variables[1].speed, 0.5);
  EXPECT_TRUE(model.variables[2].continuous);
  EXPECT_EQ(model.variables[2].high, std::numbers::pi);
  EXPECT_DOUBLE_EQ(model.variables[3].high, 0.025) << "where the thumb ends";
  ASSERT_EQ(model.joints.size(), 8U);
  const std::vector<double> state{0.3, 0.7, -2.0, 0.02, 0.6, -0.4, 1.0};
  expect_near(pose_of(model, "base", state), at(0, 0, 0));
  expect_near(pose_of(model, "trunk", state), at(0, 0, 0.8));
  expect_near(pose_of(model, "left_hand", state), hand(0.5, 0.8, 0.7, -2.0));
  expect_near(pose_of(model, "right_hand", state), hand(-0.5, 0.8, -0.4, 1.0));
  expect_near(pose_of(model, "finger", state), hand(0.5, 0.8, 0.7, -2.0) * at(0, 0.02, 0));
  expect_near(pose_of(model, "thumb", state), hand(0.5, 0.8, 0.7, -2.0) * at(0, -0.05, 0));
  expect_near(pose_of(model, "head", state), at(0, 0, 0.8) * about({1, 0, 0}, 0.6));
  expect_near(pose_in(model, model.tool_frame, state) * model.tool, hand(-0.5, 0.8, -0.4, 1.0));
}

TEST_F(Urdf, SolidsAreWhatTheFileSays) {
  const ArmModel model = read(two_arms());
  const auto solid = [&](std::size_t i) { return model.links[i].solids[0]; };
  EXPECT_EQ(solid(0).kind, SolidKind::box);
  EXPECT_EQ(solid(0).half, Vec3(0.5, 1, 0.25));
  EXPECT_EQ(solid(1).kind, SolidKind::cylinder);
  EXPECT_EQ(solid(1).half, Vec3(0.2, 0, 0.5));
  EXPECT_EQ(solid(2).kind, SolidKind::capsule);
  EXPECT_EQ(solid(2).half, Vec3(0.1, 0, 0.25));
  EXPECT_EQ(solid(3).kind, SolidKind::sphere);
  EXPECT_EQ(solid(3).half.x(), 0.1);
}

TEST_F(Urdf, GroupsAreChainsJointsLinksAndGroups) {
  const ArmModel left = read_group("left");
  EXPECT_EQ(names(left), (std::vector<std::string>{"left_1", "left_2"}));
  expect_near(pose_in(left, left.tool_frame, {1, 2}) * left.tool, hand(0.5, 0.6, 1, 2));
  EXPECT_EQ(names(read_group("right")), (std::vector<std::string>{"right_1", "right_2"}));
  EXPECT_EQ(names(read_group("both")), (std::vector<std::string>{"left_1", "left_2", "right_1", "right_2"}));
  EXPECT_EQ(names(read_group("whole")), (std::vector<std::string>{"rise", "left_1", "left_2", "right_1", "right_2"}));
  EXPECT_EQ(names(read_group("gripper")), std::vector<std::string>{"finger_joint"});
  EXPECT_EQ(names(read_group("hand to hand")), (std::vector<std::string>{"left_1", "left_2", "right_1", "right_2"}));
}

TEST_F(Urdf, AChainIsTakenByItsEnds) {
  ArmFiles files;
  files.base = "base";
  files.tip = "finger";
  EXPECT_EQ(names(read(two_arms(), files)), (std::vector<std::string>{"rise", "left_1", "left_2", "finger_joint"}));
  files.tip = "nobody";
  expect_refused(two_arms(), files, "has no link of this name (found: nobody)");
}

TEST_F(Urdf, TheToolIsTheLinkThatIsNamed) {
  ArmFiles files;
  files.base = "base";
  files.tip = "finger";
  files.tool = "left_hand";
  const ArmModel model = read(two_arms(), files);
  EXPECT_EQ(model.told[0], "the tool is left_hand");
  const std::vector<double> state{0.2, 0.5, -0.4, 0.01};
  expect_near(pose_in(model, model.tool_frame, state) * model.tool, pose_of(model, "left_hand", state));
  files.tool = "nobody";
  expect_refused(two_arms(), files, "has no link of this name to be the tool (found: nobody)");
}

TEST_F(Urdf, SoftLimitsAreToldNotKept) {
  const std::string limits = "<limit lower=\"-1\" upper=\"2\"/><safety_controller soft_lower_limit=\"-0.9\"/>";
  const ArmModel model = read(robot(link("a") + link("b") + joint("j", "revolute", "a", "b", limits)));
  EXPECT_EQ(model.variables[0].low, -1.0);
  EXPECT_EQ(model.told[0], "j keeps <limit>, -1 to 2, not its soft limits, -0.9 to 2");
}

TEST_F(Urdf, NumbersNearToZeroAreZero) {
  const std::string near = "<limit lower=\"-1e-400\" upper=\"+1\"/><origin xyz=\"1e-400 2 -1e-101\"/>";
  const ArmModel model = read(robot(link("a") + link("b") + joint("j", "revolute", "a", "b", near)));
  EXPECT_EQ(model.variables[0].low, 0.0);
  EXPECT_EQ(Vec3(model.joints[0].origin.translation()), Vec3(0, 2, 0));
}

TEST_F(Urdf, JointsOutsideAreHeldWhereTheirLimitsOrTheSceneSay) {
  ArmFiles files;
  files.group = "right";
  const std::vector<double> state{0.0, 0.0};
  const ArmModel model = read(two_arms(), files);
  expect_near(pose_of(model, "trunk", state), at(0, 0, 0.6));
  expect_near(pose_of(model, "head", state), at(0, 0, 0.6) * about({1, 0, 0}, 0.5));
  expect_near(pose_of(model, "thumb", state), hand(0.5, 0.6, 0, 0) * at(0, -0.01, 0));
  EXPECT_EQ(model.joints.size(), 2U);
  files.held = {{"rise", 0.2},        {"left_2", 1.5},  {"finger_joint", 0.03},
                {"thumb_joint", 9.0}, {"right_1", 9.0}, {"none", 0.0}};
  const ArmModel held = read(two_arms(), files);
  expect_near(pose_of(held, "thumb", state), hand(0.5, 0.7, 0, 1.5) * at(0, -0.07, 0));
  expect_near(pose_of(held, "right_hand", state), hand(-0.5, 0.7, 0, 0));
  files.held = {{"none", 0.1}};
  expect_refused(two_arms(), files, "has no joint of this name to hold (found: none)");
}

TEST_F(Urdf, PairsLeaveOutNeighboursAndWhatIsAllowed) {
  ArmFiles files;
  files.group = "both";
  const std::vector<std::string> all = pairs(read(two_arms(), files));
  EXPECT_TRUE(has(all, "left_hand right_hand"));
  EXPECT_TRUE(has(all, "base left_upper"));
  EXPECT_TRUE(has(all, "left_upper finger"));
  EXPECT_FALSE(has(all, "base trunk")) << "nothing moves between";
  EXPECT_FALSE(has(all, "left_hand finger")) << "nor here: it is held";
  EXPECT_FALSE(has(all, "trunk left_upper")) << "neighbours";
  EXPECT_FALSE(has(all, "left_upper left_hand")) << "neighbours through a bare link";
  EXPECT_FALSE(has(all, "trunk left_hand")) << "the SRDF's";
  EXPECT_TRUE(has(all, "trunk right_hand"));
  files.allowed = {{"right_hand", "trunk"}, {"left_hand", "nobody"}};
  EXPECT_EQ(pairs(read(two_arms(), files)).size(), all.size() - 1);
}

/// An SRDF and a scene of MoveIt may name more than there is, which is told; a line of text may not.
TEST_F(Urdf, NamesThatTheRobotLacksAreToldOrRefused) {
  ArmFiles files;
  files.group = "both";
  files.allowed = {{"left_hand", "lost"}};
  files.held = {{"wheel", 0.0}};
  files.attached = {{"left_hand", {.name = "tray"}, {"tray table"}}};
  EXPECT_EQ(read(two_arms(), files).told.back(), "named, but not in the robot: lost, nobody, tray table, wheel");
  files.said = {{"right_bare", "a.scene:2"}, {"tray", "a.scene:2"}};
  EXPECT_NO_THROW(read(two_arms(), files));
  files.said.emplace_back("left_hnd", "a.scene:3");
  expect_refused(two_arms(), files, "robot.urdf has no link of this name (found: left_hnd)");
  expect_refused(two_arms(), files, "a.scene:3: ");
}

TEST_F(Urdf, LinksMayBeAllowedAllAndForbiddenSome) {
  ArmFiles files;
  files.group = "left";
  files.urdf = directory_.write("robot.urdf", two_arms());
  files.srdf = directory_.write("some.srdf",
                                "<robot><group name=\"left\"><chain base_link=\"trunk\" tip_link=\"left_hand\"/>"
                                "</group><disable_default_collisions link=\"left_hand\"/>"
                                "<enable_collisions link1=\"head\" link2=\"left_hand\"/></robot>");
  const std::vector<std::string> all = pairs(read_urdf(files, {}));
  EXPECT_TRUE(has(all, "left_hand head"));
  EXPECT_FALSE(has(all, "base left_hand"));
  EXPECT_TRUE(has(all, "base left_upper"));
}

TEST_F(Urdf, CarriedBodiesMoveWithTheirLink) {
  ArmFiles files;
  files.group = "left";
  Solid tray;
  tray.kind = SolidKind::box;
  tray.pose = at(0.1, 0, 0);
  tray.name = "tray";
  files.attached = {{"left_bare", tray, {"head"}}};
  const ArmModel model = read(two_arms(), files);
  ASSERT_EQ(model.links.back().name, "tray");
  expect_near(pose_of(model, "tray", {1, 2}), hand(0.5, 0.6, 1, 2) * about({0, 0, 1}, -1.5) * at(-0.1, 0, 0));
  const std::vector<std::string> all = pairs(model);
  EXPECT_TRUE(has(all, "left_upper tray"));
  EXPECT_TRUE(has(all, "trunk tray"));
  EXPECT_FALSE(has(all, "head tray"));
  EXPECT_FALSE(has(all, "left_hand tray"));
  Solid cap = tray;
  cap.name = "cap";
  files.attached.push_back({"head", cap, {}});
  EXPECT_TRUE(has(pairs(read(two_arms(), files)), "tray cap"));
  files.attached[0].may_touch = {"cap"};
  EXPECT_FALSE(has(pairs(read(two_arms(), files)), "tray cap")) << "by its name";
  files.attached[0].link = "nobody";
  expect_refused(two_arms(), files, "no link of this name to attach a body to (found: nobody)");
}

TEST_F(Urdf, MimicsFollowAlongChainsAndNarrowLimits) {
  const std::string links = link("a") + link("b") + link("c") + link("d");
  const std::string first = joint("1", "revolute", "a", "b");
  const std::string second =
      joint("2", "revolute", "b", "c",
            "<limit lower=\"-9\" upper=\"9\"/><mimic joint=\"1\" multiplier=\"-2\" offset=\"3\"/>");
  const std::string third =
      joint("3", "revolute", "c", "d",
            "<limit lower=\"-2\" upper=\"2\"/><mimic joint=\"2\" multiplier=\"0.5\" offset=\"-1\"/>");
  const ArmModel model = read(robot(links + third + first + second));
  ASSERT_EQ(model.variables.size(), 1U);
  ASSERT_EQ(model.joints.size(), 3U);
  EXPECT_EQ(model.joints[2].multiplier, -1.0);
  EXPECT_EQ(model.joints[2].offset, 0.5);
  EXPECT_EQ(model.variables[0].low, -1.0);
  EXPECT_EQ(model.variables[0].high, 2.0);
  // One that carries nothing has no frame, but follows: a state may name it where it is.
  const std::string idle = joint("4", "revolute", "b", "e",
                                 "<limit lower=\"-9\" upper=\"9\"/><mimic joint=\"1\" multiplier=\"3\" offset=\"1\"/>");
  const ArmModel with_idle = read(robot(links + "<link name=\"e\"/>" + first + second + third + idle));
  EXPECT_EQ(with_idle.joints.size(), 3U);
  EXPECT_TRUE(with_idle.standing.empty());
  ASSERT_EQ(with_idle.idle_followers.size(), 1U);
  EXPECT_EQ(with_idle.idle_followers[0].name, "4");
  EXPECT_EQ(with_idle.idle_followers[0].multiplier, 3.0);
  EXPECT_EQ(with_idle.idle_followers[0].offset, 1.0);
  const std::string ends =
      joint("3", "revolute", "c", "d",
            "<limit lower=\"-1\" upper=\"0\"/><mimic joint=\"2\" multiplier=\"0.5\" offset=\"-1\"/>");
  EXPECT_EQ(read(robot(links + ends + first + second)).variables[0].low, 0.5);
  const auto speed = [&](const std::string& own, const std::string& second_speed) {
    return read(robot(links + joint("1", "revolute", "a", "b", "<limit lower=\"-9\" upper=\"9\"" + own + "/>") +
                      joint("2", "revolute", "b", "c",
                            "<limit lower=\"-9\" upper=\"9\"" + second_speed +
                                "/><mimic joint=\"1\" multiplier=\"-4\"/>") +
                      joint("3", "revolute", "c", "d",
                            "<limit lower=\"-9\" upper=\"9\" velocity=\"1\"/><mimic joint=\"2\" multiplier=\"0.5\"/>")))
        .variables[0]
        .speed;
  };
  EXPECT_EQ(speed(" velocity=\"2\"", " velocity=\"1\""), 0.25);
  EXPECT_EQ(speed(" velocity=\"2\"", ""), 0.5) << "of the second the file does not say";
  EXPECT_EQ(speed(" velocity=\"0.125\"", " velocity=\"1\""), 0.125);
  EXPECT_EQ(speed("", " velocity=\"1\""), 0.0);
  const std::string turning = joint("1", "continuous", "a", "b");
  const auto follows = [&](const std::string& multiplier) {
    return read(robot(links + turning +
                      joint("2", "continuous", "b", "c", "<mimic joint=\"1\" multiplier=\"" + multiplier + "\"/>") +
                      joint("3", "fixed", "c", "d")))
        .variables[0]
        .continuous;
  };
  EXPECT_TRUE(follows("-3"));
  EXPECT_FALSE(follows("0.5"));
  const auto wound = [&](const std::string& limits) {
    return read(robot(links + turning +
                      joint("2", "revolute", "b", "c", limits + "<mimic joint=\"1\" multiplier=\"0.5\"/>") +
                      joint("3", "fixed", "c", "d")))
        .variables[0];
  };
  EXPECT_EQ(wound("<limit lower=\"-5\" upper=\"4\"/>").low, -10.0) << "as far as what follows it goes";
  EXPECT_EQ(wound("<limit lower=\"-5\" upper=\"4\"/>").high, 8.0);
  expect_refused(robot(links + first + second +
                       joint("3", "revolute", "c", "d", "<limit lower=\"50\" upper=\"60\"/><mimic joint=\"2\"/>")),
                 {}, "its limits leave no value to 1, which it mimics");
  const std::string circle = joint("1", "revolute", "a", "b", "<mimic joint=\"2\"/>") +
                             joint("2", "revolute", "b", "c", "<mimic joint=\"1\"/>") + joint("3", "fixed", "c", "d");
  expect_refused(robot(links + circle), {}, "mimic each other in a circle");
}

TEST_F(Urdf, MeshesAreFoundBesideTheFileAboveItAndInPackages) {
  const auto with_mesh = [](const std::string& name, const std::string& more = "") {
    return robot(link("a", "<mesh filename=\"" + name + "\" " + more + "/>") + link("b") +
                 joint("j", "revolute", "a", "b"));
  };
  std::filesystem::create_directories(directory_.file("robots"));
  std::filesystem::create_directories(directory_.file("elsewhere/parts"));
  directory_.write("wedge.obj", test_meshes::obj);
  directory_.write("elsewhere/parts/other.stl", test_meshes::stl_bytes());
  ArmFiles files;
  const auto corners = [&](const std::string& text) {
    files.urdf = directory_.write("robots/robot.urdf", text);
    return read_urdf(files, {}).links[0].solids[0].corners.size();
  };
  EXPECT_EQ(corners(with_mesh("../wedge.obj")), 6U);
  EXPECT_EQ(corners(with_mesh("file://" + directory_.file("wedge.obj"))), 6U);
  EXPECT_EQ(corners(with_mesh("package://anything/wedge.obj")), 6U);
  files.packages = {directory_.file("none"), directory_.file("elsewhere")};
  EXPECT_EQ(corners(with_mesh("package://parts/other.stl")), 6U);
  files.packages = {directory_.file("elsewhere/parts")};
  EXPECT_EQ(corners(with_mesh("package://parts/other.stl")), 6U);
  const ArmModel scaled = [&] {
    files.urdf = directory_.write("robots/robot.urdf", with_mesh("../wedge.obj", "scale=\"-1 2 0.5\""));
    return read_urdf(files, {});
  }();
  EXPECT_EQ(scaled.links[0].solids[0].corners.front(), Vec3(-2, 0, 0));
  ASSERT_EQ(scaled.told.size(), 2U);
  EXPECT_EQ(scaled.told[0], "the tool is b");
  EXPECT_EQ(scaled.told[1], "hull of wedge.obj: 1.00 times its volume");
  expect_refused(with_mesh("package://no/such.obj"), {}, "robot.urdf:2: <mesh>: the mesh is not there; looked for ");
  expect_refused(with_mesh("such.obj"), {}, "`package-path DIR` says where its package is (found: such.obj)");
  expect_refused(with_mesh("package://"), {}, "not there");
}

TEST_F(Urdf, RefusesWhatItCannotReadAsItIsMeant) {
  const std::string links = link("a") + link("b");
  const auto with = [&](const std::string& kind, const std::string& more) {
    return robot(links + joint("j", kind, "a", "b", more));
  };
  const std::string limit = "<limit lower=\"-1\" upper=\"1\"/>";
  const std::pair<std::string, const char*> cases[] = {
      {"", "robot.urdf:1: expected XML whose first element is <robot>"},
      {"<a/>", "(found: a)"},
      {"<robot>\n<link\n</robot>", "expected XML"},
      {"<robot/>", "no <link> that hangs on no joint"},
      {robot("<link/>"), "robot.urdf:2: <link>: `name` is missing"},
      {robot(link("a") + link("a")), ":3: <link>: a second link of this name (found: a)"},
      {robot(link("a")), "no joint moves on its own"},
      {robot(links), "a second link that hangs on no joint, as a does (found: b)"},
      {robot(links + joint("j", "revolute", "a", "b") + joint("k", "revolute", "b", "a")),
       "no <link> that hangs on no joint"},
      {robot(links + link("c") + joint("j", "revolute", "b", "c") + joint("k", "revolute", "c", "b")),
       "some joints go around in a circle"},
      {robot(links + joint("j", "revolute", "a", "b") + joint("k", "revolute", "a", "b")),
       "its child hangs on joint j already"},
      {robot(links + link("c") + joint("j", "revolute", "a", "b") + joint("j", "revolute", "b", "c")),
       "a second joint of this name"},
      {robot(links + joint("j", "revolute", "a", "c")), "<child>: no link has this name (found: c)"},
      {robot(links + "<joint name=\"j\" type=\"revolute\"><parent link=\"a\"/></joint>"),
       "<child link=\"…\"> is missing"},
      {with("hinge", limit), "`type` must be fixed, revolute, continuous or prismatic (found: hinge)"},
      {with("planar", limit), "planar joints are not planned for; make it fixed"},
      {with("revolute", ""), "a joint that moves needs <limit"},
      {with("prismatic", "<limit lower=\"1\"/>"), "a joint that moves needs <limit"},
      {with("revolute", "<limit lower=\"2\" upper=\"1\"/>"), "`lower` must not exceed `upper` (found: 2)"},
      {with("revolute", "<limit lower=\"x\" upper=\"1\"/>"), "`lower` must be a number (found: x)"},
      {with("revolute", "<limit lower=\"+-1\" upper=\"1\"/>"), "`lower` must be a number (found: +-1)"},
      {with("revolute", "<limit lower=\"0\" upper=\"1\" velocity=\"-1\"/>"), "`velocity` must be at least 0"},
      {with("revolute", limit + "<axis xyz=\"0 0 0\"/>"), "the axis has no direction"},
      {with("revolute", limit + "<axis xyz=\"0 1\"/>"), "expected 3 numbers (found: 0 1)"},
      {with("revolute", limit + "<origin xyz=\"0 1 nan\"/>"), "expected 3 numbers"},
      {with("revolute", limit + "<mimic joint=\"k\"/>"), "<mimic>: no joint has this name (found: k)"},
      {robot(link("a") + "<xacro:hand side=\"left\"/>"), ":3: <xacro:hand>: not a URDF yet"},
      {robot("<link name=\"a\">\n<xacro:shape/></link>"), ":3: <xacro:shape>: not a URDF yet"},
      {robot(link("a", "<sphere radius=\"1\"/><box size=\"1 1 1\"/>") + link("b") + joint("j", "revolute", "a", "b")),
       "<box>: a second one; each <collision> has one <geometry>"},
      {robot("<link name=\"a\">\n<collision/></link>" + link("b") + joint("j", "revolute", "a", "b")),
       ":3: <collision>: its <geometry> must be"},
      {robot(link("a", "<cone/>") + link("b") + joint("j", "revolute", "a", "b")), "<geometry> must be a box"},
      {robot(link("a", "<!-- -->") + link("b") + joint("j", "revolute", "a", "b")), "<geometry> must be a box"},
      {robot(link("a", "<box size=\"1 1 -1\"/>") + link("b") + joint("j", "revolute", "a", "b")),
       "`size` must be three"},
      {robot(link("a", "<box/>") + link("b") + joint("j", "revolute", "a", "b")), "`size` must be three"},
      {robot(link("a", "<sphere radius=\"-1\"/>") + link("b") + joint("j", "revolute", "a", "b")),
       "`radius` must be at least 0"},
      {robot(link("a", "<sphere/>") + link("b") + joint("j", "revolute", "a", "b")), "`radius` is missing"}};
  for (const auto& [text, says] : cases) expect_refused(text, {}, says);
}

TEST_F(Urdf, RefusesGroupsThatAreNot) {
  for (const auto& [group, says] :
       {std::pair{"absent", "its groups are left, right, both, whole, gripper"},
        std::pair{"lost", "has no joint of this name (found: none)"}, std::pair{"none", "no joint moves on its own"},
        std::pair{"drives", "a base that moves is not planned for"}}) {
    ArmFiles files;
    files.group = group;
    expect_refused(two_arms(), files, says);
  }
  ArmFiles files;
  files.urdf = directory_.write("robot.urdf", two_arms());
  files.group = "left";
  EXPECT_THROW(read_urdf(files, {}), InputError);
  files.srdf = directory_.write("half.srdf", "<robot name=\"tried\">\n<disable_collisions link1=\"head\"/></robot>");
  files.group.clear();
  EXPECT_THROW(read_urdf(files, {}), InputError);
  files.srdf = directory_.file("none.srdf");
  EXPECT_THROW(read_urdf(files, {}), ReadError);
}

TEST_F(Urdf, AFloatingRootStaysAndOthersAreRefused) {
  const std::string links = link("world", "") + link("a") + link("b");
  const std::string good = joint("f", "floating", "world", "a", "") + joint("j", "revolute", "a", "b");
  const ArmModel model = read(robot(links + good));
  EXPECT_EQ(names(model), std::vector<std::string>{"j"});
  ASSERT_EQ(model.assumed.size(), 1U);
  expect_refused(robot(links + joint("j", "revolute", "world", "a") + joint("f", "floating", "a", "b", "")), {},
                 "floating joints are not planned for");
}

TEST_F(Urdf, LongChainsAreReadAndCountedNotFollowedByRecursion) {
  std::string text = link("l0");
  for (int i = 0; i < 10'000; ++i) {
    text += link(fmt::format("l{}", i + 1), i % 1000 == 0 ? "<sphere radius=\"1\"/>" : "");
    text += joint(fmt::format("j{}", i), i % 2500 == 0 ? "revolute" : "fixed", fmt::format("l{}", i),
                  fmt::format("l{}", i + 1));
  }
  EXPECT_EQ(read(robot(text)).variables.size(), 4U);
  std::string many = link("l0");
  std::string followed = link("l0");
  for (int i = 0; i < 40; ++i) {
    for (std::string* to : {&many, &followed}) *to += link(fmt::format("l{}", i + 1));
    const std::string above = fmt::format("l{}", i);
    const std::string below = fmt::format("l{}", i + 1);
    many += joint(fmt::format("j{}", i), "revolute", above, below);
    followed += joint(fmt::format("j{}", i), "revolute", above, below,
                      "<limit lower=\"-1\" upper=\"2\"/>" + std::string(i == 0 ? "" : "<mimic joint=\"j0\"/>"));
  }
  expect_refused(robot(many), {},
                 "at most 14 joints can be planned for; choose some by `group NAME` of an SRDF, or by `base LINK tip "
                 "LINK` (found: 40 joints)");
  expect_refused(robot(followed), {}, "at most 32 joints may move");
}

}  // namespace
}  // namespace warren
