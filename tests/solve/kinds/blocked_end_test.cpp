// SPDX-License-Identifier: BSD-3-Clause
#include "solve/explain/blocked_end.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "scenes/files/read_world_io.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"
#include "tests/scenes/files/temporary_directory.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/test_scenes.hpp"

namespace warren {
namespace {

using test::scene_of;

Scene told_world(const std::string& name) { return read_world(test::source_dir() + "/examples/worlds/" + name); }

/// What is told of a blocked end; that the place it names is free, and as far as it says, is looked at.
BlockedEnd told(const Scene& scene, Question question) {
  const Answer answer = solve(scene, question);
  const bool is_start = answer.outcome == Outcome::start_blocked;
  EXPECT_TRUE(is_start || answer.outcome == Outcome::goal_blocked);
  if (!answer.blocked) {
    ADD_FAILURE() << "nothing is told";
    return {};
  }
  const BlockedEnd blocked = *answer.blocked;
  EXPECT_EQ(blocked.is_start, is_start);
  if (blocked.free_place.empty()) return blocked;
  std::vector<double>& end = is_start ? question.start : question.goal;
  const Question all = {.start = answer.problem.start, .goal = answer.problem.goal};
  const std::vector<double>& asked = is_start ? all.start : all.goal;
  double square = 0.0;
  for (std::size_t k = 0; k < blocked.free_place.size(); ++k) {
    square += k < asked.size() ? std::pow(blocked.free_place[k] - asked[k], 2) : 0.0;
  }
  EXPECT_NEAR(blocked.distance, std::sqrt(square), 1e-12);
  end = blocked.free_place;
  const Answer there = solve(scene, question);
  EXPECT_NE(there.outcome, is_start ? Outcome::start_blocked : Outcome::goal_blocked);
  return blocked;
}

TEST(BlockedEnd, NamesThePolygonAndTheNearestFreePlace) {
  const BlockedEnd blocked = told(told_world("town.geojson"), {.start = {3, 2.5}, .goal = {9.5, 8.5}});
  EXPECT_TRUE(blocked.by.starts_with("polygon 0")) << blocked.by;
  EXPECT_NEAR(blocked.distance, 0.5, 0.02);
}

TEST(BlockedEnd, NamesTheWallThatABodyStandsIn) {
  const BlockedEnd blocked = told(told_world("walls.scene"), {.start = {200, 50, 0}});
  EXPECT_TRUE(blocked.by.starts_with("wall 0")) << blocked.by;
  EXPECT_NEAR(blocked.distance, 25.0, 1.5);
  EXPECT_EQ(blocked.free_place.size(), 3U);
}

TEST(BlockedEnd, SaysWhatIsOutsideAndWhereTheInsideIs) {
  const BlockedEnd blocked = told(told_world("walls.scene"), {.goal = {500, 5000, 0}});
  EXPECT_TRUE(blocked.by.starts_with("outside of the bounds 0 0 800 300")) << blocked.by;
  EXPECT_FALSE(blocked.is_start);
  EXPECT_NEAR(blocked.distance, 4725.0, 30.0);
}

TEST(BlockedEnd, GuessesThatRowsAndColumnsWereSwapped) {
  EXPECT_NE(told(told_world("walls.scene"), {.start = {50, 700, 0}}).hint.find("700,50 is free"), std::string::npos);
  EXPECT_EQ(told(told_world("walls.scene"), {.start = {200, 50, 0}}).hint, "");
}

TEST(BlockedEnd, NamesTheCellOfAMap) {
  const Question question{
      .robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.2}, .start = {0.05, 0.5}, .goal = {4.3, 0.5}};
  const BlockedEnd blocked = told(told_world("flat.yaml"), question);
  EXPECT_TRUE(blocked.by.starts_with("cell ")) << blocked.by;
  EXPECT_NEAR(blocked.distance, 0.25, 0.06);
  EXPECT_NE(blocked.hint.find("the map has the cell free"), 0U);
  Question closed = question;
  closed.start = {0.6, 0.6};
  closed.prices.keep_out = {{{{0.5, 0.5}, {0.9, 0.5}, {0.9, 0.9}, {0.5, 0.9}}}};
  const BlockedEnd kept_out = told(told_world("flat.yaml"), closed);
  EXPECT_TRUE(kept_out.by.starts_with("cell ")) << kept_out.by;
  EXPECT_TRUE(kept_out.hint.starts_with("the map has the cell free")) << kept_out.hint;
}

void expect_near(const std::vector<double>& place, Vec2 middle, double reach) {
  ASSERT_EQ(place.size(), 2U);
  EXPECT_NEAR(place[0], middle.x, reach);
  EXPECT_NEAR(place[1], middle.y, reach);
}

/// A square room in what is solid else, from 0 to `side`.
Scene room_in_the_solid(Vec2 middle, double half, double side) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {side, side}};
  const Vec2 low{middle.x - half, middle.y - half};
  const Vec2 high{middle.x + half, middle.y + half};
  for (const Box& box : {Box{{0, 0}, {side, low.y}}, Box{{0, high.y}, {side, side}}, Box{{0, 0}, {low.x, side}},
                         Box{{high.x, 0}, {side, side}}}) {
    scene.polygons.push_back({{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}}});
  }
  return scene;
}

