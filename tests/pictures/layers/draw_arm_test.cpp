// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/draw_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/plane/polygon.hpp"
#include "scenes/scene/convex_hull.hpp"

namespace warren {
namespace {

/// Two branches on a joint without end: a box that turns, a cylinder that slides, and a hull that stands.
ArmModel forked_arm() {
  ArmModel model;
  model.variables = {{.name = "turn", .continuous = true, .low = -std::numbers::pi, .high = std::numbers::pi},
                     {.name = "slide", .slides = true, .low = 0.0, .high = 1.0}};
  model.joints = {{.name = "turn", .variable = 0},
                  {.name = "slide", .parent = 0, .slides = true, .variable = 1},
                  {.name = "other", .parent = 0, .variable = 0, .multiplier = 0.5}};
  model.joints[1].origin.translation() = Vec3(1, 0, 0);
  model.joints[2].origin.translation() = Vec3(0, 0, 2);
  const Solid box{.kind = SolidKind::box, .half = {0.5, 0.1, 0.2}};
  const Solid cylinder{.kind = SolidKind::cylinder, .half = {0.25, 0.0, 0.5}};
  const std::vector<Vec3> tetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  model.links = {{.name = "arm", .frame = 0, .solids = {box}},
                 {.name = "hand", .frame = 1, .solids = {cylinder}},
                 {.name = "foot", .frame = base_frame, .solids = {convex_hull(tetrahedron, "foot", {})}}};
  model.tool_frame = 1;
  return model;
}

double area_of(const PictureLayer& layer, std::size_t outline) {
  double twice = 0.0;
  Vec2 a = layer.lines[outline].back();
  for (const Vec2 b : layer.lines[outline]) {
    twice += a.x * b.y - a.y * b.x;
    a = b;
  }
  return 0.5 * twice;
}

TEST(DrawArm, LinksOfAnySolidAreOutlinesInEachView) {
  const std::vector<JointState> path{{0.0, 0.0}, {0.5, 1.0}};
  Scene scene;
  scene.solids = {Solid{.kind = SolidKind::box, .half = {1, 2, 3}}};
  const Picture views = arm_views(scene, forked_arm(), path, {});
  ASSERT_EQ(views.layers.size(), 4U);
  const PictureLayer& start = views.layers[1];
  ASSERT_EQ(start.lines.size(), 9U) << "three solids in three views";
  EXPECT_NEAR(area_of(start, 0), 1.0 * 0.4, 1e-12) << "the box from the front: x and z";
  EXPECT_NEAR(area_of(start, 1), 0.5 * 1.0, 1e-12) << "the cylinder";
  EXPECT_NEAR(area_of(start, 2), 0.5, 1e-12) << "the hull";
  EXPECT_NEAR(area_of(start, 3), 1.0 * 0.2, 1e-12) << "the box from above";
  EXPECT_NEAR(area_of(start, 4), std::numbers::pi * 0.0625, 0.003);
  ASSERT_EQ(views.stage->polygons.size(), 3U);
}

TEST(DrawArm, ARobotFarAwayIsSeenAsLarge) {
  const std::vector<JointState> path{{0.0, 0.0}, {0.5, 1.0}};
  const Vec3 there(1000.0, -500.0, 30.0);
  ArmModel moved = forked_arm();
  moved.base = there;
  moved.joints[0].origin.pretranslate(there);
  moved.links[2].solids[0].pose.pretranslate(there);
  const Picture near = arm_views(Scene{}, forked_arm(), path, {});
  const Picture far = arm_views(Scene{}, moved, path, {});
  ASSERT_EQ(far.panels.size(), near.panels.size());
  for (std::size_t i = 0; i < near.panels.size(); ++i) {
    EXPECT_NEAR(far.panels[i].box.width(), near.panels[i].box.width(), 1e-9) << i;
    EXPECT_NEAR(far.panels[i].box.height(), near.panels[i].box.height(), 1e-9) << i;
  }
}

TEST(DrawArm, FacesLookOutwards) {
  const std::vector<JointState> stands{{0.0, 0.0}};
  const Picture views = arm_views({}, forked_arm(), stands, {});
  double volume = 0.0;
  for (const SeenSolid& s : views.solids->solids) {
    ASSERT_TRUE(s.c);
    volume += s.a.dot(s.b.cross(*s.c)) / 6.0;
  }
  const double prism = 24 * 0.5 * std::sin(2.0 * std::numbers::pi / 24) * 0.0625;
  EXPECT_NEAR(volume, 1.0 * 0.2 * 0.4 + prism + 1.0 / 6.0, 1e-9);
}

TEST(DrawArm, MovesAsThePathDoes) {
  const std::vector<JointState> path{{3.0, 0.0}, {-3.0, 1.0}};
  const Picture views = arm_views({}, forked_arm(), path, {});
  ASSERT_EQ(views.arm->frames.size(), views.arm->moments.size());
  ASSERT_EQ(views.arm->frames.front().size(), 4U) << "the base's, too";
  ASSERT_EQ(views.arm->links.size(), 3U);
  for (const auto& frames : views.arm->frames) EXPECT_LT(frames[1](0, 0), -0.9) << "the shorter way, by pi";
  const Vec3 tool = views.arm->tools.back();
  EXPECT_TRUE(tool.isApprox(Vec3(std::cos(3.0), -std::sin(3.0), 1.0), 1e-12));
  EXPECT_EQ(views.arm->spines.front().size(), views.arm->spines.back().size());
}

}  // namespace
}  // namespace warren
