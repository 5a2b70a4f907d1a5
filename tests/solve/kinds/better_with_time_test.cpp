// SPDX-License-Identifier: BSD-3-Clause
// Planners that get better until they are stopped, asked through solve().
#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/answer/write_answer_io.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"

namespace warren {
namespace {

using namespace std::chrono_literals;

Scene world(const std::string& name) { return read_world(test::source_dir() + "/" + name, {}); }
SolveOptions better(PlannerKind planner, std::optional<std::uint64_t> iterations = {}) {
  SolveOptions options{.planner = planner};
  options.anytime.iterations = iterations;
  return options;
}
const std::vector<std::string> worlds = {"examples/worlds/poly-easy.scene", "examples/worlds/walls.scene"};

TEST(BetterWithTime, AnswersTellBoundGapAndWhatEndedThem) {
  for (const PlannerKind planner : {PlannerKind::anytime, PlannerKind::rrt_star, PlannerKind::informed_rrt_star}) {
    for (const std::string& name : worlds) {
      SCOPED_TRACE(name + " " + std::string(name_of(planner)));
      const Answer answer = solve(world(name), {}, better(planner, 12));
      ASSERT_EQ(answer.outcome, Outcome::solved);
      EXPECT_TRUE(answer.verified);
      EXPECT_EQ(answer.ended_by, "iterations");
      EXPECT_EQ(answer.iterations, 12U);
      ASSERT_TRUE(answer.lower_bound);
      EXPECT_LE(*answer.lower_bound, answer.cost.value_or(answer.length));
      ASSERT_FALSE(answer.improvements.empty());
      EXPECT_NEAR(answer.improvements.back().cost, answer.cost.value_or(answer.length), 1e-9 * answer.length);
      EXPECT_EQ(answer.cost.has_value(), answer.turn_rad.has_value());
      if (planner == PlannerKind::anytime) continue;  // which shortens by itself
      SolveOptions shorter = better(planner, 12);
      shorter.optimise = true;
      const Answer shortened = solve(world(name), {}, shorter);
      ASSERT_TRUE(shortened.verified);
      const double cost = shortened.cost.value_or(shortened.length);
      EXPECT_NEAR(shortened.improvements.back().cost, cost, 1e-9 * cost) << "the last of them is the answer";
      EXPECT_EQ(shortened.improvements.back().by, "optimise");
    }
  }
}

TEST(BetterWithTime, AGapThatIsReachedEndsIt) {
  SolveOptions options = better(PlannerKind::anytime);
  options.anytime.gap = 0.5;
  const Answer answer = solve(world(worlds[0]), {}, options, {.budget = 60s});
  ASSERT_TRUE(answer.verified);
  EXPECT_EQ(answer.ended_by, "gap");
  EXPECT_LE(*gap_of(answer), 0.5);
  options.planner.reset();  // who asks for a gap asks for a planner that gets better
  EXPECT_EQ(solve(world(worlds[0]), {}, options, {.budget = 60s}).planner, "anytime");
}

/// "gap" is told only where the answer's own gap is within what was asked.
TEST(BetterWithTime, AGapToOnePlaceOfSeveralIsNamedSo) {
  const Scene flat = world("examples/worlds/flat.yaml");
  SolveOptions options = better(PlannerKind::anytime, 50);
  options.anytime.gap = 0.01;
  Question region{.start = {0.5, 0.5}, .goal = {4.3, 0.5}};
  Question others = region;
  Question visit = region;
  region.rule.region = 0.3;
  others.rule.others = {{4.3, 3.5}};
  visit.rule.visit = {{2.5, 3.0}};
  for (const Question& asked : {region, others, visit}) {
    const Answer answer = solve(flat, asked, options);
    ASSERT_TRUE(answer.verified);
    EXPECT_TRUE(answer.ended_by == "goal_gap" || answer.ended_by == "goal" || answer.ended_by == "iterations")
        << answer.ended_by;
  }
  EXPECT_EQ(solve(flat, region, options).ended_by, "goal_gap");
  options.anytime.iterations = 1;
  EXPECT_NE(solve(flat, visit, options).ended_by, "goal_gap");  // a leg that comes near does not speak for the others
}

TEST(BetterWithTime, AGapOverTheLatticeIsNamedSo) {
  SolveOptions options = better(PlannerKind::grid);
  for (const auto& [gap, end] : {std::pair(0.04, "lattice_gap"), std::pair(0.2, "gap")}) {
    options.anytime.gap = gap;
    const Answer answer = solve(world("examples/worlds/car-20.scene"), {}, options);
    ASSERT_TRUE(answer.verified);
    EXPECT_EQ(answer.ended_by, end);
    EXPECT_EQ(*gap_of(answer) <= gap, answer.ended_by == "gap");
  }
}

/// What its planner makes small counts turning, so the length may rise; of other cars it is the length.
TEST(BetterWithTime, CostsAreToldWhereTheyAreNotTheLength) {
  const auto told = [](const Scene& scene, const SolveOptions& options) {
    const Answer answer = solve(scene, {}, options);
    EXPECT_TRUE(verify(scene, answer).verified);
    EXPECT_FALSE(answer.cost);
    EXPECT_FALSE(answer.improvements.empty());
    std::string text;
    write_answer_json(answer, {}, [&](std::string_view piece) { text += piece; });
    return text;
  };
  SolveOptions options = better(PlannerKind::anytime, 12);
  EXPECT_EQ(told(world("examples/worlds/car-20.scene"), options).find("\"cost\""), std::string::npos);
  options.car.steering = SteeringKind::differential;
  EXPECT_NE(told(world("examples/worlds/car-20.scene"), options).find("\"cost\""), std::string::npos);
}

TEST(BetterWithTime, ABudgetThatEndsWithAPathIsAnAnswer) {
  const Scene scene = world(worlds[0]);
  const Answer answer = solve(scene, {}, better(PlannerKind::anytime), {.budget = 1500ms});
  ASSERT_EQ(answer.outcome, Outcome::solved);
  EXPECT_TRUE(answer.verified);
  EXPECT_EQ(answer.stop_reason, StopReason::time);
  const Answer again = solve(scene, {}, better(PlannerKind::anytime, answer.iterations));
  EXPECT_TRUE(std::equal(again.states.numbers.begin(), again.states.numbers.end(), answer.states.numbers.begin(),
                         answer.states.numbers.end()));
  EXPECT_EQ(solve(scene, {}, better(PlannerKind::anytime), {.budget = 1us}).outcome, Outcome::stopped);
}

TEST(BetterWithTime, ASignalThatComesWithAPathLeavesIt) {
  SignalFlag signal{0};
  Limits limits{.cancel = &signal};
  int told = 0;
  limits.on_improvement = [&](const Improvement&) {
    if (++told == 2) signal = 15;
    return true;
  };
  const Answer answer = solve(world(worlds[0]), {}, better(PlannerKind::anytime), limits);
  ASSERT_EQ(answer.outcome, Outcome::solved);
  EXPECT_TRUE(answer.verified);
  EXPECT_EQ(answer.stop_reason, StopReason::terminate);
  EXPECT_EQ(answer.ended_by, "SIGTERM");
}

TEST(BetterWithTime, AnErrorOfWhoIsToldPassesThrough) {
  Limits limits;
  limits.on_improvement = [](const Improvement&) -> bool { throw UsageError("enough"); };
  EXPECT_THROW(solve(world(worlds[0]), {}, better(PlannerKind::anytime, 12), limits), UsageError);
}

TEST(BetterWithTime, WhatTheyWouldIgnoreIsRefused) {
  SolveOptions options = better(PlannerKind::anytime);
  options.optimise = true;
  EXPECT_THROW(solve(world(worlds[0]), {}, options), UsageError);
  options = better(PlannerKind::rrt_connect, 5);
  EXPECT_THROW(solve(world(worlds[0]), {}, options), UsageError);
}

}  // namespace
}  // namespace warren
