// SPDX-License-Identifier: BSD-3-Clause
// What a program that links the library may rely on.
#include "solve/solve.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <string>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "tests/paths.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using namespace std::chrono_literals;

Scene example(const std::string& name) { return read_world(test::source_dir() + "/examples/worlds/" + name); }

/// The line of the error that a call ends with.
template <class Wrong, class Call>
std::string line_of(const Call& call) {
  const std::string said = test::refusal<Wrong>(call);
  EXPECT_NE(said, "") << "nothing was thrown";
  return said;
}

TEST(Solve, TheShortestCallAnswersAsTheFileSays) {
  const Answer answer = solve(example("poly-easy.scene"));
  EXPECT_EQ(answer.outcome, Outcome::solved);
  EXPECT_TRUE(answer.verified);
  EXPECT_EQ(answer.planner, "rrt-connect") << "its robot turns";
  EXPECT_GE(answer.states.size(), 2U);
  EXPECT_GT(answer.length, 0.0);
}

TEST(Solve, APointAmongPolygonsTakesTheShortestPath) {
  const Answer answer = solve(example("town.geojson"), {.start = {1.5, 1.5}, .goal = {9.5, 8.5}});
  EXPECT_TRUE(answer.verified);
  EXPECT_TRUE(answer.optimal);
  EXPECT_EQ(answer.planner, "visibility");
}

TEST(Solve, ABodyMayBeAsSmallAsNumbersAre) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {10, 10}};
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{2, 2}, {2, 8}}, {{4, 3}, {9, 3}}});
  for (const std::uint64_t tiny : test::seeds(2, 1, 0)) {
    const double size = std::array{1e-90, 1e-10}[tiny];
    const RobotSpec robot{.kind = RobotKind::polygon, .outline = {{0, 0}, {size, 0}, {0, size}}};
    SolveOptions options{.planner = PlannerKind::prm};
    options.roadmap.samples = 100;
    EXPECT_TRUE(solve(scene, {.robot = robot, .start = {1, 1, 0}, .goal = {9, 9}}, options).verified) << size;
  }
}

TEST(Solve, AnyNumberOfThreadsGivesTheSameAnswer) {
  const Scene maze = read_world("maze:61x61,seed=3");
  const Answer one = solve(maze, {}, {.optimise = true}, {.threads = 1});
  ASSERT_TRUE(one.verified);
  for (const unsigned threads : {2U, 7U}) {
    const Answer other = solve(maze, {}, {.optimise = true}, {.threads = threads});
    EXPECT_EQ(one.path, other.path);
    EXPECT_EQ(one.length, other.length);
    EXPECT_EQ(other.threads, threads);
  }
}

TEST(Solve, TheQuestionGoesBeforeTheFile) {
  const Scene scene = example("walls.scene");  // with a robot, a start and a goal of its own
  const RobotSpec disc{.kind = RobotKind::disc, .radius = 10.0};
  const Answer there = solve(scene, {.robot = disc, .start = {50, 250}, .goal = {700, 250}, .clearance = 1.0});
  ASSERT_TRUE(there.verified);
  EXPECT_EQ(there.problem.robot.kind, RobotKind::disc);
  EXPECT_EQ(there.problem.start, (std::vector<double>{50, 250}));
  EXPECT_EQ(there.problem.clearance, 1.0);
  EXPECT_GE(there.min_clearance, 1.0) << "around the disc";
  EXPECT_EQ(verify(scene, there).min_clearance, there.min_clearance);
}

