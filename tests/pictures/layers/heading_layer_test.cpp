// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/draw_bodies.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/error.hpp"
#include "tests/refusals.hpp"

namespace warren {
namespace {

/// A bar 4 long and 1 wide in a room 8 wide and 8 high.
Scene room() {
  Scene scene;
  scene.bounds = Box{{0, 0}, {8, 8}};
  scene.robot = RobotSpec{.kind = RobotKind::polygon, .outline = {{-2, -0.5}, {2, -0.5}, {2, 0.5}, {-2, 0.5}}};
  return scene;
}

/// How long a way is free through the middle, across and up.
Vec2 free_ways(const HeadingCells& cells) {
  const std::uint32_t middle = cells.blocked.width() / 2;
  Vec2 free;
  for (std::uint32_t i = 0; i < cells.blocked.width(); ++i) {
    if (!cells.blocked.test(i, middle)) free.x += cells.cell;
    if (!cells.blocked.test(middle, i)) free.y += cells.cell;
  }
  return free;
}

TEST(HeadingLayer, ALyingBarHasLessRoomAcrossAStandingOneUp) {
  const Scene scene = room();
  const Vec2 lying = free_ways(heading_cells(scene, *scene.robot, 0.0, 0.0, {}));
  EXPECT_NEAR(lying.x, 4.0, 0.1);
  EXPECT_NEAR(lying.y, 7.0, 0.1);
  const Vec2 standing = free_ways(heading_cells(scene, *scene.robot, 0.0, 0.5 * std::numbers::pi, {}));
  EXPECT_NEAR(standing.x, 7.0, 0.1);
  EXPECT_NEAR(standing.y, 4.0, 0.1);
  const Vec2 aslant = free_ways(heading_cells(scene, *scene.robot, 0.0, 0.25 * std::numbers::pi, {}));
  EXPECT_NEAR(aslant.x, 8.0 - 5.0 / std::numbers::sqrt2, 0.1);
  EXPECT_NEAR(free_ways(heading_cells(scene, *scene.robot, 0.5, 0.0, {})).x, 3.0, 0.1) << "clearance";
}

TEST(HeadingLayer, ShowsPlacesOutsideOfTheBoundsForABodyBesideItsReferencePoint) {
  Scene scene = room();
  for (Vec2& p : scene.robot->outline) p.x += 3.0;
  const HeadingCells cells = heading_cells(scene, *scene.robot, 0.0, 0.0, {});
  EXPECT_LT(cells.origin.x, -1.0) << "where the bar's near end is 1 ahead";
  EXPECT_NEAR(free_ways(cells).x, 4.0, 0.1);
}

TEST(HeadingLayer, OnATurnedMapTheHeadingIsTheWorlds) {
  Scene scene;
  OccupancyMap map;
  map.blocked = Bitmap(80, 80);
  map.cell = 0.1;
  map.yaw_rad = 0.5 * std::numbers::pi;
  scene.map = map;
  const RobotSpec bar{.kind = RobotKind::polygon, .outline = {{-2, -0.5}, {2, -0.5}, {2, 0.5}, {-2, 0.5}}};
  const HeadingCells cells = heading_cells(scene, bar, 0.0, 0.5 * std::numbers::pi, {});
  EXPECT_NEAR(cells.heading_degrees, 0.0, 1e-9);
  EXPECT_NEAR(free_ways(cells).x, 4.0, 0.2) << "along the map's own x";
  EXPECT_NE(blocked_at_heading(cells, {}).label.find("90 degrees"), std::string::npos) << "as the world sees it";
}

TEST(HeadingLayer, BodiesWithoutAHeadingAreRefusedWithAReason) {
  const auto refusal = [](const RobotSpec& robot) {
    return test::refusal<UsageError>([&] { check_has_headings(robot); });
  };
  EXPECT_NE(refusal({.kind = RobotKind::disc, .radius = 1.0}).find("a point and a disc take the same room"),
            std::string::npos);
  EXPECT_NE(refusal({.kind = RobotKind::car, .radius = 1.0, .turning_radius = 1.0}).find("a round car"),
            std::string::npos);
  EXPECT_NE(refusal({.kind = RobotKind::puma560}).find("an arm has joints"), std::string::npos);
  EXPECT_EQ(refusal({.kind = RobotKind::car, .outline = room().robot->outline}), "");
}

TEST(HeadingLayer, StatesNearTheHeadingStandOut) {
  const double degree = std::numbers::pi / 180.0;
  const std::vector<Se2> states{{0, 0, 0}, {1, 0, 40 * degree}, {2, 0, 50 * degree}, {3, 0, (45 + 360) * degree}};
  const auto layers = state_arrows(states, 45 * degree);
  ASSERT_EQ(layers.size(), 2U);
  EXPECT_EQ(layers[0].lines.size(), 1U);
  EXPECT_EQ(layers[1].lines.size(), 3U);
  const auto many = state_arrows(std::vector<Se2>(9000, Se2{1, 1, 0}), 0.0);
  EXPECT_LE(many[1].lines.size(), 2000U);
  EXPECT_NE(many[1].label.find("of 9000)"), std::string::npos) << "what is left out is said";
  EXPECT_TRUE(state_arrows({}, 0.0).empty());
}

}  // namespace
}  // namespace warren
