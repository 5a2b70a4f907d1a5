// SPDX-License-Identifier: BSD-3-Clause
#include "planners/anytime/anytime.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tests/planners/trees/sampled_problems.hpp"

namespace warren {
namespace {

using sampled_problems::SampledProblem;

template <class W>
AnytimeBody<typename W::State> body_of(const SampledProblem<W>& problem) {
  using State = typename W::State;
  const auto cost = [&problem](const State& a, const State& b) { return problem.world.distance(a, b); };
  AnytimeBody<State> body;
  body.shortened = [&problem, cost](const Path<State>& path, double hopeless, std::uint64_t seed, const Execution& on,
                                    Counters& counters) {
    return improve_path(problem.view, path, cost, {.seed = seed, .hopeless = hopeless}, on, counters);
  };
  body.length = [&problem](const Path<State>& path) { return problem.length(path); };
  body.judged_s = [](const Path<State>&) { return 0.0; };
  return body;
}

template <class W>
AnytimeSolution<typename W::State> plan(const SampledProblem<W>& problem, const AnytimeOptions& options,
                                        const Execution& execution = {}) {
  return anytime(problem.view, problem.start, std::span(&problem.goal, 1), options, body_of(problem), execution);
}

AnytimeOptions turns(std::uint64_t iterations) {
  AnytimeOptions options;
  options.iterations = iterations;
  return options;
}

/// All that is no time.
template <class State>
void expect_same(const AnytimeSolution<State>& a, const AnytimeSolution<State>& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.ended_by, b.ended_by);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_TRUE(std::equal(a.path.begin(), a.path.end(), b.path.begin(), b.path.end()));
  EXPECT_EQ(a.counters, b.counters);
  ASSERT_EQ(a.improvements.size(), b.improvements.size());
  for (std::size_t i = 0; i < a.improvements.size(); ++i) {
    EXPECT_EQ(a.improvements[i].iterations, b.improvements[i].iterations);
    EXPECT_EQ(a.improvements[i].cost, b.improvements[i].cost);
    EXPECT_EQ(a.improvements[i].by, b.improvements[i].by);
  }
}

template <class W>
void expect_honest(const SampledProblem<W>& problem, const AnytimeSolution<typename W::State>& found) {
  ASSERT_EQ(found.outcome, Outcome::solved);
  ASSERT_FALSE(found.path.empty());
  EXPECT_TRUE(found.path.front() == problem.start);
  EXPECT_TRUE(found.path.back() == problem.goal);
  EXPECT_TRUE(problem.is_free(found.path));
  EXPECT_DOUBLE_EQ(found.cost, problem.length(found.path));
  ASSERT_FALSE(found.improvements.empty());
  EXPECT_EQ(found.improvements.back().cost, found.cost);
  for (std::size_t i = 1; i < found.improvements.size(); ++i) {
    EXPECT_LT(found.improvements[i].cost, found.improvements[i - 1].cost);
    EXPECT_GE(found.improvements[i].iterations, found.improvements[i - 1].iterations);
  }
}

template <class W>
void expect_same_for_any_threads(const SampledProblem<W>& problem, std::uint64_t iterations) {
  const auto alone = plan(problem, turns(iterations), {.threads = 1});
  expect_honest(problem, alone);
  for (const unsigned threads : {2U, 3U, 8U}) {
    SCOPED_TRACE(threads);
    expect_same(plan(problem, turns(iterations), {.threads = threads}), alone);
  }
}

TEST(Anytime, IsTheSameForAnyThreadsInEveryKindOfWorld) {
  expect_same_for_any_threads(sampled_problems::body(3), 12);
  expect_same_for_any_threads(sampled_problems::car<CarWorld<DubinsCurve>>(), 10);
  expect_same_for_any_threads(sampled_problems::car<CarWorld<ReedsSheppCurve>>(), 10);
  expect_same_for_any_threads(sampled_problems::arm(), 10);
}

TEST(Anytime, MemoryForTheJudgeIsKeptBackOnceThereIsAPath) {
  const auto problem = sampled_problems::body(3);
  AnytimeBody<Se2> body = body_of(problem);
  body.judge_bytes = std::size_t{1} << 40U;  // more than there is: what is found first is the answer
  std::optional<AnytimeSolution<Se2>> alone;
  for (const unsigned threads : {1U, 2U, 8U}) {
    SCOPED_TRACE(threads);
    const Deadline all(std::numeric_limits<double>::infinity(), resident_bytes() + (std::size_t{1} << 32U));
    const auto found = anytime(problem.view, problem.start, std::span(&problem.goal, 1), turns(1000), body,
                               {.threads = threads, .deadline = &all});
    expect_honest(problem, found);
    EXPECT_EQ(found.ended_by, "memory");
    if (!alone) alone = found;
    EXPECT_EQ(found.iterations, alone->iterations);
    EXPECT_EQ(found.cost, alone->cost);
  }
}

/// Roadmap and trees grow side by side: what one is granted does not depend on what the others hold at that moment.
TEST(Anytime, MemoryEndsTheSameTurnForAnyThreads) {
  const auto problem = sampled_problems::body(3);
  const Deadline all(std::numeric_limits<double>::infinity(), resident_bytes() + (std::size_t{1} << 32U));
  for (const std::size_t bytes : {std::size_t{1} << 18U, std::size_t{1} << 20U, std::size_t{3} << 20U}) {
    std::optional<AnytimeSolution<Se2>> alone;
    for (const unsigned threads : {1U, 2U, 8U}) {
      SCOPED_TRACE(std::to_string(bytes) + " bytes, threads " + std::to_string(threads));
      const Deadline counted(&all, CountedRoom{bytes});
      const auto found = plan(problem, turns(1'000'000), {.threads = threads, .deadline = &counted});
      EXPECT_EQ(found.ended_by, "memory");
      if (!alone) alone = found;
      expect_same(found, *alone);
    }
  }
}

TEST(Anytime, AStraightWayIsTheBestAtOnce) {
  auto problem = sampled_problems::body(1);
  problem.goal = {problem.start.x, problem.start.y, problem.start.theta + 1e-3};
  const auto found = plan(problem, turns(5));
  expect_honest(problem, found);
  EXPECT_EQ(found.ended_by, "optimum");
  EXPECT_EQ(found.iterations, 1U);
  EXPECT_EQ(found.improvements.front().by, "straight");
}

TEST(Anytime, AStraightWayToOneOfMoreGoalsIsNotTheEnd) {
  auto problem = sampled_problems::body(1);
  problem.goal = {problem.start.x, problem.start.y, problem.start.theta + 1e-3};
  AnytimeOptions options = turns(3);
  options.all_goals = false;
  const auto found = plan(problem, options);
  expect_honest(problem, found);
  EXPECT_EQ(found.ended_by, "iterations");
  EXPECT_EQ(found.iterations, 3U);
}

TEST(Anytime, EndsWhereTheCostIsNearTheBound) {
  const auto problem = sampled_problems::body(3);
  const auto best = plan(problem, turns(12));
  AnytimeOptions options = turns(1000);
  options.lower_bound = best.cost / 1.2;
  options.gap = 0.25;
  const auto found = plan(problem, options);
  expect_honest(problem, found);
  EXPECT_EQ(found.ended_by, "gap");
  EXPECT_LE(found.cost, 1.25 * options.lower_bound);
  EXPECT_LE(found.iterations, 12U);
}

TEST(Anytime, EachPartFindsAWayByItself) {
  const auto problem = sampled_problems::body(3);
  for (int part = 0; part < 3; ++part) {
    SCOPED_TRACE(part);
    AnytimeOptions options = turns(12);
    options.parts = {.tree = part == 0, .restarts = part == 1, .roadmap = part == 2, .shorten = false};
    expect_honest(problem, plan(problem, options));
  }
  AnytimeOptions textbook = turns(12);
  textbook.parts = {.tree = true, .restarts = false, .roadmap = false, .shorten = false};
  textbook.informed = false;
  expect_honest(problem, plan(problem, textbook));
}

/// A stop that comes with the k-th improvement: the answer is that of the whole turns before.
TEST(Anytime, AStopKeepsThePathAndAsManyTurnsRepeatIt) {
  const auto problem = sampled_problems::car<CarWorld<ReedsSheppCurve>>();
  for (int k = 1; k < 6; ++k) {
    SCOPED_TRACE(k);
    SignalFlag signal{0};
    const Deadline deadline(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &signal);
    int seen = 0;
    const std::function<bool(const Improvement&)> told = [&](const Improvement&) {
      if (++seen == k) signal = 2;
      return true;
    };
    Execution execution{.threads = 2, .deadline = &deadline};
    execution.on_improvement = &told;
    auto stopped = plan(problem, {}, execution);
    expect_honest(problem, stopped);
    EXPECT_EQ(stopped.ended_by, "SIGINT");
    stopped.ended_by = "iterations";
    expect_same(stopped, plan(problem, turns(stopped.iterations)));
  }
}

TEST(Anytime, WhoIsToldMayHaveEnough) {
  const auto problem = sampled_problems::body(3);
  const std::function<bool(const Improvement&)> told = [](const Improvement&) { return false; };
  Execution execution;
  execution.on_improvement = &told;
  const auto found = plan(problem, turns(50), execution);
  expect_honest(problem, found);
  EXPECT_EQ(found.ended_by, "caller");
}

/// Though a turn may find several better paths.
TEST(Anytime, WhoHasEnoughIsNotToldAgain) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const auto problem = sampled_problems::body(seed);
    for (const std::size_t most : {1, 2, 3, 4}) {
      std::size_t told = 0;
      const std::function<bool(const Improvement&)> tell = [&](const Improvement&) { return ++told < most; };
      Execution execution;
      execution.on_improvement = &tell;
      const auto found = plan(problem, turns(30), execution);
      EXPECT_LE(told, most);
      EXPECT_EQ(found.improvements.size(), told);
    }
  }
}

