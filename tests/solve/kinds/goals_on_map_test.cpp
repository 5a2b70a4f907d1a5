// SPDX-License-Identifier: BSD-3-Clause
// Several goals, tolerances, regions, visits and prices on maps, against plain searches of small maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <variant>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "solve/solve.hpp"
#include "tests/planners/grid/grid_oracle.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/test_scenes.hpp"

namespace warren {
namespace {

using test::scene_of;

using grid_oracle::random_cell;
using grid_oracle::random_map;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> middle(Cell c) { return {c.x + 0.5, c.y + 0.5}; }

SolveOptions mapped_by(PlannerKind planner) {
  SolveOptions options;
  options.planner = planner;
  return options;
}

/// All cells that plain steps to the sides reach.
std::vector<Cell> reachable(const Bitmap& blocked, Cell start) {
  std::vector<Cell> cells{start};
  Bitmap seen = blocked;
  seen.set(start.x, start.y);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const std::int64_t x = std::int64_t{cells[i].x} + dx;
      const std::int64_t y = std::int64_t{cells[i].y} + dy;
      if (x < 0 || y < 0 || x >= blocked.width() || y >= blocked.height() || seen.holds(x, y)) continue;
      const Cell next{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
      seen.set(next.x, next.y);
      cells.push_back(next);
    }
  }
  return cells;
}

double off(Cell c, const std::vector<double>& place) { return std::hypot(c.x + 0.5 - place[0], c.y + 0.5 - place[1]); }

/// Each of the places is looked at, not the first alone.
TEST(GoalsOnMap, TakesPlacesOfTwoNumbers) {
  const Scene scene = scene_of(Bitmap(6, 6));
  Question question;
  question.start = {0.5, 0.5};
  question.goal = {2.5, 2.5};
  for (auto* places : {&question.rule.others, &question.rule.visit}) {
    *places = {{1.5, 2.5, 7.0}};
    EXPECT_THROW(solve(scene, question, {}), UsageError);
    *places = {{1.5, 2.5}};
    EXPECT_EQ(solve(scene, question, {}).outcome, Outcome::solved);
    places->clear();
  }
}

TEST(GoalsOnMap, OfSeveralGoalsTheNearestIsReached) {
  for (const std::uint64_t seed : test::seeds(120, 15)) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(seed, 60);
    const Scene scene = scene_of(map);
    const Cell start = random_cell(map, seed, 1);
    if (map.test(start.x, start.y)) continue;
    Question question{.start = middle(start)};
    double least = infinity;
    for (std::uint64_t i = 0; i < 4; ++i) {
      const Cell goal = random_cell(map, seed, 10 + i);
      (i == 0 ? question.goal : question.rule.others.emplace_back()) = middle(goal);
      least = std::min(least, grid_oracle::shortest(map, start, goal, Diagonal::sqrt2));
    }
    const Answer answer = solve(scene, question, mapped_by(PlannerKind::grid));
    ASSERT_EQ(answer.verified, std::isfinite(least));
    if (!answer.verified) {
      EXPECT_EQ(answer.outcome, Outcome::infeasible);
      continue;
    }
    EXPECT_NEAR(*answer.cost, least, 1e-6 * least);
    const std::uint64_t index = *answer.goal_index;
    EXPECT_EQ(answer.problem.goal, index == 0 ? question.goal : question.rule.others[index - 1]);
    EXPECT_TRUE(verify(scene, answer).verified);
    for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::lazy_prm, PlannerKind::rrt_connect}) {
      const Answer sampled = solve(scene, question, mapped_by(planner));
      EXPECT_TRUE(sampled.verified) << name_of(planner);
      EXPECT_EQ(sampled.goal_index, answer.goal_index) << name_of(planner);
      EXPECT_EQ(sampled.problem.goal, answer.problem.goal) << name_of(planner);
    }
  }
}