/// Three free cells by three of a map that is blocked else, a square room among walls: no direction need lead there.
TEST(BlockedEnd, OffersThePlaceInAPocketFarAway) {
  for (const std::uint64_t pocket : test::seeds(9, 1, 0)) {
    const auto x = static_cast<std::uint32_t>(3 + 12 * (pocket % 3));
    const auto y = static_cast<std::uint32_t>(3 + 12 * (pocket / 3));
    SCOPED_TRACE(testing::Message() << x << ' ' << y);
    Scene map;
    map.map.emplace().blocked = Bitmap(31, 31);
    for (std::uint32_t i = 0; i < 31U * 31U; ++i) {
      const bool is_free = i % 31 - x + 1 < 3 && i / 31 - y + 1 < 3;  // below 0 is far above 3
      if (!is_free) map.map->blocked.set(i % 31, i / 31);
    }
    const Question question{
        .robot = RobotSpec{.kind = RobotKind::disc, .radius = 1.2}, .start = {1.5, 29.5}, .goal = {29.5, 1.5}};
    expect_near(told(map, question).free_place, {x + 0.5, y + 0.5}, 0.3);
    expect_near(told(room_in_the_solid({x + 0.5, y + 0.5}, 1.5, 31), question).free_place, {x + 0.5, y + 0.5}, 0.3);
  }
}

TEST(BlockedEnd, OffersTheMiddleOfARoomThatIsHardlyWiderThanTheBody) {
  const Question question{
      .robot = RobotSpec{.kind = RobotKind::disc, .radius = 5.0}, .start = {600, 20}, .goal = {20, 600}};
  expect_near(told(room_in_the_solid({100, 200}, 5.05, 640), question).free_place, {100, 200}, 0.05);
}

TEST(BlockedEnd, OffersTheOnlyPocketOfALargeMap) {
  Scene map;
  map.map.emplace().blocked = Bitmap(1000, 1000);
  for (std::uint32_t y = 0; y < 1000; ++y) {
    for (std::uint32_t x = 0; x < 1000; ++x) {
      if (x - 211 >= 5 || y - 211 >= 5) map.map->blocked.set(x, y);  // below 0 is far above 5
    }
  }
  const Question question{
      .robot = RobotSpec{.kind = RobotKind::disc, .radius = 1.0}, .start = {900.5, 900.5}, .goal = {20.5, 900.5}};
  expect_near(told(map, question).free_place, {213.5, 213.5}, 1.5);
}

TEST(BlockedEnd, NamesTheJointAndItsLimitsAndGuessesDegrees) {
  const BlockedEnd blocked = told(told_world("puma.scene"), {.goal = {90, 0, 0, 0, 0, 0}});
  EXPECT_NE(blocked.by.find("joint 1"), std::string::npos) << blocked.by;
  EXPECT_NE(blocked.hint.find("90deg"), std::string::npos);
  EXPECT_FALSE(blocked.depth.has_value());
  ASSERT_EQ(blocked.free_place.size(), 6U) << "within the limits";
  EXPECT_LT(blocked.free_place[0], 3.0);
}

/// As written, and the body that is asked about.

struct DepthCase {
  const char* world;
  const char* by;
  double depth;  // by hand; 0: none
  double distance;
};

