// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "pictures/formats/surface.hpp"
#include "tests/tools/process.hpp"

namespace warren {
namespace {

using std::numbers::pi;

TEST(SvgAnimation, TimeGoesOnWhereTheBodyTurnsOnTheSpot) {
  const MovingBody bar{.outline = {{-2, -0.1}, {2, -0.1}, {2, 0.1}, {-2, 0.1}},
                       .poses = {{0, 0, 0}, {4, 0, 0}, {4, 0, pi / 2}, {4, 2, pi / 2}},
                       .lengths = {0, 4, 0, 2}};
  const Timetable table = timetable_of(bar);
  EXPECT_EQ(table.shares, (std::vector<double>{0.0, 4.0 / 6, 4.0 / 6, 1.0}));
  const double turning = std::hypot(2.0, 0.1) * pi / 2;
  ASSERT_EQ(table.moments.size(), 4U);
  EXPECT_EQ(table.moments[0], 0.0);
  EXPECT_NEAR(table.moments[1], 4.0 / (6.0 + turning), 1e-12);
  EXPECT_NEAR(table.moments[2], (4.0 + turning) / (6.0 + turning), 1e-12);
  EXPECT_EQ(table.moments[3], 1.0);
}

TEST(SvgAnimation, HeadingsRunOnWithoutJumps) {
  MovingBody car{.radius = 0.5, .heads = true};
  for (int i = 0; i <= 8; ++i) {
    car.poses.push_back({0, 0, wrapped_angle(i * pi / 2)});  // two full turns
    car.lengths.push_back(i == 0 ? 0.0 : 1.0);
  }
  const std::string text = svg_moving_body(car, 2.0, 0.1);
  EXPECT_NE(text.find("values=\"0.000;90.000;180.000;270.000;360.000;450.000;540.000;630.000;720.000\""),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("<mpath href=\"#way\"/>"), std::string::npos);
  EXPECT_NE(text.find("<circle r=\"1.000\""), std::string::npos);
  EXPECT_NE(text.find("keyTimes=\"0.000000;0.125000;"), std::string::npos);
}

TEST(SvgAnimation, WhatStandsStillIsNotAnimated) {
  const MovingBody still{.radius = 1.0, .poses = {{1, 1, 0}}, .lengths = {0.0}};
  EXPECT_EQ(svg_moving_body(still, 1.0, 0.1), "");
}

}  // namespace

namespace test {
namespace {

TEST(RenderAnimate, WritesAMovingBodyForPointsPolygonsAndCars) {
  const Folder folder;
  const char* scenes[] = {
      "0 0 0 1\nrobot point\nstart 1 0\ngoal 4 0\nbounds 0 -3 5 3\n",
      "bounds 0 -3 8 3\n4 0 4 3\nrobot polygon -1 -0.1 1 -0.1 1 0.1 -1 0.1\nstart 2 0 0\ngoal 6 1 1\n",
      "bounds 0 -3 8 3\n4 0 4 3\nrobot car radius 0.3 turning 0.7\nstart 2 0 0\ngoal 6 1 1\n"};
  for (const char* scene : scenes) {
    SCOPED_TRACE(scene);
    const std::string file = folder.write("moving.scene", scene);
    ASSERT_EQ(run({"solve", file, "--json", folder.path("answer.json"), "--quiet"}).code, 0);
    const Outcome drawn =
        run({"render", file, "--answer", folder.path("answer.json"), "--animate", "-o", folder.path("moving.svg")});
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    const std::string text = folder.read("moving.svg");
    EXPECT_NE(text.find("<animateMotion "), std::string::npos);
    EXPECT_NE(text.find("<animateTransform "), std::string::npos);
    EXPECT_NE(text.find("<path id=\"way\""), std::string::npos);
    EXPECT_EQ(text.find("script"), std::string::npos);
  }
}

TEST(RenderAnimate, NeedsAnAnswerAndAPictureThatMoves) {
  const Folder folder;
  const std::string file = folder.write("a.scene", "0 0 1 1\n");
  const Outcome alone = run({"render", file, "--animate", "-o", folder.path("a.svg")});
  EXPECT_EQ(alone.code, 2);
  EXPECT_NE(alone.err.find("--answer"), std::string::npos) << alone.err;
  folder.write("answer.json", "{\"path\": [[0, 2], [1, 2]]}");
  const Outcome still =
      run({"render", file, "--answer", folder.path("answer.json"), "--animate", "-o", folder.path("a.png")});
  EXPECT_EQ(still.code, 2);
  EXPECT_NE(still.err.find(".png"), std::string::npos) << still.err;
}

}  // namespace
}  // namespace test
TEST(SvgAnimation, AnArmIsALineInEachViewWithAMomentASpine) {
  MovingArm arm{.radius = 0.1, .views = {{{0, 2}, {0, 0}}, {{0, 1}, {5, 0}}}, .moments = {0.0}};
  const auto tenfold = [](Vec2 p) { return 10.0 * p; };
  EXPECT_EQ(svg_moving_arm(arm, 1.0, tenfold), "") << "it stands still";
  arm.moments = {0.0, 0.5, 1.0};
  arm.spines = {{{0, 0, 0}, {1, 2, 3}}, {{0, 0, 0}, {2, 2, 2}}, {{0, 0, 0}, {3, 2, 1}}};
  const std::string text = svg_moving_arm(arm, 0.2, tenfold);
  EXPECT_NE(text.find("keyTimes=\"0.000000;0.500000;1.000000\" values=\"0.000,0.000 10.000,30.000;0.000,0.000 "
                      "20.000,20.000;0.000,0.000 30.000,10.000\""),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("points=\"50.000,0.000 60.000,20.000\""), std::string::npos) << "the second view";
}

}  // namespace warren