TEST(Solve, NoPathIsAnAnswerWithItsCause) {
  Scene scene;
  scene.walls = WallSet::narrowest(std::array{Segment{{5, 0}, {5, 10}}});
  scene.bounds = Box{{0, 0}, {10, 10}};
  const Question question{.start = {1, 5}, .goal = {9, 5}};
  const Answer proved = solve(scene, question, {.planner = PlannerKind::visibility});
  EXPECT_EQ(proved.outcome, Outcome::infeasible);
  EXPECT_TRUE(proved.path.empty());
  const Answer tried = solve(scene, question, {.planner = PlannerKind::prm, .roadmap = {.samples = 100}});
  EXPECT_EQ(tried.outcome, Outcome::not_connected);
  EXPECT_FALSE(tried.verified);
  EXPECT_EQ(tried.length, 0.0);
  const Figure* cause = figure_named(tried.figures, "cause");
  ASSERT_NE(cause, nullptr);
  EXPECT_EQ(std::get<std::string>(*cause), "different_components");
  const Answer blocked = solve(scene, {.start = {5, 5}, .goal = {9, 5}, .contact = Contact::blocked});
  EXPECT_EQ(blocked.outcome, Outcome::start_blocked);
}

TEST(Solve, AGoalWithoutHeadingMayBeReachedWithAny) {
  const Scene scene = example("walls.scene");
  for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::lazy_prm, PlannerKind::rrt_connect}) {
    const Answer answer = solve(scene, {}, {.planner = planner, .seed = 2});
    ASSERT_TRUE(answer.verified) << name_of(planner);
    const auto last = answer.states[answer.states.size() - 1];
    EXPECT_EQ(last[0], 750.0);
    EXPECT_EQ(last[1], 50.0);
    EXPECT_TRUE(verify(scene, answer).verified) << name_of(planner);
  }
}

std::uint64_t cusps_of(const Answer& answer) {
  return std::get<std::uint64_t>(*figure_named(answer.path_figures, "cusps"));
}

TEST(Solve, PricesOfDrivingAreWeighedAgainstLength) {
  const Scene street = example("parking-lot.scene");
  const auto driven = [&](double cusp, double reverse) {
    return solve(street, {}, {.optimise = true, .car = {.cusp_cost = cusp, .reverse_cost = reverse}});
  };
  const Answer shortest = driven(0.0, 1.0);
  const Answer steady = driven(10.0, 1.0);
  EXPECT_LT(cusps_of(steady), cusps_of(shortest));
  EXPECT_LE(steady.length + 10.0 * static_cast<double>(cusps_of(steady)),
            shortest.length + 10.0 * static_cast<double>(cusps_of(shortest)));
  EXPECT_THROW(solve(street, {}, {.car = {.cusp_cost = 1.0}}), UsageError) << "nothing is optimised";
  EXPECT_THROW(driven(1.0, 0.5), UsageError);
  EXPECT_THROW(solve(example("car-20.scene"), {}, {.optimise = true, .car = {.reverse_cost = 2.0}}), UsageError)
      << "it never drives backwards";
}

TEST(Solve, RefusesByNameWhatThePlannerWouldIgnore) {
  const Scene scene = example("poly-easy.scene");
  const SolveOptions options{.planner = PlannerKind::visibility, .trees = {.goal_bias = 0.5}};
  const std::string line = line_of<UsageError>([&] { solve(scene, {}, options); });
  EXPECT_NE(line.find("goal_bias"), std::string::npos) << line;
  EXPECT_NE(line.find("rrt"), std::string::npos) << line;
}

TEST(Solve, RefusesValuesOutsideTheirRanges) {
  const Scene scene = example("poly-easy.scene");
  const auto refused = [&](const Question& question, const SolveOptions& options, const Limits& limits) {
    return line_of<UsageError>([&] { solve(scene, question, options, limits); });
  };
  EXPECT_EQ(refused({.clearance = -1.0}, {}, {}).substr(0, 9), "clearance");
  EXPECT_EQ(refused({.start = {1.0}}, {}, {}).substr(0, 5), "start");
  EXPECT_EQ(refused({}, {.roadmap = {.samples = 0}}, {}).substr(0, 7), "samples");
  EXPECT_EQ(refused({}, {.trees = {.step = 0.0}}, {}).substr(0, 4), "step");
  EXPECT_EQ(refused({}, {}, {.threads = 1025}).substr(0, 7), "threads");
  EXPECT_EQ(refused({}, {}, {.budget = 0s}).substr(0, 6), "budget");
}