TEST(BlockedEnd, TellsHowDeepTheBodyStandsInWhatIsInTheWay) {
  const std::string block = "bounds 0 0 20 10\npolygon 8 2 14 2 14 8 8 8\ngoal 1 1\n";
  const std::string turning = "bounds 0 0 20 10\npolygon 8 2 14 2 14 8 8 8\ngoal 1 5 0\n";
  const DepthCase cases[] = {
      {"start 9.5 5\n", "polygon 0", 1.5, 1.5},
      {"start 9.5 5\nclearance 0.5\n", "polygon 0", 1.5, 2.0},
      {"start 9.5 5\nrobot disc 0.5\n", "polygon 0", 2.0, 2.0},
      {"start 7.8 5\nrobot disc 0.5\n", "polygon 0", 0.3, 0.3},
      {"start 7.8 5\nclearance 0.5\n", "polygon 0", 0.0, 0.3},  // too near, but not in it
      {"start 0.2 5\nrobot disc 0.5\n", "bounds", 0.3, 0.3},
      {"start 4 5\nrobot disc 0.5\nwall 4.1 0 4.1 10\n", "wall 0", 0.4, 0.4},
  };
  for (const DepthCase& c : cases) {
    SCOPED_TRACE(c.world);
    const BlockedEnd blocked = told(scene_of(block + c.world), {});
    EXPECT_TRUE(blocked.by.starts_with(c.by)) << blocked.by;
    EXPECT_NEAR(blocked.depth.value_or(0.0), c.depth, 2e-3 * c.depth);
    EXPECT_NEAR(blocked.distance, c.distance, 0.11 * c.distance);
  }
  // A body of 2 by 1 whose front is a unit in, and the same on its side.
  const DepthCase bodies[] = {
      {"robot polygon -1 -0.5 1 -0.5 1 0.5 -1 0.5\nstart 8 5 0\n", "polygon 0", 1.0, 1.0},
      {"robot polygon -1 -0.5 1 -0.5 1 0.5 -1 0.5\nstart 8 5 1.5707963267948966\n", "polygon 0", 0.5, 0.5},
      {"robot car polygon -1 -0.5 1 -0.5 1 0.5 -1 0.5 turning 1\nstart 8 5 0\n", "polygon 0", 1.0, 1.0},
      {"robot polygon -1 -0.5 1 -0.5 1 0.5 -1 0.5\nstart 0.4 5 0\n", "bounds", 0.6, 0.6}};
  for (const DepthCase& c : bodies) {
    SCOPED_TRACE(c.world);
    const BlockedEnd blocked = told(scene_of(turning + c.world), {});
    EXPECT_TRUE(blocked.by.starts_with(c.by)) << blocked.by;
    EXPECT_NEAR(blocked.depth.value_or(0.0), c.depth, 2e-3 * c.depth);
    EXPECT_NEAR(blocked.distance, c.distance, 0.11 * c.distance);
  }
}

TEST(BlockedEnd, APolygonWithAYardIsOneObstacle) {
  const TemporaryDirectory folder;
  const Scene ring = read_world(folder.write(
      "ring.wkt",
      "POLYGON ((0 0, 12 0, 12 12, 0 12, 0 0), (5 5, 7 5, 7 7, 5 7, 5 5))\nPOLYGON ((20 0, 21 0, 21 1, 20 0))\n"));
  ASSERT_FALSE(ring.seams.empty());
  // Wherever the cuts run, the nearest way out is 3 to the left, and 1.5 into the yard.
  for (const auto& [place, depth] : std::vector<std::pair<std::vector<double>, double>>{
           {{3, 6}, 2.0}, {{1.5, 3}, 1.5}, {{6, 3.5}, 1.5}, {{6, 9}, 2.0}, {{9, 6}, 2.0}, {{10.5, 11}, 1.0}}) {
    const BlockedEnd blocked = told(ring, {.start = place, .goal = {15, 6}});
    EXPECT_NEAR(blocked.depth.value_or(0.0), depth, 2e-3 * depth) << place[0] << ' ' << place[1];
  }
}

TEST(BlockedEnd, OfAMapTheBlockedCellsAreOneObstacle) {
  const Question question{.start = {0.05, 2.5}, .goal = {4.3, 0.5}};
  const BlockedEnd blocked = told(told_world("flat.yaml"), question);
  EXPECT_TRUE(blocked.by.starts_with("cell ")) << blocked.by;
  EXPECT_NEAR(blocked.depth.value_or(0.0), blocked.distance, 0.05 * blocked.distance);
}