TEST(GoalsOnMap, AToleranceReachesTheNearestPlaceThatIsJoinedToTheStart) {
  for (const std::uint64_t seed : test::seeds(200, 24)) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(seed, 60);
    const Scene scene = scene_of(map);
    const Cell start = random_cell(map, seed, 1);
    if (map.test(start.x, start.y)) continue;
    const std::vector<double> goal{map.width() * uniform(seed, 1, 1), map.height() * uniform(seed, 1, 2)};
    const std::vector<Cell> cells = reachable(map, start);
    double least = infinity;
    for (const Cell c : cells) least = std::min(least, off(c, goal));
    for (const double tolerance : {infinity, 1.5}) {
      const Question question{.start = middle(start), .goal = goal, .rule = {.tolerance = tolerance}};
      const Answer answer = solve(scene, question, mapped_by(PlannerKind::grid));
      ASSERT_TRUE(answer.goal_reached.has_value());
      const GoalReached& reached = *answer.goal_reached;
      EXPECT_EQ(reached.asked, goal);
      EXPECT_LE(*reached.distance_bound, reached.distance);
      EXPECT_LE(reached.distance, least);
      EXPECT_GE(reached.distance, least - 0.7072);
      ASSERT_EQ(answer.verified, reached.distance <= tolerance);
      if (!answer.verified) {
        EXPECT_EQ(answer.outcome == Outcome::goal_blocked || answer.outcome == Outcome::infeasible,
                  *reached.distance_bound > tolerance);
        continue;
      }
      const Vec2 end = answer.path.back();
      EXPECT_NEAR(std::hypot(end.x - goal[0], end.y - goal[1]), reached.distance, 1e-12);
      const Cell own{static_cast<std::uint32_t>(end.x), static_cast<std::uint32_t>(end.y)};
      EXPECT_NE(std::find(cells.begin(), cells.end(), own), cells.end());
      EXPECT_TRUE(verify(scene, answer).verified);
      const Answer sampled = solve(scene, question, mapped_by(PlannerKind::rrt_connect));
      EXPECT_TRUE(sampled.verified);
      EXPECT_EQ(sampled.problem.goal, answer.problem.goal);
    }
  }
}

/// Where the middle of a disc may be, if it is the middle of a cell.
Bitmap wide(const Bitmap& blocked, double radius) {
  Bitmap result = blocked;
  for (std::uint32_t y = 0; y < blocked.height(); ++y) {
    for (std::uint32_t x = 0; x < blocked.width(); ++x) {
      const double border = std::min({x + 0.5, y + 0.5, blocked.width() - x - 0.5, blocked.height() - y - 0.5});
      bool meets = border < radius;
      for (std::uint32_t v = 0; v < blocked.height() && !meets; ++v) {
        for (std::uint32_t u = 0; u < blocked.width() && !meets; ++u) {
          const double dx = std::max(0.0, std::abs(double{1} * u - x) - 0.5);
          const double dy = std::max(0.0, std::abs(double{1} * v - y) - 0.5);
          meets = blocked.test(u, v) && std::hypot(dx, dy) < radius;
        }
      }
      if (meets) result.set(x, y);
    }
  }
  return result;
}

TEST(GoalsOnMap, ADiscComesAsNearAsAnyMiddleThatItReaches) {
  for (const std::uint64_t seed : test::seeds(90, 6)) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(3 * seed + 1, 40);
    const Scene scene = scene_of(map);
    RobotSpec disc;
    disc.kind = RobotKind::disc;
    disc.radius = 0.3 + uniform(seed, 9, 9);
    const Bitmap free = wide(map, disc.radius);
    const Cell start = random_cell(free, seed, 1);
    if (free.test(start.x, start.y)) continue;
    const std::vector<double> goal{map.width() * uniform(seed, 1, 1), map.height() * uniform(seed, 1, 2)};
    double least = infinity;
    for (const Cell c : reachable(free, start)) least = std::min(least, off(c, goal));
    const Question question{.robot = disc, .start = middle(start), .goal = goal, .rule = {.tolerance = infinity}};
    const Answer answer = solve(scene, question, mapped_by(PlannerKind::grid));
    if (answer.outcome == Outcome::start_blocked) continue;
    ASSERT_TRUE(answer.verified);
    EXPECT_LE(answer.goal_reached->distance, least);
    EXPECT_LE(*answer.goal_reached->distance_bound, answer.goal_reached->distance);
  }
}