TEST(Anytime, WithoutAWayItSaysThatNoneWasFound) {
  auto problem = sampled_problems::car<CarWorld<ReedsSheppCurve>>();
  Scene shut;
  shut.bounds = Box{{0, 0}, {12, 6}};
  shut.walls = WallSet::narrowest(std::vector<Segment>{{{6, 0}, {6, 6}}});
  const SampledProblem<CarWorld<ReedsSheppCurve>> apart{
      CarWorld<ReedsSheppCurve>(shut, {.turning_radius = 0.7, .radius = 0.2}), problem.start, problem.goal};
  const auto found = plan(apart, turns(4));
  EXPECT_EQ(found.outcome, Outcome::not_connected);
  EXPECT_EQ(found.ended_by, "iterations");
  EXPECT_TRUE(found.path.empty());
  const Deadline soon(0.05);
  Execution execution;
  execution.deadline = &soon;
  EXPECT_EQ(plan(apart, {}, execution).outcome, Outcome::stopped);
}

TEST(Anytime, EachPathIsKeptBeforeItIsTold) {
  const auto problem = sampled_problems::body(3);
  auto body = body_of(problem);
  std::vector<double> kept;
  body.kept = [&](const Path<Se2>& path) { kept.push_back(problem.length(path)); };
  std::vector<double> told;
  const std::function<bool(const Improvement&)> tell = [&](const Improvement& improvement) {
    told.push_back(improvement.cost);
    return kept == told;
  };
  Execution execution;
  execution.on_improvement = &tell;
  const auto found = anytime(problem.view, problem.start, std::span(&problem.goal, 1), turns(12), body, execution);
  EXPECT_EQ(found.ended_by, "iterations");
  EXPECT_EQ(kept, told);
}

}  // namespace
}  // namespace warren
