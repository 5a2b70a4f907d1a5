// SPDX-License-Identifier: BSD-3-Clause
// An updated roadmap is the one that a build on the changed world makes, bit for bit.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "scenes/files/read_world_io.hpp"
#include "solve/kept/roadmap.hpp"
#include "solve/kinds/sampled_roadmap.hpp"
#include "tests/paths.hpp"

namespace warren {
namespace {

bool same_bits(const Roadmap& a, const Roadmap& b) {
  const RoadmapParts x = a.arrays.parts();
  const RoadmapParts y = b.arrays.parts();
  const auto equal = [](auto left, auto right) {
    return std::equal(left.begin(), left.end(), right.begin(), right.end());
  };
  return equal(x.states, y.states) && equal(x.first, y.first) && equal(x.to, y.to) &&
         equal(x.edge_states, y.edge_states) && equal(x.component, y.component) && a.world_hash == b.world_hash;
}

/// Takes some walls away and puts others in.
Scene changed(const Scene& scene, std::mt19937& random, std::size_t changes) {
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) walls.push_back(scene.walls.segment(i));
  const Box box = scene.bounds.value_or(obstacle_box(scene));
  const auto anywhere = [&] {
    const double x = static_cast<double>(random() % 1000) / 1000.0;
    const double y = static_cast<double>(random() % 1000) / 1000.0;
    return Vec2{box.min.x + x * box.width(), box.min.y + y * box.height()};
  };
  for (std::size_t i = 0; i < changes; ++i) {
    if (random() % 2 == 0 && walls.size() > 4) {
      walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(random() % walls.size()));
    } else {
      const Vec2 a = anywhere();
      walls.push_back({a, {a.x + 0.05 * box.width(), a.y + 0.02 * box.height()}});
    }
  }
  Scene next = scene;
  next.walls = WallSet::narrowest(walls);
  next.source = "changed";
  return next;
}

struct World {
  std::string name;
  std::string source;
  RobotSpec robot;
  std::uint64_t samples;
  bool bounded = false;
};