TEST(GoalsOnMap, ARegionIsEnteredWhereThatIsCheapest) {
  for (const std::uint64_t seed : test::seeds(120, 15)) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(seed, 60);
    const Scene scene = scene_of(map);
    const Cell start = random_cell(map, seed, 1);
    const Cell goal = random_cell(map, seed, 2);
    if (map.test(start.x, start.y)) continue;
    const double radius = 8.0 * uniform(seed, 5, 5);
    double least = infinity;
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      for (std::uint32_t x = 0; x < map.width(); ++x) {
        if (off({x, y}, middle(goal)) > radius) continue;
        least = std::min(least, grid_oracle::shortest(map, start, {x, y}, Diagonal::sqrt2));
      }
    }
    const Question question{.start = middle(start), .goal = middle(goal), .rule = {.region = radius}};
    const Answer answer = solve(scene, question, mapped_by(PlannerKind::grid));
    ASSERT_EQ(answer.verified, std::isfinite(least));
    if (!answer.verified) continue;
    EXPECT_LE(answer.length, least + 1e-9);
    EXPECT_GE(answer.length, least - 1.42);
    EXPECT_LE(std::hypot(answer.path.back().x - goal.x - 0.5, answer.path.back().y - goal.y - 0.5), radius + 1e-9);
    EXPECT_LE(*solve(scene, question, mapped_by(PlannerKind::lazy_prm)).lower_bound, answer.length);
  }
}

TEST(GoalsOnMap, WhoStartsInARegionStays) {
  const Scene scene = scene_of(Bitmap(12, 12));
  const std::vector<double> start{3.3, 4.4};
  for (const PlannerKind planner : {PlannerKind::grid, PlannerKind::prm, PlannerKind::lazy_prm, PlannerKind::rrt,
                                    PlannerKind::rrt_connect, PlannerKind::rrt_star, PlannerKind::anytime}) {
    SCOPED_TRACE(name_of(planner));
    Question question{.start = start, .goal = {5.3, 4.4}, .rule = {.region = 2.1}};
    SolveOptions options = mapped_by(planner);
    if (gets_better(planner)) options.anytime.iterations = 2;
    const Answer near = solve(scene, question, options);
    ASSERT_TRUE(near.verified);
    EXPECT_EQ(near.length, 0.0);
    EXPECT_EQ(near.problem.goal, start);
    EXPECT_NEAR(near.goal_reached->distance, 2.0, 1e-12);
    question.goal = {11.0, 11.0};
    question.rule.others = {{1.4, 4.4}};
    const Answer other = solve(scene, question, options);
    EXPECT_EQ(other.length, 0.0);
    EXPECT_EQ(other.goal_index, 1U);
  }
}

TEST(GoalsOnMap, AWayIntoARegionPassesItsStopsFirst) {
  const Scene scene = scene_of(Bitmap(40, 30));
  for (const std::vector<double>& start : {std::vector<double>{2.5, 15.5}, std::vector<double>{29.5, 15.5}}) {
    const Question question{.start = start, .goal = {30.5, 15.5}, .rule = {.region = 3.0}};
    SolveOptions options = mapped_by(PlannerKind::grid);
    options.trees.via = {{35.5, 20.5}};
    const Answer answer = solve(scene, question, options);
    ASSERT_TRUE(answer.verified);
    EXPECT_TRUE(std::ranges::any_of(answer.path, [](Vec2 p) { return p == Vec2{35.5, 20.5}; }));
    EXPECT_NEAR(answer.goal_reached->distance, 3.0, 1e-9);
  }
}

TEST(GoalsOnMap, VisitsOfAWorldWithSeveralGoalsAreRefused) {
  Scene scene = scene_of(Bitmap(20, 20));
  scene.start = {2.5, 2.5};
  scene.goal = {18.5, 2.5};
  scene.other_goals = {{2.5, 18.5}};
  Question question{.rule = {.visit = {{5.5, 15.5}}}};
  EXPECT_THROW(solve(scene, question, mapped_by(PlannerKind::prm)), UsageError);
  question.goal = {2.5, 18.5};
  EXPECT_TRUE(solve(scene, question, mapped_by(PlannerKind::prm)).verified);
}

