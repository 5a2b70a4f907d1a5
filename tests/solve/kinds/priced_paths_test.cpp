// SPDX-License-Identifier: BSD-3-Clause
// Prices from the question to the judged answer: points and discs on maps and among walls.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "solve/answer/read_answer_io.hpp"
#include "solve/solve.hpp"

namespace warren {
namespace {

/// A wall across the middle with a narrow gap at the top and a wide one at the bottom.
Scene map_with_gaps() {
  Scene scene;
  OccupancyMap map;
  map.blocked = Bitmap(40, 40);
  for (std::uint32_t y = 8; y < 40; ++y) {
    if (y < 30 || y > 31) map.blocked.set(20, y);
  }
  map.free = 40 * 40 - 30;
  scene.map = map;
  scene.start = {10.5, 30.5};
  scene.goal = {30.5, 30.5};
  return scene;
}

Scene walls_with_gaps() {
  Scene scene;
  const std::array walls{Segment{{20, 8}, {20, 30}}, Segment{{20, 32}, {20, 40}}};
  scene.walls = WallSet::narrowest(walls);
  scene.bounds = Box{{0, 0}, {40, 40}};
  scene.start = {10.5, 30.5};
  scene.goal = {30.5, 30.5};
  return scene;
}

SolveOptions by(PlannerKind planner) {
  SolveOptions options;
  options.planner = planner;
  if (planner == PlannerKind::prm || planner == PlannerKind::lazy_prm) options.roadmap.samples = 1500;
  return options;
}

TEST(PricedPaths, RoadmapsGoWhereItIsCheaperAndTheJudgeSaysWhatItCosts) {
  for (const Scene& scene : {map_with_gaps(), walls_with_gaps()}) {
    for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::lazy_prm}) {
      const Answer plain = solve(scene, {}, by(planner));
      ASSERT_TRUE(plain.verified);
      EXPECT_FALSE(plain.price);
      Question asked;
      asked.prices.areas.push_back({20.0, {{18, 25}, {22, 25}, {22, 38}, {18, 38}}, 0});
      asked.prices.clearance = ClearancePrice{2.0, 3.0};
      const Answer dear = solve(scene, asked, by(planner));
      ASSERT_TRUE(dear.verified);
      ASSERT_TRUE(dear.price && dear.cost);
      EXPECT_EQ(*dear.cost, dear.length + dear.price->sum());
      EXPECT_GT(dear.length, plain.length + 5.0);  // by the other gap
      EXPECT_DOUBLE_EQ(dear.price->areas, 0.0);
      EXPECT_LE(*dear.lower_bound, *dear.cost);
      EXPECT_TRUE(verify(scene, dear).verified);
      Answer wrong = dear;
      *wrong.cost += 0.01;
      EXPECT_FALSE(verify(scene, wrong).verified);
      wrong = dear;
      wrong.price->clearance -= 0.01;
      EXPECT_FALSE(verify(scene, wrong).verified);
    }
  }
}

TEST(PricedPaths, LazyAndWholeRoadmapsCostTheSame) {
  Question asked;
  asked.prices.clearance = ClearancePrice{3.0, 4.0};
  for (const Scene& scene : {map_with_gaps(), walls_with_gaps()}) {
    const Answer whole = solve(scene, asked, by(PlannerKind::prm));
    const Answer lazy = solve(scene, asked, by(PlannerKind::lazy_prm));
    ASSERT_TRUE(whole.cost && lazy.cost);
    EXPECT_NEAR(*whole.cost, *lazy.cost, 1e-9 * *whole.cost);
    SolveOptions shorter = by(PlannerKind::prm);
    shorter.optimise = true;
    const Answer pulled = solve(scene, asked, shorter);
    ASSERT_TRUE(pulled.cost);
    EXPECT_LE(*pulled.cost, *whole.cost * (1.0 + 1e-12));
  }
}

TEST(PricedPaths, WhatIsForbiddenIsAnObstacleToAllPlanners) {
  Question asked;
  asked.prices.keep_out.push_back({{{18, 25}, {23, 25}, {23, 38}, {18, 38}}, 0});
  const Scene map = map_with_gaps();
  for (const PlannerKind planner :
       {PlannerKind::prm, PlannerKind::lazy_prm, PlannerKind::rrt_connect, PlannerKind::voronoi}) {
    const Answer answer = solve(map, asked, by(planner));
    ASSERT_TRUE(answer.verified) << name_of(planner);
    for (const Vec2 p : answer.path) EXPECT_FALSE(p.x > 18 && p.x < 23 && p.y > 25 && p.y < 38);
    EXPECT_GT(answer.length, 40.0);
    EXPECT_TRUE(verify(map, answer).verified);
  }
  const Scene walls = walls_with_gaps();
  for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::rrt_connect, PlannerKind::visibility}) {
    const Answer answer = solve(walls, asked, by(planner));
    ASSERT_TRUE(answer.verified) << name_of(planner);
    EXPECT_GT(answer.length, 40.0);
  }
  // A path through it is none, whoever asks.
  const Answer free = solve(map, {}, by(PlannerKind::prm));
  EXPECT_FALSE(verify(map, recorded(free), asked).verified);
  // And a start in it is blocked.
  asked.start = {19.0, 30.5};
  EXPECT_EQ(solve(map, asked, by(PlannerKind::prm)).outcome, Outcome::start_blocked);
}

TEST(PricedPaths, UnknownCellsAreFreeAtAPrice) {
  Scene scene = map_with_gaps();
  for (std::uint32_t y = 0; y < 8; ++y) scene.map->blocked.set(20, y);
  scene.map->unknown = Bitmap(40, 40);
  for (std::uint32_t y = 28; y < 32; ++y) {
    scene.map->blocked.set(20, y);
    scene.map->unknown.set(20, y);
  }
  EXPECT_FALSE(solve(scene, {}, by(PlannerKind::prm)).verified);
  Question asked;
  asked.prices.unknown = 3.0;
  const Answer answer = solve(scene, asked, by(PlannerKind::prm));
  ASSERT_TRUE(answer.verified);
  ASSERT_TRUE(answer.price);
  EXPECT_GE(answer.price->areas, 2.0 - 1e-9);  // a cell across, at least
  EXPECT_TRUE(verify(scene, answer).verified);
  // Who says that they are blocked is not overruled by the answer, nor by the file.
  Question blocked;
  blocked.prices.unknown = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(verify(scene, recorded(answer), blocked).verified);
  scene.prices.unknown = 3.0;
  EXPECT_TRUE(solve(scene, {}, by(PlannerKind::prm)).verified);
  EXPECT_FALSE(solve(scene, blocked, by(PlannerKind::prm)).verified);
}

}  // namespace
}  // namespace warren