TEST(Update, IsTheRoadmapOfTheChangedWorld) {
  const std::string worlds = test::source_dir() + "/examples/worlds/";
  const RobotSpec turning{.kind = RobotKind::polygon, .outline = {{-0.2, -0.1}, {0.3, -0.1}, {0.3, 0.1}}};
  const RobotSpec car{.kind = RobotKind::car, .radius = 0.1, .turning_radius = 0.5};
  std::mt19937 random(7);
  std::size_t taken_over = 0;
  for (const World& world :
       {World{"walls", "maze:7x9,seed=2", {}, 900}, World{"turning", "maze:7x9,seed=3", turning, 300},
        World{"car", "maze:7x9,seed=3", car, 200}, World{"polygons", worlds + "town.geojson", {}, 500}}) {
    Scene scene = read_world(world.source);
    if (!scene.bounds) scene.bounds = obstacle_box(scene);
    scene.maze.reset();
    for (std::size_t changes = 1; changes <= 6; ++changes) {
      SCOPED_TRACE(world.name + " " + std::to_string(changes));
      SolveOptions options{.seed = changes};
      options.roadmap.samples = world.samples;
      const Question question{.robot = world.robot, .clearance = 0.05};
      const Roadmap roadmap = build(scene, question, options);
      const Scene next = changed(scene, random, changes);
      UpdateAccount account;
      const Roadmap updated = update(roadmap, next, {}, &account);
      const Roadmap built = build(next, question, options);
      EXPECT_TRUE(same_bits(updated, built));
      EXPECT_FALSE(account.built_anew);
      EXPECT_LT(account.edges_checked, account.edges);
      taken_over += account.edges - account.edges_checked;
    }
  }
  EXPECT_GT(taken_over, 20'000U);
}

TEST(Update, OfAnArmsWorldIsTheRoadmapOfTheChangedOne) {
  Scene scene;
  scene.source = "shelf";
  scene.spheres.push_back({0.8, 0.4, 0.75, 0.3});
  const Question question{.robot = RobotSpec{.kind = RobotKind::puma560, .radius = 0.05}};
  SolveOptions options{.planner = PlannerKind::prm};
  options.roadmap.samples = 100;
  const Roadmap roadmap = build(scene, question, options);
  Scene next = scene;
  next.boxes.push_back({{-0.9, -0.2, 0.0}, {-0.5, 0.2, 0.6}});
  UpdateAccount account;
  EXPECT_TRUE(same_bits(update(roadmap, next, {}, &account), build(next, question, options)));
  EXPECT_TRUE(account.built_anew);
}

TEST(Update, BuildsAnewWhereTheFrameHasChanged) {
  const Scene scene = read_world("maze:7x9,seed=2");
  SolveOptions options;
  options.roadmap.samples = 300;
  const Roadmap roadmap = build(scene, {}, options);
  UpdateAccount account;
  const Scene larger = read_world("maze:8x9,seed=2");
  EXPECT_TRUE(same_bits(update(roadmap, larger, {}, &account), build(larger, {}, options)));
  EXPECT_TRUE(account.built_anew);
  EXPECT_EQ(account.edges_checked, account.edges);
}

TEST(Update, OfALatticeAsksAboutItsChange) {
  const Scene scene = read_world("maze:15x17,seed=2");
  const Roadmap roadmap = build(scene);
  Scene next = scene;
  std::vector<Segment> walls;
  for (std::size_t i = 0; i + 1 < scene.walls.size(); ++i) walls.push_back(scene.walls.segment(i));
  next.walls = WallSet::narrowest(walls);
  UpdateAccount account;
  EXPECT_TRUE(same_bits(update(roadmap, next, {}, &account), build(next)));
  EXPECT_FALSE(account.built_anew);
  EXPECT_GT(account.edges_checked, 0U);
  EXPECT_LT(account.edges_checked, 20U);
  EXPECT_EQ(account.states_added + account.states_dropped, 0U);
}

/// A turning body sweeps far less than the disc of its reach around the box of its way: 4,328 of 12,181 edges were
/// asked about where the first of these polygons moves.
TEST(Update, AsksOnlyAboutMotionsThatMayMeetTheChange) {
  const Scene scene = read_world(test::source_dir() + "/examples/worlds/poly-easy.scene");
  SolveOptions options;
  options.planner = PlannerKind::prm;
  options.roadmap.samples = 1500;
  const Roadmap roadmap = build(scene, {}, options);
  std::vector<std::uint64_t> checked;
  for (const std::size_t moved : {3U, 6U}) {
    Scene next = scene;
    for (Vec2& corner : next.polygons[moved].corners) corner = corner + Vec2{0.02, 0.02};
    UpdateAccount account;
    EXPECT_TRUE(same_bits(update(roadmap, next, {}, &account), build(next, {}, options)));
    EXPECT_FALSE(account.built_anew);
    checked.push_back(account.edges_checked);
  }
  EXPECT_LT(checked[0], 800U);
  EXPECT_LT(checked[1], 800U);
}

/// Far from the origin a planner keeps more room for rounding than 1e-6: the yard as wide as a fingernail, 1e9 away.
TEST(Update, OfASmallWorldFarAwayIsTheRoadmapOfTheChangedOneToo) {
  Scene scene = read_world(test::source_dir() + "/examples/worlds/poly-easy.scene");
  const auto placed = [](Vec2 p) { return Vec2{1e9, -1e9} + 0.0005 * p; };
  scene.bounds = Box{placed(scene.bounds->min), placed(scene.bounds->max)};
  for (ScenePolygon& polygon : scene.polygons) {
    Box box;  // along whose sides bodies may go
    for (const Vec2 corner : polygon.corners) box.include(corner);
    polygon.corners = {placed(box.min), placed({box.max.x, box.min.y}), placed(box.max),
                       placed({box.min.x, box.max.y})};
  }
  for (Vec2& corner : scene.robot->outline) corner = 0.0001 * corner;
  SolveOptions options;
  options.planner = PlannerKind::prm;
  options.roadmap.samples = 1500;
  const Roadmap roadmap = build(scene, {}, options);
  for (std::size_t moved = 0; moved < scene.polygons.size(); ++moved) {
    SCOPED_TRACE(moved);
    Scene next = scene;
    for (Vec2& corner : next.polygons[moved].corners) corner = corner + Vec2{0.000125, 0.000125};
    UpdateAccount account;
    EXPECT_TRUE(same_bits(update(roadmap, next, {}, &account), build(next, {}, options)));
    EXPECT_LT(account.edges_checked, account.edges);
  }
}

/// What planning keeps for rounding grows with the farthest obstacle: one so far away changes every answer.
TEST(Update, AsksAnewWhereTheChangeLiesFartherThanAllElse) {
  const Scene scene = read_world(test::source_dir() + "/examples/worlds/poly-easy.scene");
  SolveOptions options;
  options.planner = PlannerKind::prm;
  options.roadmap.samples = 200;
  Scene next = scene;
  next.polygons.push_back({{{1e9, 0.0}, {1e9 + 1.0, 0.0}, {1e9, 1.0}}});
  UpdateAccount account;
  EXPECT_TRUE(same_bits(update(build(scene, {}, options), next, {}, &account), build(next, {}, options)));
  EXPECT_EQ(account.edges_checked, account.edges);
}

TEST(Update, OfTheSameWorldAsksNothing) {
  const Scene scene = read_world("maze:7x9,seed=2");
  SolveOptions options;
  options.roadmap.samples = 300;
  const Roadmap roadmap = build(scene, {}, options);
  UpdateAccount account;
  EXPECT_TRUE(same_bits(update(roadmap, scene, {}, &account), roadmap));
  EXPECT_EQ(account.edges_checked, 0U);
  EXPECT_EQ(account.states_added + account.states_dropped, 0U);
}

TEST(Update, AnIndexedLatticeIsMadeAnewAndSaysSo) {
  const Roadmap roadmap = build(read_world("maze:256x256,seed=2"));
  ASSERT_NE(roadmap.lattice, nullptr);
  UpdateAccount account;
  const Roadmap larger = update(roadmap, read_world("maze:257x300,seed=2"), {}, &account);
  ASSERT_NE(larger.lattice, nullptr);
  EXPECT_TRUE(account.built_anew);
  EXPECT_EQ(account.edges_checked, account.edges);
  EXPECT_EQ(account.edges, 2U * 257 * 300 - 257 - 300);
  EXPECT_EQ(account.states_added, 257U * 300 - 256 * 256);
  EXPECT_EQ(account.states_dropped, 0U);
}

}  // namespace
}  // namespace warren