TEST(GoalsOnMap, VisitsAreInTheBestOfAllOrders) {
  for (const std::uint64_t seed : test::seeds(60, 8)) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(seed, 40);
    const Scene scene = scene_of(map);
    const Cell start = random_cell(map, seed, 1);
    if (map.test(start.x, start.y)) continue;
    std::vector<Cell> stops;
    for (std::uint64_t i = 0; i < 1 + seed % 5; ++i) stops.push_back(random_cell(map, seed, 10 + i));
    const Cell goal = random_cell(map, seed, 2);
    Question question{.start = middle(start)};
    for (const Cell stop : stops) question.rule.visit.push_back(middle(stop));
    const int end = static_cast<int>(seed % 3);  // a goal, back, or anywhere
    if (end == 0) question.goal = middle(goal);
    question.rule.back = end == 1;
    const auto way = [&](Cell a, Cell b) { return grid_oracle::shortest(map, a, b, Diagonal::sqrt2); };
    double least = infinity;
    std::vector<std::uint64_t> order(stops.size());
    std::iota(order.begin(), order.end(), 0);
    do {
      double sum = way(start, stops[order[0]]);
      for (std::size_t i = 1; i < order.size(); ++i) sum += way(stops[order[i - 1]], stops[order[i]]);
      if (end < 2) sum += way(stops[order.back()], end == 0 ? goal : start);
      least = std::min(least, sum);
    } while (std::next_permutation(order.begin(), order.end()));
    const Answer answer = solve(scene, question, mapped_by(PlannerKind::grid));
    ASSERT_EQ(answer.verified, std::isfinite(least));
    if (!answer.verified) {
      EXPECT_EQ(answer.outcome, Outcome::infeasible);
      continue;
    }
    EXPECT_NEAR(*answer.cost, least, 1e-6 * least + 1e-9);
    std::size_t at = 0;
    for (const std::uint64_t stop : answer.order) {
      const std::vector<double> place = middle(stops[stop]);
      while (at < answer.path.size() && !(answer.path[at] == Vec2{place[0], place[1]})) ++at;
    }
    EXPECT_LT(at, answer.path.size());
    EXPECT_TRUE(verify(scene, answer).verified);
    const Answer sampled = solve(scene, question, mapped_by(PlannerKind::prm));
    EXPECT_TRUE(sampled.verified);
    EXPECT_EQ(sampled.order, answer.order);
    EXPECT_LE(sampled.lower_bound.value_or(0.0), sampled.length);
    // The order that was found, as way-points.
    if (end != 0) continue;
    SolveOptions through = mapped_by(PlannerKind::grid);
    Question in_order{.start = question.start, .goal = question.goal};
    for (const std::uint64_t stop : answer.order) through.trees.via.push_back(middle(stops[stop]));
    EXPECT_EQ(solve(scene, in_order, through).path, answer.path);
    through.planner = PlannerKind::lazy_prm;
    EXPECT_TRUE(solve(scene, in_order, through).verified);
  }
}

TEST(GoalsOnMap, AStopThatIsBlockedIsNamed) {
  Bitmap map(9, 9);
  map.set(4, 4);
  const Scene scene = scene_of(map);
  const Question question{.start = {0.5, 0.5}, .goal = {8.5, 8.5}, .rule = {.visit = {{1.5, 1.5}, {4.5, 4.5}}}};
  EXPECT_EQ(test::refusal<UsageError>([&] { solve(scene, question, mapped_by(PlannerKind::grid)); }),
            "visit: the point does not fit at place 2");
  SolveOptions options = mapped_by(PlannerKind::grid);
  options.search = SearchMethod::astar;
  EXPECT_THROW(solve(scene, {.start = {0.5, 0.5}, .goal = {8.5, 8.5}, .rule = {.tolerance = 1.0}}, options),
               UsageError);
}

double cells_cost(const Answer& answer) {
  const Figure* figure = figure_named(answer.path_figures, "cells_cost");
  return figure != nullptr ? std::get<double>(*figure) : -1.0;
}

TEST(GoalsOnMap, APricedPathIsPulledTautAndItsPartsAddUp) {
  double over_cells = 0.0;
  double taut = 0.0;
  for (const std::uint64_t seed : test::seeds(60, 6)) {
    SCOPED_TRACE(seed);
    const Bitmap map = random_map(3 * seed + 1, 50);
    const Scene scene = scene_of(map);
    Question question{.start = middle(random_cell(map, seed, 1)), .goal = middle(random_cell(map, seed, 2))};
    question.prices.clearance = {3.0, 2.5};
    question.prices.areas = {{2.0, {{2, 2}, {30, 4}, {9, 20}}}};
    const Answer answer = solve(scene, question, mapped_by(PlannerKind::grid));
    if (!answer.verified) continue;
    ASSERT_TRUE(answer.price.has_value());
    EXPECT_EQ(*answer.cost, answer.length + answer.price->sum());
    EXPECT_LE(*answer.cost, cells_cost(answer) * (1.0 + 1e-9));
    EXPECT_LE(*answer.lower_bound, *answer.cost);
    EXPECT_EQ(answer.bound_of, "all");
    for (const unsigned threads : {2U, 3U}) {
      Limits limits;
      limits.threads = threads;
      EXPECT_EQ(solve(scene, question, mapped_by(PlannerKind::grid), limits).path, answer.path);
    }
    over_cells += cells_cost(answer);
    taut += *answer.cost;
    // Nothing said, or a price of nothing: the path of the same solve.
    Question free = question;
    free.prices = {};
    const Path<Vec2> plain = solve(scene, free, mapped_by(PlannerKind::grid)).path;
    free.prices.clearance = {0.0, 2.5};
    const Answer of_nothing = solve(scene, free, mapped_by(PlannerKind::grid));
    EXPECT_EQ(of_nothing.path, plain);
    EXPECT_EQ(of_nothing.price.value_or(PriceParts{}).sum(), 0.0);
  }
  EXPECT_LT(taut, 0.97 * over_cells);
}

