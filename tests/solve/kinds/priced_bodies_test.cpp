// SPDX-License-Identifier: BSD-3-Clause
// Restrictions and prices for polygons that turn and for cars, by every planner: an answer that holds, or a refusal
// with a reason.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/question/asked_words.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

constexpr std::array<double, 4> forbidden{4.0, 3.0, 6.0, 8.0};  // the box that keep-out closes

Scene plane() {
  Scene scene;
  scene.bounds = Box{{0, 0}, {10, 8}};
  scene.polygons.push_back({{{1.0, 1.0}, {1.5, 1.0}, {1.5, 1.5}, {1.0, 1.5}}, 0});
  return scene;
}

/// The same as cells; a part of the column x = 8 is unknown.
Scene map() {
  Scene scene;
  scene.map.emplace();
  scene.map->cell = 0.25;
  scene.map->blocked = Bitmap(40, 32);
  scene.map->unknown = Bitmap(40, 32);
  for (std::uint32_t y = 4; y < 6; ++y) {
    for (std::uint32_t x = 4; x < 6; ++x) scene.map->blocked.set(x, y);
  }
  for (std::uint32_t y = 0; y < 32; ++y) {
    scene.map->blocked.set(30, y);
    scene.map->unknown.set(30, y);
  }
  return scene;
}

RobotSpec body(RobotKind kind) {
  RobotSpec robot{.kind = kind, .outline = {{-0.2, -0.15}, {0.3, -0.15}, {0.3, 0.15}, {-0.2, 0.15}}};
  if (kind == RobotKind::car) {
    robot.turning_radius = 0.5;
    robot.steering = SteeringKind::reeds_shepp;
  }
  if (kind == RobotKind::disc) robot = {.kind = kind, .radius = 0.2};
  if (kind == RobotKind::point) robot = {.kind = kind};
  return robot;
}

Question question(RobotKind kind) {
  Question asked;
  asked.robot = body(kind);
  asked.start = {2.0, 6.0, 0.0};
  asked.goal = {7.0, 6.0, 0.0};
  if (kind == RobotKind::disc || kind == RobotKind::point) {
    asked.start.pop_back();
    asked.goal.pop_back();
  }
  asked.prices.keep_out.push_back({{{forbidden[0], forbidden[1]},
                                    {forbidden[2], forbidden[1]},
                                    {forbidden[2], forbidden[3]},
                                    {forbidden[0], forbidden[3]}},
                                   0});
  return asked;
}

SolveOptions planned_by(PlannerKind planner) {
  SolveOptions options;
  options.planner = planner;
  if (gets_better(planner)) options.anytime.iterations = 20;
  if (planner == PlannerKind::prm || planner == PlannerKind::lazy_prm) options.roadmap.samples = 400;
  return options;
}

