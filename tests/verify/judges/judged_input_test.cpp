// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/leg_reports.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/base/error.hpp"
#include "tests/refusals.hpp"
#include "verify/judges/verify_arm.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/judges/verify_turning.hpp"
#include "worlds/arms/serial_chain.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

struct Judge {
  const char* name;
  std::function<Verification(const Scene&)> judge;
};

/// A point, a polygon and cars at (1.5, 1.5).
std::vector<Judge> plane_judges() {
  const std::vector<Vec2> outline = {{-0.1, -0.1}, {0.1, -0.1}, {0, 0.1}};
  const std::vector<Se2> pose = {{1.5, 1.5, 0.0}};
  return {
      {"point",
       [](const Scene& s) {
         return verify_path(s, std::vector<Vec2>{{1.5, 1.5}}, {}, {});
       }},
      {"polygon", [=](const Scene& s) { return verify_se2(s, outline, pose, {}, {}); }},
      {"car", [=](const Scene& s) { return verify_car(s, {.turning_radius = 1.0, .outline = outline}, pose, {}, {}); }},
      {"disc car",
       [=](const Scene& s) { return verify_car(s, {.radius = 0.1, .turning_radius = 1.0}, pose, {}, {}); }}};
}

Verification judged_arm(const Scene& scene) {
  return verify_arm(scene, model_of(puma560_table(), 0.05, false), std::vector<JointState>{JointState{}}, {}, {});
}

void give_walls(Scene& scene) {
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{0, 0}, {3, 0}}, {{0, 3}, {3, 3}}});
}
void give_polygon(Scene& scene) { scene.polygons.push_back({{{0, 0}, {3, 0}, {3, 3}, {0, 3}}}); }
void give_bounds(Scene& scene) { scene.bounds = Box{{0, 0}, {3, 3}}; }
void give_map(Scene& scene) {
  OccupancyMap map;
  map.blocked = Bitmap(3, 3);
  map.blocked.set(0, 2);
  map.yaw_rad = 0.1;
  scene.map = map;
}
void give_sphere(Scene& scene) { scene.spheres.push_back({10, 10, 10, 1}); }
void give_solid(Scene& scene) { scene.solids.emplace_back(); }
void give_box(Scene& scene) { scene.boxes.push_back({{10, 10, 10}, {11, 11, 11}}); }

struct Refused {
  const char* part;
  std::vector<void (*)(Scene&)> given;
};

void expect_refusal(const Judge& judge, const Refused& refused) {
  SCOPED_TRACE(std::string(judge.name) + ": " + refused.part);
  Scene scene;
  for (const auto give : refused.given) give(scene);
  const std::string said = test::refusal<InputError>([&] { judge.judge(scene); });
  EXPECT_NE(said.find(refused.part), std::string::npos) << said;
}

TEST(JudgedInput, JudgesOfThePlaneRefuseWhatTheyDoNotLookAt) {
  const Refused all[] = {{"spheres", {give_walls, give_sphere}},
                         {"boxes", {give_bounds, give_box}},
                         {"boxes", {give_box}},
                         {"solids", {give_bounds, give_solid}},
                         {"spheres", {give_sphere, give_map}},
                         {"polygons", {give_map, give_polygon}},
                         {"bounds", {give_map, give_bounds}},
                         {"nothing confines", {}},
                         {"wall 0", {give_map, give_walls}}};
  for (const Judge& judge : plane_judges()) {
    for (const Refused& refused : all) expect_refusal(judge, refused);
  }
}

TEST(JudgedInput, TheJudgeOfArmsRefusesWhatHasNoHeight) {
  const Judge arm{"arm", judged_arm};
  const Refused all[] = {{"walls", {give_walls}},
                         {"polygons", {give_box, give_polygon}},
                         {"bounds", {give_bounds}},
                         {"map", {give_sphere, give_map}}};
  for (const Refused& refused : all) expect_refusal(arm, refused);
  EXPECT_TRUE(judged_arm({}).verified);  // free space is a world of arms
  Scene solids;
  give_sphere(solids);
  give_box(solids);
  EXPECT_TRUE(judged_arm(solids).verified);
}

TEST(JudgedInput, EveryPartThatIsLookedAtIsJudgedByEveryJudge) {
  for (const Judge& judge : plane_judges()) {
    SCOPED_TRACE(judge.name);
    for (const auto give : {give_walls, give_bounds, give_map}) {
      Scene scene;
      give(scene);
      EXPECT_TRUE(judge.judge(scene).verified);
    }
    Scene scene;
    give_polygon(scene);
    EXPECT_FALSE(judge.judge(scene).verified);
    give_bounds(scene);
    EXPECT_FALSE(judge.judge(scene).verified);
  }
}

TEST(JudgedInput, TheWallsThatAMapGetsForPlannersAreItsOwn) {
  Scene scene;
  give_map(scene);
  add_map_walls(scene, {});
  ASSERT_GT(scene.walls.size(), 0U);
  for (const Judge& judge : plane_judges()) EXPECT_TRUE(judge.judge(scene).verified) << judge.name;
}

}  // namespace
}  // namespace warren