TEST(BlockedEnd, TellsHowDeepALinkStandsInASolidAndAFreePostureNearby) {
  // The Puma's upper arm, straight ahead at q = 0: from (0, d2, 0) a length a2 = 0.4318 along x.
  const std::string arm = "robot puma560 radius 0.05\ngoal 1.5 0 0 0 0 0\nstart 0 0 0 0 0 0\n";
  const BlockedEnd ball = told(scene_of(arm + "sphere 0.3 0.1 0.2 0.25\n"), {});
  EXPECT_TRUE(ball.by.starts_with("sphere 0")) << ball.by;
  ASSERT_TRUE(ball.depth.has_value());
  EXPECT_NEAR(ball.depth.value_or(0.0), 0.25 - std::sqrt(0.05) + 0.05, 1e-9) << "the upper arm";
  ASSERT_EQ(ball.free_place.size(), 6U);
  const BlockedEnd slab = told(scene_of(arm + "box 0.1 -1 -0.02 0.3 1 0.06\n"), {});
  EXPECT_TRUE(slab.by.starts_with("box 0")) << slab.by;
  EXPECT_NEAR(slab.depth.value_or(0.0), 0.02 + 0.05, 1e-9) << "down, out of it";
  ASSERT_EQ(slab.free_place.size(), 6U);
  EXPECT_LT(slab.distance, 2.0);
}

TEST(DepthInBox, IsTheLeastWayOut) {
  const SolidBox box{{0, 0, 0}, {4, 2, 1}};
  EXPECT_NEAR(depth_in_box({-5, 1, 0.3}, {9, 1, 0.3}, box), 0.3, 1e-12) << "right through";
  EXPECT_NEAR(depth_in_box({0.2, 1, 0.5}, {0.2, 1, 0.5}, box), 0.2, 1e-12) << "a point";
  EXPECT_NEAR(depth_in_box({-1, 1, 0.5}, {0.2, 1, 0.5}, box), 0.2, 1e-12) << "its tip";
  EXPECT_NEAR(depth_in_box({-1, 0.6, 0.5}, {1, 2.6, 0.5}, box), 0.4 * std::sqrt(0.5), 1e-12) << "across an edge";
  EXPECT_LE(depth_in_box({-1, 1, 0.5}, {-0.1, 1, 0.5}, box), 0.0) << "beside it";
  EXPECT_LE(depth_in_box({-1, 1.2, 0.5}, {1, 3.2, 0.5}, box), 0.0) << "past an edge";
}

TEST(BlockedEnd, HoldsInLargeMazesAndForCars) {
  const BlockedEnd wall = told(read_world("maze:300x300"), {.start = {20, 20}, .goal = {2.5, 2.51}});
  EXPECT_TRUE(wall.by.starts_with("wall ")) << wall.by;
  EXPECT_LT(wall.distance, 0.2);
  told(told_world("car-20.scene"), {.goal = {8.9, 0.25, 1.57}});
}

TEST(BlockedEnd, HoldsWhereWallsAreMadeTileByTile) {
  Scene maze = unmade_maze_scene(parse_maze_source("maze:30x40,algorithm=mst"));
  maze.source = "maze:30x40,algorithm=mst";
  const Question question{
      .robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.2}, .start = {0.6, 7.0}, .goal = {9, 9}};
  const BlockedEnd wall = told(maze, question);
  EXPECT_TRUE(wall.by.starts_with("wall: ")) << wall.by;
  EXPECT_NEAR(wall.depth.value_or(0.0), 0.1, 1e-12) << "of the outline";
  EXPECT_EQ(wall.free_place, (std::vector<double>{0.803, 7}));
  const BlockedEnd outside = told(maze, {.goal = {50, 12}});
  EXPECT_EQ(outside.by, "outside of the bounds 0.5 0.5 40.5 30.5");
  EXPECT_EQ(outside.free_place, (std::vector<double>{40.396, 12}));
  EXPECT_TRUE(outside.hint.empty()) << outside.hint;
  EXPECT_EQ(told(maze, {.goal = {12, 35}}).hint, "x comes before y: 35,12 is free");
}

TEST(BlockedEnd, IsNotToldOfOtherAnswers) { EXPECT_FALSE(solve(told_world("walls.scene")).blocked.has_value()); }

}  // namespace
}  // namespace warren