/// At 1000 poses along the path: does a point of the body's outline lie in the forbidden box?
bool enters(const Answer& answer, const RobotSpec& robot) {
  const std::size_t legs = answer.states.size() > 0 ? answer.states.size() - 1 : 0;
  const std::size_t a_leg = 1000 / std::max<std::size_t>(legs, 1) + 1;
  for (std::size_t i = 0; i < legs; ++i) {
    const auto a = answer.states[i];
    const auto b = answer.states[i + 1];
    const double turn = std::remainder(b[2] - a[2], 2.0 * std::acos(-1.0));
    const double chord = std::hypot(b[0] - a[0], b[1] - a[1]);
    for (std::size_t k = 0; k <= a_leg; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(a_leg);
      Vec2 p{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
      if (robot.kind == RobotKind::car && std::abs(turn) > 1e-9) {  // on the arc: the chord seen from a, by half angles
        const double along = std::sin(0.5 * t * turn) / std::sin(0.5 * turn) * chord;
        const double towards = std::atan2(b[1] - a[1], b[0] - a[0]) - 0.5 * (1.0 - t) * turn;
        p = {a[0] + along * std::cos(towards), a[1] + along * std::sin(towards)};
      }
      const double theta = a[2] + t * turn;
      for (std::size_t c = 0; c < robot.outline.size(); ++c) {
        const Vec2 from = robot.outline[c];
        const Vec2 to = robot.outline[(c + 1) % robot.outline.size()];
        for (int s = 0; s < 8; ++s) {
          const Vec2 q = from + (s / 8.0) * (to - from);
          const double x = p.x + std::cos(theta) * q.x - std::sin(theta) * q.y;
          const double y = p.y + std::sin(theta) * q.x + std::cos(theta) * q.y;
          if (x > forbidden[0] && x < forbidden[2] && y > forbidden[1] && y < forbidden[3]) return true;
        }
      }
    }
  }
  return false;
}

/// By day one case of so many, drawn by its name and WARREN_PICK.
bool is_drawn(const std::string& name, std::uint64_t of) {
  return test::asks_all() || (test::hash_of(name + std::string(test::environment("WARREN_PICK"))) >> 32U) % of == 0;
}

TEST(PricedBodies, WhatIsForbiddenIsAnObstacleToEveryPlannerOfBodiesThatTurn) {
  for (const Scene& scene : {plane(), map()}) {
    for (const RobotKind kind : {RobotKind::polygon, RobotKind::car}) {
      for (const PlannerKind planner :
           {PlannerKind::rrt_connect, PlannerKind::rrt, PlannerKind::prm, PlannerKind::lazy_prm, PlannerKind::anytime,
            PlannerKind::grid, PlannerKind::voronoi, PlannerKind::visibility, PlannerKind::cells}) {
        const std::string name = std::string(name_of(planner)) + (scene.map ? " map " : " plane ");
        SCOPED_TRACE(name);
        if (!is_drawn(name + std::string(name_of(kind)), 2)) continue;
        const Question asked = question(kind);
        Answer answer;
        try {
          answer = solve(scene, asked, planned_by(planner));
        } catch (const UsageError& error) {
          EXPECT_NE(std::string(error.what()).find("planner"), std::string::npos) << error.what();
          continue;
        }
        ASSERT_EQ(answer.outcome, Outcome::solved);
        EXPECT_TRUE(answer.verified);
        EXPECT_FALSE(enters(answer, *asked.robot));
        EXPECT_GT(answer.length, 6.0);
        EXPECT_TRUE(verify(scene, answer).verified);
        Question free = asked;
        free.prices = {};
        EXPECT_FALSE(verify(scene, recorded(solve(scene, free, planned_by(PlannerKind::rrt_connect))), asked).verified);
      }
    }
  }
}

TEST(PricedBodies, UnknownCellsAreFreeAtAPriceOfOneToBodiesThatTurn) {
  for (const RobotKind kind : {RobotKind::polygon, RobotKind::car}) {
    for (const PlannerKind planner : {PlannerKind::rrt_connect, PlannerKind::grid}) {
      Question asked = question(kind);
      asked.goal[0] = 9.0;
      EXPECT_NE(solve(map(), asked, planned_by(planner)).outcome, Outcome::solved);
      asked.prices.unknown = 1.0;
      const Answer answer = solve(map(), asked, planned_by(planner));
      ASSERT_EQ(answer.outcome, Outcome::solved) << name_of(planner);
      EXPECT_TRUE(verify(map(), answer).verified);
    }
  }
}

struct Word {
  AskedWord word;
  Prices prices;
};

std::vector<Word> price_questions() {
  std::vector<Word> words(3);
  words[0] = {AskedWord::clearance_price, {}};
  words[0].prices.clearance = ClearancePrice{3.0, 1.0};
  words[1] = {AskedWord::area, {}};
  words[1].prices.areas.push_back({20.0, {{4.0, 4.0}, {5.0, 4.0}, {5.0, 8.0}, {4.0, 8.0}}, 0});
  words[2] = {AskedWord::unknown_factor, {}};
  words[2].prices.unknown = 5.0;
  return words;
}

TEST(PricedBodies, EveryPlannerPaysOrRefusesByName) {
  int paid = 0;
  std::uint64_t number = 0;  // by day each sixth case, from one on that WARREN_PICK chooses
  const std::uint64_t turn = test::hash_of(test::environment("WARREN_PICK")) >> 32U;
  for (const Scene& scene : {plane(), map()}) {
    for (const RobotKind kind : {RobotKind::point, RobotKind::disc, RobotKind::polygon, RobotKind::car}) {
      for (const PlannerKind planner :
           {PlannerKind::rrt_connect, PlannerKind::prm, PlannerKind::lazy_prm, PlannerKind::rrt_star, PlannerKind::grid,
            PlannerKind::voronoi, PlannerKind::visibility, PlannerKind::cells}) {
        for (const Word& word : price_questions()) {
          const std::string name = std::string(name_of(planner)) + " " + std::string(name_of(word.word)) +
                                   (scene.map ? " map " : " plane ") + std::string(name_of(kind));
          SCOPED_TRACE(name);
          if (!test::asks_all() && (number++ + turn) % 6 != 0) continue;
          Question asked = question(kind);
          asked.prices = word.prices;
          Answer answer;
          try {
            answer = solve(scene, asked, planned_by(planner));
          } catch (const UsageError& error) {
            const std::string what = error.what();
            const std::string named(name_of(word.word));
            EXPECT_TRUE(what.find(named) != std::string::npos || what.find("planner") != std::string::npos) << what;
            continue;
          }
          ASSERT_EQ(answer.outcome, Outcome::solved);
          ASSERT_TRUE(answer.price && answer.cost);
          ++paid;
          EXPECT_EQ(*answer.cost, answer.length + answer.price->sum());
          EXPECT_LE(answer.price->error, 1e-3 * *answer.cost);
          EXPECT_LE(answer.lower_bound.value_or(0.0), *answer.cost);
          EXPECT_TRUE(verify(scene, answer).verified);
          Answer wrong = answer;
          *wrong.cost += 0.01;
          EXPECT_FALSE(verify(scene, wrong).verified);
          wrong = answer;
          wrong.price->clearance += 0.01;
          EXPECT_FALSE(verify(scene, wrong).verified);
          wrong = answer;
          wrong.price->areas += 0.01;
          EXPECT_FALSE(verify(scene, wrong).verified);
        }
      }
    }
  }
  EXPECT_GE(paid, test::asks_all() ? 2 * 2 * 2 + 2 * 3 * 2 + 2 * (2 + 3) + 3 : 3);
}

TEST(PricedBodies, ACarGoesAroundWhatIsDear) {
  for (const Scene& scene : {plane(), map()}) {
    Question asked = question(RobotKind::car);
    asked.prices = price_questions()[1].prices;
    for (const bool optimise : {false, true}) {
      if (!test::asks_all() && optimise != scene.map.has_value()) continue;
      SolveOptions options = planned_by(PlannerKind::grid);
      options.optimise = optimise;
      const Answer answer = solve(scene, asked, options);
      ASSERT_TRUE(answer.price);
      EXPECT_LT(answer.price->areas,
                1.0);  // straight on it is 19; between two places that were looked at a corner may be cut
      EXPECT_GT(answer.length, 6.0);
    }
  }
}

/// Of one roadmap the path is the cheapest, whatever drives: cheaper than the shortest, with what that one pays.
TEST(PricedBodies, ACarsRoadmapWeighsItsEdges) {
  for (const SteeringKind steering : {SteeringKind::dubins, SteeringKind::reeds_shepp, SteeringKind::differential}) {
    for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::lazy_prm}) {
      SCOPED_TRACE(std::string(name_of(steering)) + ", " + std::string(name_of(planner)));
      const Scene scene = planner == PlannerKind::prm ? plane() : map();
      Question asked = question(RobotKind::car);
      asked.robot->steering = steering;
      asked.prices = {};
      const SolveOptions options = planned_by(planner);
      const Answer shortest = solve(scene, asked, options);
      asked.prices = price_questions()[1].prices;
      const Answer cheapest = solve(scene, asked, options);
      ASSERT_TRUE(shortest.verified && cheapest.verified && cheapest.price);
      EXPECT_TRUE(verify(scene, cheapest).verified);
      Answer claimed = shortest;
      claimed.problem.prices = asked.prices;
      claimed.cost = 0.0;
      claimed.price = PriceParts{};
      claimed.lower_bound.reset();
      const Verdict dear = verify(scene, claimed);
      ASSERT_FALSE(dear.verified) << "it goes through the area";
      EXPECT_LT(cheapest.price->areas, 3.0) << "straight on it is 19";
    }
  }
}

