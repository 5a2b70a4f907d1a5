// SPDX-License-Identifier: BSD-3-Clause
// Stops on the way, in the order that is asked and in the cheapest, by planners that know one start and one goal:
// against the legs by themselves and all orders of them, and what is said where a stop can't be passed.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <string>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "solve/kinds/solve_to_goal.hpp"
#include "solve/solve.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"
#include "tests/solve/test_scenes.hpp"

namespace warren {
namespace {

using test::scene_of;
using States = std::vector<std::vector<double>>;

constexpr std::string_view room_with_blocks =
    "bounds 0 0 12 9\npolygon 3 2 4 2 4 7 3 7\npolygon 6 0 7 0 7 4 6 4\npolygon 6 5.5 7 5.5 7 9 6 9\npolygon 9 3 10 3 "
    "10 6 9 6\n";

Scene blocks_for(std::string_view robot) {
  return scene_of(std::string(room_with_blocks) + "robot " + std::string(robot) + "\n");
}

/// Free places, at least half a unit off the blocks.
std::vector<double> place(std::uint64_t seed, std::uint64_t number) {
  for (std::uint64_t i = 0;; ++i) {
    const double x = 0.6 + 10.8 * uniform(seed, 100 * number + i, 0);
    const double y = 0.6 + 7.8 * uniform(seed, 100 * number + i, 1);
    const bool in_column = (x > 2.4 && x < 4.6) || (x > 5.4 && x < 7.6) || (x > 8.4 && x < 10.6);
    if (!in_column) return {x, y};
  }
}

SolveOptions stopping_by(PlannerKind planner) {
  SolveOptions options;
  options.planner = planner;
  if (gets_better(planner)) options.anytime.iterations = 6;
  return options;
}

double paid(const Answer& answer) { return answer.cost.value_or(answer.length); }

double length_alone(const Scene& scene, const std::vector<double>& from, const std::vector<double>& to,
                    const SolveOptions& options) {
  Question question;
  question.start = from;
  question.goal = to;
  const Answer answer = solve(scene, question, options);
  EXPECT_TRUE(answer.verified);
  return paid(answer);
}

bool is_state_of(const Answer& answer, const std::vector<double>& stop) {
  if (answer.states.empty())
    return std::find(answer.path.begin(), answer.path.end(), Vec2{stop[0], stop[1]}) != answer.path.end();
  for (std::size_t i = 0; i < answer.states.size(); ++i) {
    if (std::equal(stop.begin(), stop.end(), answer.states[i].begin())) return true;
  }
  return false;
}

TEST(SolveThrough, AWayOverStopsIsItsLegs) {
  for (const std::uint64_t seed : test::seeds(40, 1)) {
    for (const auto& [robot, planner] : {std::pair{std::string_view("point"), PlannerKind::visibility},
                                         {"point", PlannerKind::cells},
                                         {"disc 0.2", PlannerKind::visibility},
                                         {"disc 0.2", PlannerKind::voronoi},
                                         {"point", PlannerKind::grid},
                                         {"disc 0.2", PlannerKind::prm},
                                         {"point", PlannerKind::anytime}}) {
      SCOPED_TRACE(std::string(robot) + ", " + std::string(name_of(planner)) + ", seed " + std::to_string(seed));
      const Scene scene = blocks_for(robot);
      const States stops{place(seed, 0), place(seed, 1), place(seed, 2), place(seed, 3)};
      SolveOptions options = stopping_by(planner);
      double sum = 0.0;
      for (std::size_t i = 0; i + 1 < stops.size(); ++i) sum += length_alone(scene, stops[i], stops[i + 1], options);
      Question question;
      question.start = stops.front();
      question.goal = stops.back();
      options.trees.via = {stops[1], stops[2]};
      const Answer answer = solve(scene, question, options);
      ASSERT_EQ(answer.outcome, Outcome::solved);
      EXPECT_NEAR(paid(answer), sum, 1e-9 * sum);
      EXPECT_TRUE(verify(scene, answer).verified);
      EXPECT_FALSE(answer.lower_bound) << "of a question without the stops it would be";
      EXPECT_FALSE(answer.optimal);
      for (const std::vector<double>& stop : stops) EXPECT_TRUE(is_state_of(answer, stop));
      EXPECT_EQ(answer.problem.via, options.trees.via);
      Answer out_of_turn = answer;
      std::swap(out_of_turn.problem.via[0], out_of_turn.problem.via[1]);
      EXPECT_FALSE(verify(scene, out_of_turn).verified);
      out_of_turn.problem.via = {place(seed, 4)};
      EXPECT_FALSE(verify(scene, out_of_turn).verified) << "it was not there";
    }
  }
}

/// The least sum of legs over all orders; goal: empty: there is none.
double least_over_orders(const Scene& scene, const std::vector<double>& start, const States& visit,
                         const std::vector<double>& goal, const SolveOptions& options) {
  States all{start};
  all.insert(all.end(), visit.begin(), visit.end());
  if (!goal.empty()) all.push_back(goal);
  std::vector<std::vector<double>> legs(all.size(), std::vector(all.size(), 0.0));
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) legs[i][j] = legs[j][i] = length_alone(scene, all[j], all[i], options);
  }
  std::vector<std::size_t> order(visit.size());
  std::iota(order.begin(), order.end(), 1);
  double least = std::numeric_limits<double>::infinity();
  do {
    double sum = legs[0][order.front()];
    for (std::size_t i = 0; i + 1 < order.size(); ++i) sum += legs[order[i]][order[i + 1]];
    if (!goal.empty()) sum += legs[order.back()][all.size() - 1];
    least = std::min(least, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

TEST(SolveThrough, PlacesAreVisitedInTheCheapestOrder) {
  for (const std::uint64_t seed : test::seeds(30, 1)) {
    for (const auto& [robot, planner] : {std::pair{std::string_view("point"), PlannerKind::visibility},
                                         {"disc 0.2", PlannerKind::visibility},
                                         {"point", PlannerKind::cells},
                                         {"disc 0.2", PlannerKind::grid}}) {
      for (const bool ends_there : {false, true}) {
        SCOPED_TRACE(std::string(robot) + ", " + std::string(name_of(planner)) + ", seed " + std::to_string(seed));
        const Scene scene = blocks_for(robot);
        Question question;
        question.start = place(seed, 0);
        if (ends_there) question.goal = place(seed, 9);
        for (std::uint64_t i = 1; i <= 4; ++i) question.rule.visit.push_back(place(seed, i));
        const Answer answer = solve(scene, question, stopping_by(planner));
        ASSERT_EQ(answer.outcome, Outcome::solved);
        const double least =
            least_over_orders(scene, question.start, question.rule.visit, question.goal, stopping_by(planner));
        EXPECT_NEAR(paid(answer), least, 1e-9 * least);
        ASSERT_EQ(answer.order.size(), 4U);
        EXPECT_TRUE(verify(scene, answer).verified);
        EXPECT_TRUE(!answer.lower_bound || *answer.lower_bound <= answer.length * (1.0 + 1e-9));
        if (!ends_there) EXPECT_EQ(answer.problem.goal, question.rule.visit[answer.order.back()]);
      }
    }
  }
}

TEST(SolveThrough, ThereAndBack) {
  const Scene scene = blocks_for("point");
  Question question;
  question.start = {1.0, 1.0};
  question.rule.visit = {{11.0, 1.0}, {5.0, 8.0}};
  question.rule.back = true;
  const Answer answer = solve(scene, question, stopping_by(PlannerKind::visibility));
  ASSERT_EQ(answer.outcome, Outcome::solved);
  EXPECT_EQ(answer.problem.goal, question.start);
  EXPECT_EQ(answer.path.front(), answer.path.back());
  EXPECT_TRUE(verify(scene, answer).verified);
  EXPECT_EQ(verify(scene, answer).bound, BoundVerdict::checked);
  Answer above = answer;
  above.lower_bound = 1.01 * *answer.lower_bound;
  EXPECT_EQ(verify(scene, above).bound, BoundVerdict::unchecked);
  question.prices.clearance = ClearancePrice{2.0, 1.0};
  const Answer priced = solve(scene, question, stopping_by(PlannerKind::prm));
  ASSERT_TRUE(priced.verified && priced.price);
  EXPECT_GT(*priced.lower_bound, 27.2);
  EXPECT_EQ(verify(scene, priced).bound, BoundVerdict::checked);
}

/// Bodies that turn: a stop with its heading is a state of the path, one without is a place of it.
TEST(SolveThrough, BodiesThatTurnStopAsTheyAreAsked) {
  const std::string square = "polygon -0.2 -0.2 0.2 -0.2 0.2 0.2 -0.2 0.2";
  const std::string reversing = "car radius 0.2 turning 0.5 steering reeds-shepp";
  for (const std::uint64_t seed : test::seeds(20, 1)) {
    for (const auto& [robot, planner] : {std::pair{square, PlannerKind::rrt_connect},
                                         {square, PlannerKind::grid},
                                         {square, PlannerKind::prm},
                                         {square, PlannerKind::anytime},
                                         {reversing, PlannerKind::rrt},
                                         {reversing, PlannerKind::grid},
                                         {reversing, PlannerKind::lazy_prm}}) {
      SCOPED_TRACE(robot + ", " + std::string(name_of(planner)) + ", seed " + std::to_string(seed));
      const Scene scene = blocks_for(robot);
      Question question;
      question.start = place(seed, 0);
      question.start.push_back(0.0);
      question.goal = place(seed, 3);
      std::vector<double> turned = place(seed, 1);
      turned.push_back(-3.0 + 6.0 * uniform(seed, 77, 0));
      const std::vector<double> anyhow = place(seed, 2);
      SolveOptions options = stopping_by(planner);
      if (robot == reversing && planner == PlannerKind::grid) options.car.cusp_cost = 1.0;
      options.trees.via = {turned, anyhow};
      const Answer answer = solve(scene, question, options);
      ASSERT_EQ(answer.outcome, Outcome::solved);
      EXPECT_TRUE(is_state_of(answer, turned));
      EXPECT_TRUE(is_state_of(answer, anyhow));
      const Verdict verdict = verify(scene, answer);
      EXPECT_TRUE(verdict.verified) << (verdict.first_violation ? verdict.first_violation->obstacle : "");
      options.trees.via.clear();
      question.rule.visit = {turned, anyhow};
      const Answer visiting = solve(scene, question, options);
      ASSERT_EQ(visiting.outcome, Outcome::solved);
      EXPECT_EQ(visiting.order.size(), 2U);
      const Verdict visited = verify(scene, visiting);
      EXPECT_TRUE(visited.verified) << (visited.first_violation ? visited.first_violation->obstacle : "");
    }
  }
}

TEST(SolveThrough, ArmsVisitStates) {
  const Scene scene = scene_of("robot puma560 radius 0.05\nsphere 0.8 0.4 0.75 0.3\n");
  Question question;
  question.start = {0, 0, 0, 0, 0, 0};
  question.goal = {0.3, -0.2, -2.8, 0, 0, 0};
  question.rule.visit = {{0.2, 0, -1.0, 0, 0, 0}, {0.5, -0.5, 0, 0, 0, 0}};
  for (const PlannerKind planner : {PlannerKind::rrt_connect, PlannerKind::prm, PlannerKind::anytime}) {
    Answer answer = solve(scene, question, stopping_by(planner));
    ASSERT_EQ(answer.outcome, Outcome::solved);
    EXPECT_TRUE(is_state_of(answer, question.rule.visit[0]) && is_state_of(answer, question.rule.visit[1]));
    EXPECT_TRUE(verify(scene, answer).verified);
    answer.problem.rule.visit[0][5] = 0.5;  // another posture
    EXPECT_FALSE(verify(scene, answer).verified);
  }
}

TEST(SolveThrough, TheJudgeRefutesAHeadingThatNobodyHad) {
  const Scene scene = blocks_for("polygon -0.2 -0.2 0.2 -0.2 0.2 0.2 -0.2 0.2");
  Question question;
  question.start = {1.0, 1.0, 0.0};
  question.goal = {11.0, 8.0};
  question.rule.visit = {{5.0, 1.0, 0.5}};
  Answer answer = solve(scene, question, stopping_by(PlannerKind::rrt_connect));
  ASSERT_TRUE(answer.verified);
  EXPECT_TRUE(verify(scene, answer).verified);
  answer.problem.rule.visit[0][2] += 6.283185307179586;
  EXPECT_TRUE(verify(scene, answer).verified) << "the same heading";
  answer.problem.rule.visit[0][2] = 0.6;
  EXPECT_FALSE(verify(scene, answer).verified);
}

TEST(SolveThrough, WithoutAWayItSaysHowFarItCame) {
  const Scene scene = scene_of("bounds 0 0 12 6\npolygon 5.9 0 6.1 0 6.1 6 5.9 6\nrobot point\n");
  Question question;
  question.start = {1.0, 3.0};
  question.goal = {2.0, 5.0};
  SolveOptions options = stopping_by(PlannerKind::visibility);
  options.trees.via = {{2.0, 1.0}, {9.0, 1.0}};
  const Answer answer = solve(scene, question, options);
  EXPECT_EQ(answer.outcome, Outcome::infeasible) << "each leg is proved, and a point has no heading";
  const Figure* reached = figure_named(answer.figures, "stops_reached");
  ASSERT_NE(reached, nullptr);
  EXPECT_EQ(std::get<std::uint64_t>(*reached), 1U);
  EXPECT_TRUE(answer.path.empty());
  EXPECT_EQ(answer.problem.start, question.start);
  EXPECT_EQ(answer.problem.goal, question.goal);
}

/// Where an earlier stop left the heading open another choice may have had a way.
TEST(SolveThrough, AnOpenHeadingProvesNothingOfLaterLegs) {
  const std::string bar = "polygon -0.8 -0.1 0.8 -0.1 0.8 0.1 -0.8 0.1";
  const Scene scene = scene_of("bounds 0 0 12 6\npolygon 5.9 0 6.1 0 6.1 6 5.9 6\nrobot " + bar + "\n");
  Question question;
  question.start = {1.5, 3.0, 0.0};
  question.goal = {9.0, 3.0, 0.0};
  SolveOptions options = stopping_by(PlannerKind::grid);
  options.trees.via = {{2.0, 2.0}};
  EXPECT_EQ(solve(scene, question, options).outcome, Outcome::not_connected);
}

/// Straight on it would stand in front of a wall, with no room to turn away.
TEST(SolveThrough, WhereAnOpenHeadingLeadsNowhereAnotherIsTried) {
  const Scene scene = scene_of("bounds 0 0 8 6\npolygon 2.6 1 2.8 1 2.8 5 2.6 5\nrobot car radius 0.2 turning 0.8\n");
  Question question;
  question.start = {0.6, 3.0, 0.0};
  question.goal = {0.6, 3.0};
  SolveOptions options = stopping_by(PlannerKind::grid);
  options.grid.cell = 0.1;
  question.goal = {2.0, 3.0};
  const Answer there = solve(scene, question, options);
  ASSERT_EQ(there.outcome, Outcome::solved);
  const auto last = there.states[there.states.size() - 1];
  question.start.assign(last.begin(), last.end());
  question.goal = {0.6, 3.0};
  ASSERT_EQ(solve(scene, question, options).outcome, Outcome::not_connected) << "the heading that is chosen first";
  question.start = {0.6, 3.0, 0.0};
  options.trees.via = {{2.0, 3.0}};
  const Answer answer = solve(scene, question, options);
  ASSERT_EQ(answer.outcome, Outcome::solved);
  EXPECT_TRUE(is_state_of(answer, {2.0, 3.0}));
  EXPECT_TRUE(verify(scene, answer).verified);
}

/// A second stop of that kind begins where the first one was turned to.
TEST(SolveThrough, TwoOpenHeadingsAreTurned) {
  const Scene scene = scene_of(
      "bounds 0 0 10 6\npolygon 6.6 1 6.8 1 6.8 5 6.6 5\npolygon 1.2 1 1.4 1 1.4 5 1.2 5\nrobot car radius 0.2 turning "
      "0.8\n");
  Question question;
  question.start = {4.0, 3.0, 0.0};
  question.goal = {4.0, 3.0};
  SolveOptions options = stopping_by(PlannerKind::grid);
  options.grid.cell = 0.1;
  options.trees.via = {{6.0, 3.0}, {2.0, 3.0}};
  const Answer answer = solve(scene, question, options);
  ASSERT_EQ(answer.outcome, Outcome::solved);
  EXPECT_TRUE(verify(scene, answer).verified);
}

TEST(SolveThrough, APolygonThatIsNotTurnedKeepsItsHeading) {
  const Scene scene =
      scene_of("bounds 0 0 12 6\npolygon 5.9 0 6.1 0 6.1 6 5.9 6\nrobot polygon -0.2 -0.1 0.2 -0.1 0.2 0.1 -0.2 0.1\n");
  Question question;
  question.start = {1.0, 3.0, 0.5};
  question.goal = {9.0, 3.0};
  SolveOptions options = stopping_by(PlannerKind::visibility);
  options.trees.via = {{2.0, 2.0}};
  const Answer apart = solve(scene, question, options);
  EXPECT_TRUE(apart.outcome == Outcome::not_connected || apart.outcome == Outcome::infeasible);
  question.goal = {1.0, 5.0};
  const Answer answer = solve(scene, question, options);
  ASSERT_EQ(answer.outcome, Outcome::solved);
  EXPECT_TRUE(verify(scene, answer).verified);
}

TEST(SolveThrough, ABlockedGoalIsSaidAfterOpenStops) {
  const Scene scene = scene_of(
      "bounds 0 0 10 10\npolygon 4.5 9 5.5 9 5.5 9.9 4.5 9.9\nrobot polygon -0.2 -0.1 0.2 -0.1 0.2 0.1 -0.2 0.1\n");
  Question question;
  question.start = {1.0, 5.0, 0.0};
  question.goal = {5.0, 9.5};
  SolveOptions options = stopping_by(PlannerKind::rrt_connect);
  options.trees.via = {{3.0, 3.0}};
  EXPECT_EQ(solve(scene, question, options).outcome, Outcome::goal_blocked);
}

/// Around the area it is dear: one place is reached before it.
TEST(SolveThrough, TheOrderHeedsPrices) {
  const Scene scene = scene_of("bounds 0 0 10 10\npolygon 4.9 9.5 5.1 9.5 5.1 9.9 4.9 9.9\nrobot disc 0.1\n");
  Question question;
  question.start = {1.0, 5.0};
  question.prices.areas.push_back({50.0, {{3, 4}, {5, 4}, {5, 6}, {3, 6}}, 0});
  question.rule.visit = {{4.0, 5.0}, {9.0, 5.0}};
  SolveOptions options = stopping_by(PlannerKind::prm);
  options.roadmap.samples = 400;
  const Answer answer = solve(scene, question, options);
  ASSERT_TRUE(answer.verified && answer.price);
  EXPECT_EQ(answer.order, (std::vector<std::uint64_t>{1, 0})) << "into the area last, and not out again";
  EXPECT_TRUE(verify(scene, answer).verified);
  question.rule = {};
  question.goal = {4.0, 5.0};
  question.rule.others = {{9.0, 5.0}};
  EXPECT_EQ(solve(scene, question, options).goal_index, 1U) << "further, and cheaper";
}

TEST(SolveThrough, WhoComesBackHasToBeBack) {
  const Scene scene = blocks_for("point");
  Question question;
  question.start = {1.0, 1.0};
  question.goal = {5.0, 8.0};
  Answer answer = solve(scene, question, stopping_by(PlannerKind::visibility));
  ASSERT_TRUE(verify(scene, answer).verified);
  answer.problem.rule.back = true;
  EXPECT_FALSE(verify(scene, answer).verified);
}

/// A car's arc is not its chord.
TEST(SolveThrough, ACarVisitsWhereItIs) {
  const Scene scene = scene_of("bounds -5 -5 5 5\nrobot car radius 0.1 turning 1\n");
  Question question;
  question.start = {0.0, 0.0, 0.0};
  question.goal = {1.0, 1.0, 1.5707963267948966};
  Answer answer = solve(scene, question, stopping_by(PlannerKind::rrt_connect));
  ASSERT_TRUE(answer.verified);
  answer.problem.rule.visit = {{0.5, 0.5}};
  EXPECT_FALSE(verify(scene, answer).verified);
  question.rule.visit = {{0.5, 0.5}};
  EXPECT_TRUE(verify(scene, solve(scene, question, stopping_by(PlannerKind::rrt_connect))).verified);
}

void expect_refused(const Scene& scene, const Question& question, const SolveOptions& options, std::string_view what) {
  const std::string said = test::refusal<UsageError>([&] { solve(scene, question, options); });
  EXPECT_NE(said.find(what), std::string::npos) << what << ' ' << said;
}

TEST(SolveThrough, StopsThatAreNoneAreRefused) {
  const Scene scene = blocks_for("point");
  Question question;
  question.start = {1.0, 1.0};
  question.goal = {11.0, 8.0};
  SolveOptions options = stopping_by(PlannerKind::visibility);
  options.trees.via = {{2.0, 1.0}, {3.5, 4.0}};
  expect_refused(scene, question, options, "via: the point does not fit at way-point 2");
  options.trees.via = {{2.0, 1.0, 0.5}};
  expect_refused(scene, question, options, "via: a point or disc takes X,Y");
  question.rule.visit = {{5.0, 1.0}};
  expect_refused(scene, question, options, "visit: finds the order of its places, and via says one");
  options.trees.via.clear();
  question.rule.visit = {{5.0, 1.0}, {3.5, 4.0}};
  expect_refused(scene, question, options, "visit: the point does not fit at place 2");
}

/// Planners that get better share the time among the legs, and tell whole paths alone.
TEST(SolveThrough, BetterWithTimeIsToldOfWholePaths) {
  const Scene scene = blocks_for("polygon -0.2 -0.2 0.2 -0.2 0.2 0.2 -0.2 0.2");
  Question question;
  question.start = {1.0, 1.0, 0.0};
  question.goal = {11.0, 8.0};
  SolveOptions options;
  options.planner = PlannerKind::anytime;
  options.trees.via = {{5.0, 8.0}, {8.0, 1.0}};
  const Deadline deadline(0.6);
  std::vector<double> told;
  const std::function<bool(const Improvement&)> tell = [&](const Improvement& better) {
    told.push_back(better.cost);
    return true;
  };
  const Execution execution{.threads = 1, .deadline = &deadline, .on_improvement = &tell};
  const Answer answer = solve_within(scene, question, options, execution);
  ASSERT_EQ(answer.outcome, Outcome::solved);
  EXPECT_EQ(answer.ended_by, "budget");
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.rbegin(), told.rend()));
  EXPECT_NEAR(told.back(), paid(answer), 1e-9 * told.back());
  ASSERT_FALSE(answer.improvements.empty());
  EXPECT_NEAR(answer.improvements.back().cost, paid(answer), 1e-9 * paid(answer));
  EXPECT_TRUE(verify(scene, answer).verified);
}

TEST(SolveThrough, ThreadsChangeNothing) {
  const Scene scene = blocks_for("disc 0.2");
  Question question;
  question.start = {1.0, 1.0};
  question.rule.visit = {{11.0, 1.0}, {5.0, 8.0}, {8.0, 5.0}};
  for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::rrt_connect, PlannerKind::anytime}) {
    const Answer one = solve(scene, question, stopping_by(planner), {.threads = 1});
    ASSERT_EQ(one.outcome, Outcome::solved);
    for (const unsigned threads : {2U, 3U, 8U}) {
      const Answer more = solve(scene, question, stopping_by(planner), {.threads = threads});
      EXPECT_EQ(more.path, one.path);
      EXPECT_EQ(more.order, one.order);
      EXPECT_EQ(more.counters, one.counters);
    }
  }
}

}  // namespace
}  // namespace warren
