// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/plane_formats_io.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/text/scene_text.hpp"
#include "tests/refusals.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

Scene read(const TemporaryDirectory& directory, std::string_view text) {
  return read_scene_text(InputFile(directory.write("a.scene", text), {}), {});
}

std::string text_of(const Scene& scene) {
  std::string text;
  write_scene_text(scene, [&](std::string_view part) { text += part; }, {});
  return text;
}

TEST(SceneText, ReadsEveryItemOfTheFormat) {
  const TemporaryDirectory directory;
  const Scene scene = read(directory,
                           "\xef\xbb\xbf# every item\r\n"
                           "wall 1 2 3 4\r\n"
                           "  5,6 , 7\t8  # a bare wall\n"
                           "polygon 0 0 1 0 1 1 0 1\n"
                           "sphere 1 2 3 0.5\n"
                           "bounds -1 -2 10 20\n"
                           "clearance .25\n"
                           "robot car radius 0.5 turning +1\n"
                           "start 0 0 -1.5e0\n"
                           "goal 4 5\n"
                           "grid 0.5 36\n"
                           "\n"
                           "-1 -2 -3 -4");
  ASSERT_EQ(scene.walls.size(), 3U);
  EXPECT_EQ(scene.walls.segment(0), (Segment{{1, 2}, {3, 4}}));
  EXPECT_EQ(scene.walls.segment(1), (Segment{{5, 6}, {7, 8}}));
  EXPECT_EQ(scene.walls.segment(2), (Segment{{-1, -2}, {-3, -4}}));
  EXPECT_TRUE(scene.walls.holds_floats());
  ASSERT_EQ(scene.polygons.size(), 1U);
  EXPECT_EQ(scene.polygons[0].corners, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(scene.polygons[0].line, 4U);
  ASSERT_EQ(scene.spheres.size(), 1U);
  EXPECT_EQ(scene.spheres[0].z, 3.0);
  EXPECT_EQ(scene.spheres[0].radius, 0.5);
  EXPECT_EQ(scene.bounds->max, (Vec2{10, 20}));
  EXPECT_EQ(scene.clearance, 0.25);
  EXPECT_EQ(scene.robot->kind, RobotKind::car);
  EXPECT_EQ(scene.robot->radius, 0.5);
  EXPECT_EQ(scene.robot->turning_radius, 1.0);
  EXPECT_EQ(scene.start, (std::vector<double>{0, 0, -1.5}));
  EXPECT_EQ(scene.goal, (std::vector<double>{4, 5}));
  EXPECT_EQ(scene.grid->cell, 0.5);
  EXPECT_EQ(scene.grid->angles, 36U);
  EXPECT_FALSE(scene.maze.has_value());
}

TEST(SceneText, ReadsEveryRobot) {
  const TemporaryDirectory directory;
  const auto robot = [&](const std::string& line) { return *read(directory, "robot " + line + "\n0 0 1 1\n").robot; };
  EXPECT_EQ(robot("point").kind, RobotKind::point);
  EXPECT_EQ(robot("disc 0.3").radius, 0.3);
  EXPECT_EQ(robot("polygon -1 -1 1 -1 0 1").outline, (std::vector<Vec2>{{-1, -1}, {1, -1}, {0, 1}}));
  EXPECT_EQ(robot("puma560 radius 0.05").tool, 0.0);
  EXPECT_EQ(robot("puma560 radius 0.05 tool 0.2").tool, 0.2);
  EXPECT_EQ(robot("car turning 2 radius 0").turning_radius, 2.0);
  EXPECT_EQ(robot("puma560 limits symmetric radius 0.05 self-collision").limits, "symmetric");
  EXPECT_TRUE(robot("puma560 self-collision radius 0.05").self_collision);
  EXPECT_EQ(robot("arm my.dh radius 0.05 tool 0.1").kind, RobotKind::arm);
  EXPECT_EQ(robot("arm my.dh radius 0.05 tool 0.1").table, "my.dh");
}

TEST(SceneText, ReadsAnArmThatFilesDescribe) {
  const TemporaryDirectory directory;
  const std::string line = "robot urdf a/b.urdf package-path p group g srdf c.srdf package-path q hold k 2 allow u v";
  const Scene scene = read(directory, "hold j -0.5\n" + line + "\nallow x y\nsphere 0 0 0 1\n");
  ASSERT_TRUE(scene.robot && scene.robot->files);
  const ArmFiles files = *with_what_is_said(*scene.robot, scene).files;
  EXPECT_EQ(scene.robot->kind, RobotKind::urdf);
  EXPECT_EQ(files.urdf, "a/b.urdf");
  EXPECT_EQ(files.srdf, "c.srdf");
  EXPECT_EQ(files.group, "g");
  EXPECT_EQ(files.packages, (std::vector<std::string>{"p", "q"}));
  EXPECT_EQ(files.held, (std::vector<std::pair<std::string, double>>{{"k", 2.0}, {"j", -0.5}}));
  EXPECT_EQ(files.allowed, (std::vector<std::array<std::string, 2>>{{"u", "v"}, {"x", "y"}}));
  write_scene_text(scene, directory.file("again.scene"), {});
  const Scene again = read_scene_text(InputFile(directory.file("again.scene"), {}), {});
  const std::string words = robot_text(with_what_is_said(*scene.robot, scene));
  EXPECT_EQ(robot_text(with_what_is_said(*again.robot, again)), words);
  EXPECT_EQ(words,
            "urdf a/b.urdf srdf c.srdf group g package-path p package-path q hold k 2 hold j -0.5 allow u v allow x y");
  EXPECT_EQ(read(directory, "robot urdf a.urdf base x tip y\n0 0 1 1\n").robot->files->tip, "y");
  const std::string stands = "robot urdf a.urdf base-pose 1 0 -2 0 0.5 0 1 hold k 2";
  EXPECT_EQ("robot " + robot_text(*read(directory, stands + "\nbase-pose 1 0 -2 0 0.5 0 1\n").robot), stands);
}

TEST(SceneText, TakesWallsAsTheyAre) {
  const TemporaryDirectory directory;
  const Scene scene = read(directory,
                           "0 0 0 0\n0 0 1 1\n0 1 1 0\n0 0 1 1\n0.25 0.25 2 2\n1e6 1e-9 3 0.1\n"
                           "1e-101 -1e-200 1e-400 -0.0000000000000000000001\n1e60 -1e60 0 0\n");
  ASSERT_EQ(scene.walls.size(), 8U);
  EXPECT_FALSE(scene.walls.holds_floats());
  EXPECT_EQ(scene.walls.segment(5), (Segment{{1e6, 1e-9}, {3, 0.1}}));
  EXPECT_EQ(scene.walls.segment(6), (Segment{{0, 0}, {0, -1e-22}}));  // below 1e-100 is zero
  EXPECT_EQ(scene.walls.segment(7).a, (Vec2{1e60, -1e60}));
  EXPECT_EQ(scene.walls.segment(4), (Segment{{0.25, 0.25}, {2, 2}}));
}

TEST(SceneText, ReadsSolids) {
  const TemporaryDirectory directory;
  const Scene scene = read(directory,
                           "obox 1 2 3 0 0 2 2 0.5 0.25 0.125\n"
                           "cylinder 0 0 1 0 0 3 0.5\n"
                           "capsule 1 0 0 4 4 0 0.5\n"
                           "hull 0 0 0 1 0 0 0 1 0 0 0 1\n");
  ASSERT_EQ(scene.solids.size(), 4U);
  const Solid& box = scene.solids[0];
  EXPECT_EQ(box.kind, SolidKind::box);
  EXPECT_EQ(box.half, Vec3(0.5, 0.25, 0.125));
  EXPECT_TRUE((box.pose * Vec3(1, 0, 0)).isApprox(Vec3(1, 3, 3), 1e-15)) << "a quarter turn about z";
  const Solid& cylinder = scene.solids[1];
  EXPECT_EQ(cylinder.kind, SolidKind::cylinder);
  EXPECT_EQ(cylinder.pose.translation(), Vec3(0, 0, 2));
  EXPECT_EQ(cylinder.half, Vec3(0.5, 0, 1));
  const Solid& capsule = scene.solids[2];
  EXPECT_EQ(capsule.kind, SolidKind::capsule);
  EXPECT_TRUE((capsule.pose * Vec3(0, 0, 2.5)).isApprox(Vec3(4, 4, 0), 1e-15));
  EXPECT_TRUE(capsule.pose.linear().isUnitary(1e-15));
  EXPECT_GT(capsule.pose.linear().determinant(), 0.0);
  EXPECT_EQ(scene.solids[3].corners.size(), 4U);
}

TEST(SceneText, WritesSolidsAndWhatIsSaidOfAnArmAsItReadThem) {
  const TemporaryDirectory directory;
  const std::string text =
      "start joints a 0.1 b -2\n"
      "goal joints a 1 b 1\n"
      "goal joints a 2 b 1\n"
      "hold finger 0.04\n"
      "allow hand arm\n"
      "attach hand finger palm box 0 0 0 0.1 0.1 0.3\n"
      "attach hand capsule 0.1 0.7 0.3 0 0 1 0.01 as as\n"
      "obox 0.1 0.2 0.3 0 0 -0.5312887441157063 0.8471908110785643 0.6 0.5 0.02\n"
      "cylinder 0.1 0.7 0.3 0 0 1 0.01\n"
      "capsule 0.1 0.7 0.3 0 0 1 0.01\n"
      "hull 0.1 0 0 1 0 0 0 1 0 0 0 1\n";
  const Scene scene = read(directory, text);
  ASSERT_TRUE(scene.arm && scene.named_start);
  const auto& [palm, place] = scene.arm->said.at(4);
  EXPECT_EQ(palm, "palm");
  EXPECT_TRUE(place.ends_with(":6")) << place;
  EXPECT_EQ(scene.named_start->names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(scene.named_goals.at(1).values, (std::vector<double>{2, 1}));
  EXPECT_EQ(scene.arm->attached.at(0).may_touch, (std::vector<std::string>{"finger", "palm"}));
  EXPECT_EQ(scene.arm->attached.at(0).solid.half, Vec3(0.05, 0.05, 0.15));
  EXPECT_EQ(scene.arm->attached.at(1).solid.name, "as");
  EXPECT_EQ(text_of(scene), text);
  EXPECT_EQ(scene_hash(read(directory, text_of(scene))), scene_hash(scene));
}

TEST(SceneText, WritesSolidsOfNoFileToTheirLastDigits) {
  for (int i = 0; i < 200; ++i) {
    const auto random = [&](int k) { return std::remainder(0.7548776662466927 * (17 * i + k + 1), 1.0); };
    Solid solid{.kind = i % 2 == 0 ? SolidKind::box : SolidKind::capsule, .half = {0.25, 0.5, 0.75}};
    solid.pose =
        pose_of_numbers(std::array{random(0), random(1), random(2), random(3), random(4), random(5), random(6)});
    if (i % 2 == 1) solid.half.y() = 0.0;
    const TemporaryDirectory directory;
    Scene scene;
    scene.solids = {solid};
    const Solid back = read(directory, text_of(scene)).solids.at(0);
    EXPECT_TRUE(back.half.isApprox(solid.half, 1e-14));
    EXPECT_TRUE((back.pose * Vec3::UnitZ()).isApprox(solid.pose * Vec3::UnitZ(), 1e-14));
    if (i % 2 == 0) EXPECT_TRUE(back.pose.isApprox(solid.pose, 1e-14)) << i;
  }
}

TEST(SceneText, ReadsAPoseOfTheTool) {
  const TemporaryDirectory directory;
  const Scene scene = read(directory, "goal pose 1 2 3 0 0 0.5 0.5\n");
  ASSERT_TRUE(scene.goal_pose);
  EXPECT_TRUE((*scene.goal_pose * Vec3(1, 0, 0)).isApprox(Vec3(1, 3, 3), 1e-15));
  EXPECT_EQ(read(directory, text_of(scene)).goal_pose->matrix(), scene.goal_pose->matrix());
}

TEST(SceneText, WhatIsSaidOfAnArmJoinsItsFiles) {
  const TemporaryDirectory directory;
  const Scene scene = read(directory, "hold a 1\nhold b 2\nallow c d\nattach c sphere 0 0 0 1\n");
  RobotSpec robot{.kind = RobotKind::urdf};
  robot.files = ArmFiles{.urdf = "a.urdf", .held = {{"b", 3.0}}};
  const ArmFiles files = *with_what_is_said(robot, scene).files;
  EXPECT_EQ(files.urdf, "a.urdf");
  EXPECT_EQ(files.held, (std::vector<std::pair<std::string, double>>{{"b", 3.0}, {"a", 1.0}}))
      << "the robot's comes first";
  EXPECT_EQ(files.allowed.size() + files.attached.size(), 2U);
  EXPECT_FALSE(with_what_is_said({}, scene).files);
}

TEST(SceneText, OfARobotAloneIsFreeSpace) {
  const TemporaryDirectory directory;
  const Scene scene = read(directory, "robot puma560 radius 0.05\nstart 0 0 0 0 0 0\n");
  EXPECT_TRUE(scene.robot.has_value());
  EXPECT_EQ(scene.walls.size(), 0U);
}

struct BadScene {
  const char* name;
  std::string content;
  const char* expected;  ///< ":line: " and part of the message
};

TEST(SceneText, RefusesBadInputInOneLineThatNamesFileAndLine) {
  const std::string nul("0 0 1 1\n\0\0\1 binary\n", 19);
  const BadScene cases[] = {
      {"empty", "", ":1: the file is empty"},
      {"comments only", "# nothing\n\n", ":2: the file ends without any wall, polygon, sphere, box or bounds"},
      {"an arm without a file", "robot urdf\n", ":1: expected `robot urdf FILE [srdf FILE]"},
      {"half a chain", "robot urdf a base b\n", ":1: expected `robot urdf FILE [srdf FILE]"},
      {"two groups", "robot urdf a srdf s group g base b tip t\n", ":1: expected `robot urdf FILE [srdf FILE]"},
      {"a group of nothing", "robot urdf a group g\n", ":1: expected `robot urdf FILE [srdf FILE]"},
      {"a word of an arm twice", "robot urdf a srdf s srdf t\n", ":1: expected `robot urdf FILE [srdf FILE]"},
      {"a word without its own", "robot urdf a package-path\n", ":1: expected `robot urdf FILE [srdf FILE]"},
      {"a joint nowhere", "robot urdf a\nhold j\n", ":2: expected `hold JOINT VALUE` (found: 0 numbers)"},
      {"a joint somewhere", "robot urdf a\nhold j x\n", ":2: expected a number (found: x)"},
      {"a joint twice", "robot urdf a\nhold j 1\nhold j 2\n", ":3: `hold`: this joint is held already (found: j)"},
      {"too much of a joint", "robot urdf a\nhold j 1 2\n", ":2: expected `hold JOINT VALUE` (found: 2)"},
      {"a link alone", "robot urdf a\nallow x\n", ":2: expected `allow LINK LINK` (found: too few words)"},
      {"a base without a turn", "base-pose 1 2 3\n", ":1: expected `base-pose X Y Z QX QY QZ QW` (found: too few"},
      {"a base of no turn", "base-pose 1 2 3 0 0 0 0\n", ":1: `base-pose`: the quaternion QX QY QZ QW must not be"},
      {"a base of words", "robot urdf a base-pose x\n", ":1: expected `base-pose X Y Z QX QY QZ QW` (found: x)"},
      {"two bases", "robot urdf a base-pose 1 0 0 0 0 0 1\nbase-pose 2 0 0 0 0 0 1\n",
       ":2: `base-pose` says another thing than the robot's line 1"},
      {"a base twice", "robot urdf a base-pose 1 0 0 0 0 0 1 base-pose 1 0 0 0 0 0 1\n",
       ":1: expected `robot urdf FILE"},
      {"a base of a disc", "robot disc 1\nbase-pose 1 0 0 0 0 0 1\n", ":2: `base-pose` takes a `robot urdf`"},
      {"three numbers", "0 0 1 1\n1 2 3\n", ":2: expected `wall X1 Y1 X2 Y2` (found: 3 numbers)"},
      {"one number", "17", ":1: expected `wall X1 Y1 X2 Y2` (found: 1 number)"},
      {"five numbers", "1 2 3 4 5\n", ":1: expected `wall X1 Y1 X2 Y2` (found: 5 numbers)"},
      {"wall without numbers", "wall\n", ":1: expected `wall X1 Y1 X2 Y2` (found: 0 numbers)"},
      {"nan", "0 0 nan 1\n", ":1: numbers must be finite (found: nan)"},
      {"infinity", "0 0 1 1\n0 0 -inf 1\n", ":2: numbers must be finite (found: -inf)"},
      {"1e308", "0 0 1 1e308\n", ":1: numbers must not exceed 1e60 in magnitude (found: 1e308)"},
      {"1e999", "0 0 1 -1e999\n", ":1: numbers must not exceed 1e60 in magnitude (found: -1e999)"},
      {"1e61", "wall 0 1e61 1 1\n", ":1: numbers must not exceed 1e60 in magnitude (found: 1e61)"},
      {"long integer", "0 0 1 1" + std::string(400, '0') + "\n", ":1: numbers must not exceed 1e60"},
      {"word among numbers", "0 0 one 1\n", ":1: expected a number (found: one)"},
      {"digits then letters", "0 0 1m 1\n", ":1: expected a number (found: 1m)"},
      {"comma as decimal point", "0;5 0 1 1\n", ":1: expected a number (found: 0;5)"},
      {"hexadecimal", "0x10 0 1 1\n", ":1: expected a number (found: 0x10)"},
      {"two signs", "+-1 0 1 1\n", ":1: expected a number (found: +-1)"},
      {"lone minus", "- 0 1 1\n", ":1: expected a number (found: -)"},
      {"unknown item", "0 0 1 1\nwals 0 0 1 1\n", ":2: unknown item; did you mean `wall`? (found: wals)"},
      {"capitals", "POLYGON ((0 0))\n", ":1: unknown item; expected four numbers or one of wall, polygon"},
      {"far word", "obstruction 1 2\n", ":1: unknown item; expected four numbers or one of wall"},
      {"JSON", "{\"walls\": []}\n", ":1: unknown item"},
      {"two corners", "polygon 0 0 1 1\n", ":1: expected `polygon X Y X Y X Y ...` (found: 4 numbers)"},
      {"odd corners", "polygon 0 0 1 1 2 0 3\n", ":1: expected `polygon X Y X Y X Y ...` (found: 7 numbers)"},
      {"sphere without radius", "sphere 0 0 0\n", ":1: expected `sphere X Y Z R` (found: 3 numbers)"},
      {"negative radius", "sphere 0 0 0 -1\n", ":1: `sphere`: the radius must be at least 0 (found: -1)"},
      {"bounds inverted", "bounds 5 0 1 9\n", ":1: `bounds`: XMIN must be less than XMAX = 1 (found: 5)"},
      {"bounds empty", "bounds 0 3 1 3\n", ":1: `bounds`: YMIN must be less than YMAX = 3 (found: 3)"},
      {"bounds short", "bounds 0 3 1\n", ":1: expected `bounds XMIN YMIN XMAX YMAX` (found: 3 numbers)"},
      {"clearance negative", "clearance -0.1\n0 0 1 1\n", ":1: `clearance`: R must be at least 0 (found: -0.1)"},
      {"clearance missing", "clearance\n0 0 1 1\n", ":1: expected `clearance R` (found: 0 numbers)"},
      {"maze of no rows", "maze 0 5\n", ":1: `maze`: ROWS must be a whole number, at least 1"},
      {"maze of negative columns", "maze 5 -5\n", ":1: `maze`: COLS must be a whole number, at least 1"},
      {"maze of half a row", "maze 2.5 5\n", ":1: `maze`: ROWS must be a whole number"},
      {"huge maze", "maze 65536 65536\n", ":1: `maze`: ROWS x COLS must be below 2^32 (found: 65536x65536)"},
      {"huge side", "maze 1e20 1\n", ":1: `maze`: ROWS must be a whole number, at least 1 and below 2^32"},
      {"wall off the grid", "maze 2 2\n# so\n1.5 0.5 1.5 1.5\nwall 1 0.5 1 1.5\n",
       ":4: this wall is not on the unit grid of the 2x2 maze of line 1 (found: wall 1 0.5 1 1.5)"},
      {"wall outside the maze", "1.5 0.5 1.5 1.5\n2.5 0.5 2.5 3.5\nmaze 2 2\n",
       ":2: this wall is not on the unit grid of the 2x2 maze of line 3"},
      {"oblique wall in a maze", "maze 2 2\n0.5 0.5 1.5 1.5\n", ":2: this wall is not on the unit grid"},
      {"unknown robot", "robot cube 1\n", ":1: expected `robot point|disc R|polygon"},
      {"no robot", "robot\n", ":1: expected `robot point|disc R|polygon X Y X Y X Y ...|car radius R turning RHO|"},
      {"point with a size", "robot point 1\n0 0 1 1\n", ":1: expected `robot point|"},
      {"disc negative", "robot disc -1\n0 0 1 1\n", ":1: `robot`: R must be at least 0 (found: -1)"},
      {"disc without radius", "robot disc\n0 0 1 1\n", ":1: expected `robot point|"},
      {"car without turning", "robot car radius 1\n", ":1: expected `robot car radius R|polygon"},
      {"car with two bodies", "robot car radius 1 polygon 0 0 1 0 0 1 turning 1\n",
       ":1: expected `robot car radius R|polygon"},
      {"car of two corners", "robot car polygon 0 0 1 0 turning 1\n", ":1: expected `robot car radius R|polygon"},
      {"car with half a corner", "robot car polygon 0 0 1 0 0 turning 1\n", ":1: expected `robot car radius R|polygon"},
      {"car that steers otherwise", "robot car radius 1 turning 1 steering ackermann\n",
       ":1: expected `robot car radius R|polygon"},
      {"car without a steering", "robot car radius 1 turning 1 steering\n", ":1: expected `robot car radius R|polygon"},
      {"car turning on the spot", "robot car radius 1 turning 0\n", ":1: `robot`: turning must be greater than 0"},
      {"car with two radii", "robot car radius 1 radius 1 turning 1\n", ":1: expected `robot car radius R|polygon"},
      {"car radius missing", "robot car radius turning 1\n", ":1: expected a number (found: turning)"},
      {"car radius ends", "robot car turning 1 radius\n", ":1: a number is missing"},
      {"puma with turning", "robot puma560 radius 1 turning 1\n", ":1: expected `robot point|"},
      {"puma with unknown limits", "robot puma560 radius 1 limits wide\n", ":1: expected `robot point|"},
      {"puma with limits twice", "robot puma560 radius 1 limits classic limits classic\n",
       ":1: expected `robot point|"},
      {"arm without a file", "robot arm\n", ":1: expected `robot point|"},
      {"arm with limits", "robot arm a.dh radius 1 limits classic\n", ":1: expected `robot point|"},
      {"box of five numbers", "box 0 0 0 1 1\n", ":1: expected `box X1 Y1 Z1 X2 Y2 Z2` (found: 5 numbers)"},
      {"obox of no turn", "obox 0 0 0 0 0 0 0 1 1 1\n", ":1: `obox`: the quaternion QX QY QZ QW must not be 0 0 0 0"},
      {"obox of a negative side", "obox 0 0 0 0 0 0 1 1 -1 1\n", ":1: `obox`: half the sides HX HY HZ must be"},
      {"cylinder of six numbers", "cylinder 0 0 0 1 1 1\n",
       ":1: expected `cylinder X1 Y1 Z1 X2 Y2 Z2 R` (found: 6 numbers)"},
      {"cylinder without length", "cylinder 1 1 1 1 1 1 1\n", ":1: `cylinder`: the two ends must differ"},
      {"capsule of a negative radius", "capsule 0 0 0 1 1 1 -1\n", ":1: `capsule`: the radius must be at least 0"},
      {"hull of half a point", "hull 0 0 0 1 1\n", ":1: expected `hull X Y Z X Y Z ...` (found: 5 numbers)"},
      {"hull of nothing", "hull\n", ":1: expected `hull X Y Z X Y Z ...` (found: 0 numbers)"},
      {"attach to a disc", "0 0 1 1\nattach a sphere 0 0 0 1\nrobot disc 1\n", ":2: `attach` takes a `robot urdf`"},
      {"attach of no solid", "attach a ball 0 0 0 1\n", ":1: expected `attach LINK [MAY_TOUCH ...] sphere|"},
      {"attach as nothing", "attach a sphere 0 0 0 1 as\n", ":1: expected `attach LINK [MAY_TOUCH ...] sphere|"},
      {"a solid of the world as something", "hull 0 0 0 as a\n", ":1: expected a number (found: as)"},
      {"attach of a short box", "attach a box 0 0 0 1\n", ":1: expected `box X1 Y1 Z1 X2 Y2 Z2` (found: 4 numbers)"},
      {"hold of no value", "hold a\n", ":1: expected `hold JOINT VALUE` (found: 0 numbers)"},
      {"hold twice", "hold a 1\nhold a 2\n", ":2: `hold`: this joint is held already (found: a)"},
      {"allow of one link", "allow a\n", ":1: expected `allow LINK LINK` (found: too few words)"},
      {"allow of three links", "allow a b c\n", ":1: expected `allow LINK LINK` (found: c)"},
      {"goal pose of six numbers", "goal pose 0 0 0 0 0 1\n", ":1: expected `goal X Y"},
      {"goal pose of no turn", "goal pose 0 0 0 0 0 0 0\n", ":1: `goal pose`: the quaternion"},
      {"goal of names for a puma", "robot puma560 radius 1\ngoal joints a 1\n", ":2: names of joints and poses of"},
      {"a joint twice", "start joints a 1 a 2\n", ":1: this joint stands here twice (found: a)"},
      {"goals of two ways", "goal joints a 1\ngoal 1 2\n", ":2: goals are several where all are `goal joints"},
      {"start of fifteen numbers", "start 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n", ":1: expected `start X Y [THETA]"},
      {"robot outline of two corners", "robot polygon 0 0 1 1\n", ":1: expected `robot point|"},
      {"two starts", "0 0 1 1\nstart 1 1\nstart 1 2\n", ":3: a second `start` line; the first is line 2"},
      {"two bounds", "bounds 0 0 1 1\n\nbounds 0 0 1 1\n", ":3: a second `bounds` line; the first is line 1"},
      {"two robots", "robot point\nrobot point\n0 0 1 1\n", ":2: a second `robot` line; the first is line 1"},
      {"start of four numbers", "0 0 1 1\nstart 1 2 3 4\n", ":2: expected `start X Y [THETA] or six joint angles`"},
      {"goal of one number", "0 0 1 1\ngoal 1\n",
       ":2: expected `goal X Y [THETA] or six joint angles` (found: 1 number)"},
      {"start that turns for a point", "robot point\n0 0 1 1\nstart 1 2 3\n",
       ":3: `start` must be 2 numbers for the robot of line 1 (found: 3 numbers)"},
      {"start without heading for a car", "start 1 2\n0 0 1 1\nrobot car radius 1 turning 1\n",
       ":1: `start` must be 3 numbers for the robot of line 3 (found: 2 numbers)"},

      {"second of three goals that turns for a disc", "robot disc 1\ngoal 1 2\ngoal 1 2 3\ngoal 4 4\n",
       ":3: `goal` must be 2 numbers for the robot of line 1 (found: 3 numbers)"},
      {"planar goal for an arm", "robot puma560 radius 1\nsphere 0 0 0 1\ngoal 1 2\n",
       ":3: `goal` must be 6 numbers for the robot of line 1 (found: 2 numbers)"},
      {"grid of no cell", "grid 0 4\n0 0 1 1\n", ":1: `grid`: CELL must be greater than 0 (found: 0)"},
      {"grid of no angle", "grid 1 0\n0 0 1 1\n", ":1: `grid`: ANGLES must be a whole number, at least 1"},
      {"grid of half an angle", "grid 1 0.5\n0 0 1 1\n", ":1: `grid`: ANGLES must be a whole number, at least 1"},
      {"binary", nul, ":2: this is not a text file (found: \\x00\\x00\\x01 binary)"},
      {"UTF-16",
       std::string("\xff\xfe"
                   "0\0 \0",
                   6),
       ":1: expected UTF-8 text, not UTF-16 (found: \\xff\\xfe)"},
      {"huge word", "0 0 1 " + std::string(10'000'000, 'x') + "\n",
       ":1: expected a number (found: xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...)"},
      {"huge line",
       [] {
         std::string line;
         for (int i = 0; i < 200'000; ++i) line += "1 2 3 ";
         return line;
       }(),
       ":1: expected `wall X1 Y1 X2 Y2` (found: 600000 numbers)"},
  };
  const TemporaryDirectory directory;
  for (const BadScene& bad : cases) {
    SCOPED_TRACE(bad.name);
    const std::string said = test::refusal<InputError>([&] { read(directory, bad.content); });
    const std::string expected = directory.file("a.scene") + bad.expected;
    EXPECT_EQ(said.substr(0, expected.size()), expected);
    EXPECT_EQ(said.find('\n'), std::string::npos);
    EXPECT_LT(said.size(), directory.path().size() + 300);
  }
}

TEST(SceneText, AnyHeadingIsAGoalForATurningBody) {
  const TemporaryDirectory directory;
  const Scene scene = read(directory, "robot polygon 0 0 1 0 0 1\nstart 0 0 1\ngoal 1 1\nbounds -9 -9 9 9\n");
  EXPECT_EQ(scene.goal.size(), 2U);
}

void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(scene_hash(a), scene_hash(b));
  ASSERT_EQ(a.walls.size(), b.walls.size());
  EXPECT_EQ(a.walls.holds_floats(), b.walls.holds_floats());
  for (std::size_t i = 0; i < a.walls.size(); ++i) ASSERT_EQ(a.walls.segment(i), b.walls.segment(i)) << i;
  EXPECT_EQ(a.maze, b.maze);
  EXPECT_EQ(a.clearance, b.clearance);
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.goal, b.goal);
  EXPECT_EQ(a.bounds.has_value(), b.bounds.has_value());
  ASSERT_EQ(a.robot.has_value(), b.robot.has_value());
  if (a.robot) {
    EXPECT_EQ(a.robot->kind, b.robot->kind);
    EXPECT_EQ(a.robot->radius, b.robot->radius);
    EXPECT_EQ(a.robot->turning_radius, b.robot->turning_radius);
    EXPECT_EQ(a.robot->steering, b.robot->steering);
    EXPECT_EQ(a.robot->tool, b.robot->tool);
    EXPECT_EQ(a.robot->outline, b.robot->outline);
    EXPECT_EQ(a.robot->limits, b.robot->limits);
    EXPECT_EQ(a.robot->table, b.robot->table);
    EXPECT_EQ(a.robot->self_collision, b.robot->self_collision);
  }
  ASSERT_EQ(a.grid.has_value(), b.grid.has_value());
  if (a.grid) {
    EXPECT_EQ(a.grid->cell, b.grid->cell);
    EXPECT_EQ(a.grid->angles, b.grid->angles);
  }
}

TEST(SceneText, WhatIsWrittenReadsBackTheSame) {
  const TemporaryDirectory directory;
  const RobotSpec robots[] = {
      {RobotKind::point, 0, 0, 0, {}},
      {RobotKind::disc, 0.1, 0, 0, {}},
      {RobotKind::polygon, 0, 0, 0, {{-0.1, 0}, {1. / 3, 0}, {0, 1}}},
      {RobotKind::car, 0.5, 1.7, 0, {}},
      {RobotKind::car, 0, 1. / 3, 0, {{-0.1, 0}, {1. / 3, 0}, {0, 1}}, SteeringKind::reeds_shepp},
      {RobotKind::puma560, 0.05, 0, 0.123, {}},
      {RobotKind::puma560, 0.05, 0, 0, {}, SteeringKind::dubins, "symmetric", {}, true},
      {RobotKind::arm, 0.05, 0, 0, {}, SteeringKind::dubins, {}, "a/b.dh", false},
      {RobotKind::urdf, 0, 0, 0, {}, SteeringKind::dubins, {}, {}, false, ArmFiles{"a.urdf", "", "", "x", "y"}}};
  for (const std::uint64_t seed : test::seeds(20, 9, 0)) {  // each of the robots
    SCOPED_TRACE(seed);
    SequentialRng rng(seed);
    const auto number = [&] {
      const double scale = std::pow(10.0, static_cast<double>(rng.below(40)) - 20.0);
      return (static_cast<double>(rng.below(2'000'001)) - 1e6) / 3.0 * scale;
    };
    Scene scene;
    std::vector<Segment> walls(1 + rng.below(20'000));  // up to three chunks
    for (Segment& s : walls) s = {{number(), number()}, {number(), number()}};
    walls.front() = {{0.0, -0.0}, {8388607.5, -1.0}};
    scene.walls = WallSet::narrowest(walls);
    scene.polygons.push_back({{{number(), number()}, {number(), number()}, {number(), number()}}, 0});
    scene.spheres.push_back({number(), number(), number(), std::abs(number())});
    SolidBox box{{number(), number(), number()}, {}};
    for (std::size_t axis = 0; axis < 3; ++axis) box.high[axis] = box.low[axis] + std::abs(number());
    scene.boxes.push_back(box);
    scene.bounds = Box{{-std::abs(number()), -1}, {1e20, 1. / 3}};
    scene.clearance = std::abs(number());
    scene.robot = robots[seed % std::size(robots)];
    scene.start.assign(state_size(*scene.robot), number());
    scene.goal.assign(state_size(*scene.robot), number());
    scene.grid = GridSpec{0.1, 72};
    write_scene_text(scene, directory.file("b.scene"), {.threads = static_cast<unsigned>(1 + seed % 3)});
    expect_same(scene, read_scene_text(InputFile(directory.file("b.scene"), {}), {}));
  }
}

TEST(SceneText, MazesReadBackWithHintStartAndGoal) {
  const TemporaryDirectory directory;
  for (const bool merged : {false, true}) {
    const Scene maze = maze_scene({130, 170, 5, MazeAlgorithm::kruskal, 0.1}, merged, {});
    write_scene_text(maze, directory.file("m.walls"), {});
    expect_same(maze, read_scene_text(InputFile(directory.file("m.walls"), {}), {}));
  }
  const Scene small = maze_scene({1, 2, 1}, false, {});
  write_scene_text(small, directory.file("s.walls"), {});
  EXPECT_EQ(directory.read("s.walls"),
            "maze 1 2\nstart 0.5 1\ngoal 2.5 1\n0.5 0.5 2.5 0.5\n0.5 1.5 2.5 1.5\n0.5 1.5 0.5 1.5\n2.5 0.5 2.5 0.5\n");
}

TEST(SceneText, ReadingAndWritingStopAtTheDeadline) {
  const TemporaryDirectory directory;
  const Scene maze = maze_scene({100, 100}, false, {});
  write_scene_text(maze, directory.file("m.walls"), {});
  const Deadline over(0.0);
  const InputFile file(directory.file("m.walls"), {});
  EXPECT_THROW(read_scene_text(file, {.deadline = &over}), Stopped);
  EXPECT_THROW(write_scene_text(maze, directory.file("n.walls"), {.deadline = &over}), Stopped);
  EXPECT_EQ(directory.entries(), 1U);
  const InputFile line(directory.write(
                           "line.scene", "polygon" +
                                             [] {
                                               std::string numbers;
                                               for (int i = 0; i < 100'000; ++i) numbers += " 1";
                                               return numbers;
                                             }()),
                       {});
  EXPECT_THROW(read_scene_text(line, {.deadline = &over}), Stopped);
}

}  // namespace
}  // namespace warren