TEST(Solve, WhatItThrowsHasOneBase) {
  const Scene scene = example("poly-easy.scene");
  EXPECT_THROW(solve(scene, {.clearance = -1.0}), Error);
  EXPECT_THROW(read_world("no such file"), Error);
  EXPECT_THROW(Deadline(0.0).check(), Error);
}

TEST(Limits, ABudgetThatEndsIsAnAnswerThatClaimsNothing) {
  const Scene maze = read_world("maze:2000x2000");
  const Answer answer = solve(maze, {}, {.sampler = SamplerKind::uniform}, {.threads = 1, .budget = 20ms});
  EXPECT_EQ(answer.outcome, Outcome::stopped);
  EXPECT_EQ(answer.stop_reason, StopReason::time);
  EXPECT_FALSE(answer.verified);
  EXPECT_EQ(answer.length, 0.0);
  EXPECT_TRUE(answer.path.empty());
}

TEST(Limits, SoIsAFlagThatIsSet) {
  const SignalFlag cancel{SIGINT};
  const Answer answer = solve(read_world("maze:61x61"), {}, {}, {.cancel = &cancel});
  EXPECT_EQ(answer.outcome, Outcome::stopped);
  EXPECT_TRUE(answer.path.empty());
}

TEST(Limits, AndMemoryThatIsTooLittle) {
  const Answer answer = solve(read_world("maze:2000x2000"), {}, {}, {.memory = std::size_t{1} << 20});
  EXPECT_EQ(answer.outcome, Outcome::stopped);
  EXPECT_EQ(answer.stop_reason, StopReason::memory);
}

TEST(Limits, ProgressIsToldWhileItGoesOn) {
  const Scene maze = read_world("maze:1500x1500");
  std::atomic<int> calls = 0;
  const auto begin = std::chrono::steady_clock::now();
  const Limits limits{.threads = 1, .budget = 2s, .progress = [&](const ProgressReport& report) {
                        calls += report.stage.empty() ? 0 : 1;
                      }};
  solve(maze, {}, {.sampler = SamplerKind::uniform}, limits);
  const int told = calls;
  EXPECT_GE(told, 1);
  EXPECT_LE(told, (std::chrono::steady_clock::now() - begin) / 100ms + 1);
}

TEST(Verify, AgreesWithSolveAndRefutesWhatWasChanged) {
  const Scene scene = example("town.geojson");
  Answer answer = solve(scene, {.start = {1.5, 1.5}, .goal = {9.5, 8.5}});
  const Verdict verdict = verify(scene, answer);
  EXPECT_TRUE(verdict.verified);
  EXPECT_EQ(verdict.length, answer.length);
  EXPECT_EQ(verdict.problem.start, answer.problem.start);

  Answer longer = answer;
  longer.length *= 1.01;
  EXPECT_FALSE(verify(scene, longer).verified) << "the length is a part of the claim";

  answer.path = {answer.path.front(), answer.path.back()};
  const Verdict refuted = verify(scene, answer);
  EXPECT_FALSE(refuted.verified);
  ASSERT_TRUE(refuted.first_violation.has_value());
  EXPECT_EQ(refuted.first_violation->leg, 0U);
}

TEST(Verify, AnAnswerWithoutAPathIsRefused) {
  const Scene scene = example("town.geojson");
  Answer answer;
  answer.problem = solve(scene, {.start = {1.5, 1.5}, .goal = {9.5, 8.5}}).problem;
  EXPECT_THROW(verify(scene, answer), InputError);
}

TEST(Verify, AnotherWorldIsRefused) {
  const Answer answer = solve(read_world("maze:21x21,seed=1"));
  EXPECT_THROW(verify(read_world("maze:21x21,seed=2"), answer), InputError);
}

TEST(ByProducts, AreKeptForWhoAsks) {
  ByProducts made;
  const Answer answer = solve(read_world("maze:21x21,seed=1"), {}, {.planner = PlannerKind::prm}, {}, &made);
  ASSERT_TRUE(answer.verified);
  EXPECT_EQ(made.roadmap.states.size(), answer.roadmap.milestones);
}

}  // namespace
}  // namespace warren