/// They lie aside, where shortening would cut them off.
TEST(GoalsOnMap, AShortenedPathPassesItsPlacesAndTheJudgeWantsThemPassed) {
  const Scene scene = scene_of(Bitmap(12, 12));
  const std::vector<std::vector<double>> places{{10.5, 2.25}, {2.5, 9.75}};
  for (const PlannerKind planner :
       {PlannerKind::grid, PlannerKind::prm, PlannerKind::lazy_prm, PlannerKind::rrt, PlannerKind::rrt_connect}) {
    for (const bool by_order : {false, true}) {
      SCOPED_TRACE(std::string(name_of(planner)) + (by_order ? ", visit" : ", via"));
      Question question{.start = {1.5, 1.5}, .goal = {10.5, 10.5}};
      SolveOptions options = mapped_by(planner);
      options.optimise = true;
      if (by_order) question.rule.visit = places;
      if (!by_order) options.trees.via = places;
      const Answer answer = solve(scene, question, options);
      ASSERT_TRUE(answer.verified);
      for (const std::vector<double>& place : places) {
        const auto is_place = [&](Vec2 p) { return p == Vec2{place[0], place[1]}; };
        EXPECT_TRUE(std::any_of(answer.path.begin(), answer.path.end(), is_place)) << place[0];
      }
      EXPECT_TRUE(verify(scene, answer).verified);
      if (!by_order) continue;
      Answer straight = answer;
      straight.path = {answer.path.front(), answer.path.back()};
      straight.length = distance(straight.path[0], straight.path[1]);
      const Verdict verdict = verify(scene, straight);
      EXPECT_FALSE(verdict.verified);
      EXPECT_EQ(verdict.first_violation.value_or(Violation{}).obstacle, "visit: the path passes place 1 by");
    }
  }
}

/// A wall with a blocked goal in it: places on both of its sides are equally near.
Bitmap with_wall() {
  Bitmap map(9, 9);
  for (std::uint32_t y = 0; y < 8; ++y) map.set(4, y);
  return map;
}

TEST(GoalsOnMap, OfEquallyNearPlacesNoneIsCalledTheShortest) {
  const Scene scene = scene_of(with_wall());
  for (const PlannerKind planner : {PlannerKind::grid, PlannerKind::prm, PlannerKind::rrt_star}) {
    SolveOptions options = mapped_by(planner);
    options.bound = true;
    if (planner == PlannerKind::rrt_star) options.anytime.iterations = 4;
    Question question{.start = {0.5, 3.5}, .goal = {4.5, 0.5}, .rule = {.tolerance = 2.0}};
    const Answer near = solve(scene, question, options);
    SCOPED_TRACE(name_of(planner));
    ASSERT_TRUE(near.verified);
    EXPECT_FALSE(near.optimal);
    EXPECT_LE(near.lower_bound.value_or(0.0), 5.0 - near.goal_reached->distance + 1e-9);
    const Verdict verdict = verify(scene, near);
    EXPECT_TRUE(verdict.verified);
    RecordedAnswer claims = recorded(near);
    claims.cost.reset();
    claims.lower_bound = near.length;
    EXPECT_NE(verify(scene, claims).bound, BoundVerdict::checked) << "places on the other side are as near";
    question.goal = {3.5, 0.5};
    EXPECT_TRUE(solve(scene, question, options).goal_reached->distance == 0.0);
  }
}