/// A motion costs no less than its distance, turns on the spot included: else A* would find dearer ways, as it did for
/// four of these six seeds.
TEST(PricedBodies, ADifferentialDrivesEstimatesAreNoMoreThanItPays) {
  const Scene scene = read_world(test::source_dir() + "/examples/worlds/car-20.scene");
  Question asked{.start = {-8.0, -5.0, 0.0}, .goal = {8.0, 5.0, 0.0}};
  asked.robot = {.kind = RobotKind::car, .radius = 0.3, .turning_radius = 1.0};
  asked.robot->steering = SteeringKind::differential;
  asked.prices.areas.push_back({3.0, {{-2, -6}, {2, -6}, {2, 6}, {-2, 6}}, 0});
  for (const std::uint64_t seed : test::seeds(6, 6)) {
    SolveOptions options = planned_by(PlannerKind::prm);
    options.seed = seed;
    options.search = SearchMethod::dijkstra;
    const Answer plainly = solve(scene, asked, options);
    options.search = SearchMethod::astar;
    EXPECT_EQ(solve(scene, asked, options).cost, plainly.cost) << seed;
  }
}

TEST(PricedBodies, GearsOfAPricedRoadmapAreTold) {
  Question asked = question(RobotKind::car);
  asked.goal = {2.0, 5.0, 3.1};
  asked.prices = price_questions()[0].prices;
  SolveOptions options = planned_by(PlannerKind::prm);
  options.optimise = true;
  options.car.cusp_cost = 0.5;
  options.car.reverse_cost = 2.0;
  const Answer answer = solve(map(), asked, options);
  ASSERT_TRUE(answer.verified && answer.price);
  const Verdict verdict = verify(map(), answer);
  EXPECT_TRUE(verdict.verified) << verdict.first_violation.value_or(Violation{}).obstacle;
  EXPECT_EQ(answer.price->cusps, 0.5 * static_cast<double>(verdict.cusps));
  EXPECT_NEAR(answer.price->reverse, verdict.reversed, 1e-9);
}

TEST(PricedBodies, WhatACarSaysOfItsGearsAndTurnsIsVerified) {
  Question asked = question(RobotKind::car);
  asked.goal = {2.0, 5.0, 3.1};
  for (const bool priced : {false, true}) {
    asked.prices = {};
    if (priced) asked.prices.clearance = ClearancePrice{2.0, 1.0};
    for (const bool optimise : {false, true}) {
      SolveOptions options = planned_by(PlannerKind::grid);
      options.optimise = optimise;
      options.grid.turn_cost = 0.2;
      options.car.reverse_cost = 1.5;
      const Answer answer = solve(map(), asked, options);
      ASSERT_TRUE(answer.price && answer.cost);
      EXPECT_EQ(*answer.cost, answer.length + answer.price->sum());
      EXPECT_GT(answer.price->turning, 0.3);
      const Verdict verdict = verify(map(), answer);
      EXPECT_TRUE(verdict.verified) << verdict.first_violation.value_or(Violation{}).obstacle;
      Answer wrong = answer;
      wrong.price->turning -= 0.1;
      *wrong.cost -= 0.1;
      EXPECT_FALSE(verify(map(), wrong).verified);
    }
  }
}

}  // namespace
}  // namespace warren
