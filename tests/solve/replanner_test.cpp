// SPDX-License-Identifier: BSD-3-Clause
#include "solve/replanner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "solve/solve.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/answer_bytes.hpp"
#include "tests/solve/test_scenes.hpp"

namespace warren {
namespace {

using test::scene_of;

/// All but the account of the work: a repair looks at fewer cells.
std::string bytes_of(Answer answer) {
  answer.counters.expanded = 0;
  answer.costs.clear();
  return test::bytes_of(std::move(answer));
}

/// Blocks that come and go, prices, areas that the world forbids, discs and points, another start now and then.
void expect_fresh_bytes(std::uint64_t seed, int changes, std::uint32_t least) {
  SCOPED_TRACE(seed);
  SequentialRng rng(seed);
  const auto below = [&](std::uint64_t n) { return static_cast<std::uint32_t>(rng.below(n)); };
  const std::uint32_t width = least + below(40);
  const std::uint32_t height = least + below(40);
  Bitmap blocked(width, height);
  for (int n = 0; n < 12; ++n) {
    const std::uint32_t x = below(width - 6);
    for (std::uint32_t y = below(height - 6), rows = 1 + below(5); rows-- > 0; ++y)
      blocked.set_run(y, x, x + 1 + below(5));
  }
  Question question{.goal = {-1.0 + 0.25 * (width - 2.5), 2.0 + 0.25 * (height - 2.5)}};
  question.start = {-0.4, 2.6};
  question.robot = seed % 3 == 0 ? RobotSpec{} : RobotSpec{.kind = RobotKind::disc, .radius = 0.1 + 0.1 * below(3)};
  if (seed % 4 != 1) question.prices.clearance = ClearancePrice{3.0, 0.2 + 0.3 * below(4)};
  if (seed % 4 < 2) question.prices.areas.push_back({2.5, {{1.0, 3.0}, {4.0, 3.0}, {2.0, 9.0}}, 0});
  SolveOptions options;
  options.planner = PlannerKind::grid;
  Scene scene = scene_of(blocked, 0.25, {-1.0, 2.0});
  if (seed % 3 != 1) scene.prices.keep_out.push_back({{{0.6, 3.0}, {2.1, 2.7}, {1.6, 5.2}}, 0});
  Replanner replanner(std::move(scene), question, options);
  for (int change = 0; change < changes; ++change) {
    if (change % 5 == 4) question.start = {-0.9 + 0.25 * below(4), 2.1 + 0.25 * below(4)};
    const Answer again = replanner.solve(question.start);
    const Answer fresh = solve(replanner.scene(), question, options);
    ASSERT_EQ(bytes_of(again), bytes_of(fresh)) << "change " << change;
    std::vector<CellChange> cells;
    const Cell at{below(width), below(height)};
    const bool comes = rng.below(2) == 0;
    const bool all_over = change % 3 == 1;
    for (std::uint32_t n = below(9); n-- > 0;) {
      const Cell near{std::min(width - 1, at.x + below(3)), std::min(height - 1, at.y + below(3))};
      cells.push_back({all_over ? Cell{below(width), below(height)} : near, comes});
    }
    replanner.update(cells);
  }
}

TEST(Replanner, AnswersAreTheBytesOfAFreshSolve) {
  for (const std::uint64_t seed : test::seeds(100, 2)) expect_fresh_bytes(seed, 10, 20);
}

/// So wide that what is kept of distances ends before the next obstacle.
TEST(Replanner, AnswersAreTheBytesOfAFreshSolveInAHall) {
  for (const std::uint64_t seed : test::seeds(10, 1)) expect_fresh_bytes(seed, 4, 200);
}

TEST(Replanner, ABoxOfCellsIsWhatItsCellsAre) {
  Question question{.start = {-0.5, 2.5}, .goal = {3.5, 6.5}};
  question.prices.clearance = ClearancePrice{2.0, 0.5};
  SolveOptions options;
  options.planner = PlannerKind::grid;
  Replanner replanner(scene_of(Bitmap(20, 20), 0.25, {-1.0, 2.0}), question, options);
  const double before = *replanner.solve().cost;
  replanner.update({{0.0, 3.0}, {2.0, 6.0}}, true);
  EXPECT_EQ(replanner.scene().map->blocked.count(), 8U * 12U);
  EXPECT_EQ(replanner.scene().map->occupied, 8U * 12U);
  const Answer around = replanner.solve();
  EXPECT_GT(*around.cost, before);
  EXPECT_EQ(bytes_of(around), bytes_of(solve(replanner.scene(), question, options)));
  replanner.update({{0.0, 3.0}, {2.0, 6.0}}, false);
  EXPECT_EQ(*replanner.solve().cost, before);
}

/// The cells of a box are looked for near it alone.
TEST(Replanner, ABoxHasTheCellsWhoseMiddleIsInItHoweverTheMapLies) {
  SequentialRng rng(5);
  const auto unit = [&] { return 0x1p-20 * static_cast<double>(rng.below(1U << 20U)); };
  for (int round = 0; round < 200; ++round) {
    Scene scene = scene_of(Bitmap(12, 7), 0.1 + unit(), {50.0 * unit() - 25.0, -3.0 * unit()});
    OccupancyMap& map = *scene.map;
    if (round % 2 == 0) map.yaw_rad = 6.0 * unit();
    const Vec2 a = world_point(map, {16.0 * unit() - 2.0, 11.0 * unit() - 2.0});
    const Vec2 b = world_point(map, {16.0 * unit() - 2.0, 11.0 * unit() - 2.0});
    Box box{{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
    constexpr double end = std::numeric_limits<double>::infinity();
    if (round % 5 == 0) box.max.x = end;
    if (round % 7 == 0) box.min.y = -end;
    if (round % 11 == 0) box = {cell_centre(map, {3, 2}), cell_centre(map, {3, 2})};
    Bitmap expected(12, 7);
    for (std::uint32_t y = 0; y < 7; ++y) {
      for (std::uint32_t x = 0; x < 12; ++x) {
        if (box.contains(cell_centre(map, {x, y}))) expected.set(x, y);
      }
    }
    change_cells(scene, box, true);
    ASSERT_EQ(map.blocked, expected) << "round " << round;
    ASSERT_EQ(map.occupied, expected.count());
  }
}

TEST(Replanner, WaterThatIsBlockedLetsNobodyThrough) {
  Scene scene = scene_of(Bitmap(9, 3, true));
  scene.map->water = scene.map->blocked;
  Question question{.start = {0.5, 1.5}, .goal = {8.5, 1.5}};
  Replanner replanner(scene, question, {.planner = PlannerKind::grid});
  EXPECT_EQ(replanner.solve().outcome, Outcome::solved);
  replanner.update({{4.0, 0.0}, {5.0, 3.0}}, true);
  EXPECT_NE(replanner.solve().outcome, Outcome::solved);
}

TEST(Replanner, WhatCantChangeIsRefused) {
  Scene walls;
  walls.bounds = Box{{0.0, 0.0}, {1.0, 1.0}};
  const std::array<CellChange, 1> outside{CellChange{{20, 3}}};
  EXPECT_THROW(Replanner(walls, {}).update(outside), UsageError);
  Replanner replanner(scene_of(Bitmap(20, 20), 0.25, {-1.0, 2.0}), {});
  EXPECT_THROW(replanner.update(outside), InputError);
  EXPECT_EQ(replanner.scene().map->occupied, 0U);
}

}  // namespace
}  // namespace warren