/// What an answer says of its goal is a part of what is verified; and what the judge's own question says.
TEST(GoalsOnMap, WhatIsToldOfTheGoalIsJudged) {
  const Scene scene = scene_of(with_wall());
  const Question question{.start = {0.5, 0.5}, .goal = {4.5, 0.5}, .rule = {.tolerance = 2.0}};
  const RecordedAnswer good = recorded(solve(scene, question, mapped_by(PlannerKind::grid)));
  const auto refuted = [&](const RecordedAnswer& answer, const Question& asked = {}) {
    const Verdict verdict = verify(scene, answer, asked);
    return verdict.verified ? std::string() : verdict.first_violation.value_or(Violation{}).obstacle;
  };
  EXPECT_EQ(refuted(good), "");
  RecordedAnswer other = good;
  other.goal_reached->distance *= 0.5;
  EXPECT_TRUE(refuted(other).starts_with("goal_reached: the answer says"));
  other = good;
  other.goal_reached->distance_bound = 1.5 * good.goal_reached->distance;
  EXPECT_TRUE(refuted(other).starts_with("goal_reached: `distance_bound`"));
  other = good;
  other.problem.rule.tolerance.reset();
  EXPECT_TRUE(refuted(other).starts_with("goal_reached: no tolerance"));
  other = good;
  other.problem.rule.tolerance = 0.5 * good.goal_reached->distance;
  EXPECT_TRUE(refuted(other).starts_with("goal_tolerance: the path ends farther"));
  other = good;
  other.goal_index = 1;
  EXPECT_EQ(refuted(other), "goal_index: the answer has no goal 1");

  const std::vector<double> end{good.path.back().x, good.path.back().y};
  EXPECT_EQ(refuted(good, {.goal = {4.5, 0.5}, .rule = {.region = 2.0}}), "");
  EXPECT_TRUE(refuted(good, {.goal = {8.5, 0.5}, .rule = {.region = 2.0}}).starts_with("goal_region: "));
  EXPECT_TRUE(refuted(good, {.rule = {.region = 0.1}}).starts_with("goal_region: ")) << "of the goal that it asked for";
  EXPECT_EQ(refuted(good, {.goal = {8.5, 8.5}, .rule = {.others = {{7.5, 7.5}, end}}}), "");
  EXPECT_NE(refuted(good, {.goal = {8.5, 8.5}, .rule = {.others = {{7.5, 7.5}}}}), "");

  const Question tour{.start = {0.5, 0.5}, .goal = {0.5, 8.5}, .rule = {.visit = {{3.5, 6.5}, {3.5, 1.5}}}};
  other = recorded(solve(scene, tour, mapped_by(PlannerKind::grid)));
  EXPECT_EQ(other.order, (std::vector<std::uint64_t>{1, 0}));
  EXPECT_EQ(refuted(other), "");
  EXPECT_EQ(refuted(other, {.rule = {.visit = {{3.5, 6.5}}}}), "");
  EXPECT_EQ(refuted(other, {.rule = {.visit = {{3.5, 6.5}, {8.5, 0.5}}}}), "visit: the path passes place 2 by");
  EXPECT_NE(refuted(other, {.rule = {.visit = {{3.5, 6.5}}, .back = true}}), "");
  EXPECT_THROW(refuted(good, {.goal = {4.5, 0.5}, .rule = {.region = 2.0, .heading_rad = 0.1}}), UsageError);
  std::swap(other.order[0], other.order[1]);
  EXPECT_EQ(refuted(other), "order: the path visits the places in another one");
  other.order = {1, 1};
  EXPECT_EQ(refuted(other), "order: the path visits the places in another one");
}

TEST(GoalsOnMap, WhatFollowsFromTheBoundIsJudged) {
  const Scene scene = scene_of(with_wall());
  SolveOptions options = mapped_by(PlannerKind::grid);
  options.bound = true;
  const Question question{.start = {0.5, 0.5}, .goal = {8.5, 0.5}};
  RecordedAnswer answer = recorded(solve(scene, question, options));
  ASSERT_LT(*answer.lower_bound, 0.999 * *answer.length);
  EXPECT_TRUE(verify(scene, answer).verified);
  answer.gap = *answer.length / *answer.lower_bound - 1.0;
  EXPECT_TRUE(verify(scene, answer).verified);
  answer.gap = 0.0;
  EXPECT_FALSE(verify(scene, answer).verified);
  answer.gap.reset();
  answer.optimal = true;
  EXPECT_FALSE(verify(scene, answer).verified);
}

}  // namespace
}  // namespace warren
