// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "planners/shorten/shortcut.hpp"
#include "tests/planners/trees/sampled_problems.hpp"

namespace warren {
namespace {

namespace problems = sampled_problems;

/// Free, from end to end, no longer, and the same whatever the threads.
template <class W>
double share_left(const problems::SampledProblem<W>& problem, std::uint64_t seed) {
  const auto length = [&](const auto& a, const auto& b) { return problem.world.distance(a, b); };
  const auto found = rrt_connect(problem.view, problem.start, std::span(&problem.goal, 1), {.seed = seed}, {});
  EXPECT_EQ(found.outcome, Outcome::solved);
  Path<typename W::State> first;
  Counters first_counters;
  for (const unsigned threads : {1U, 2U, 8U}) {
    Counters counters;
    const auto path = improve_path(problem.view, found.path, length, {.seed = seed}, {.threads = threads}, counters);
    if (threads == 1) {
      first = path;
      first_counters = counters;
    }
    EXPECT_EQ(path, first) << threads;
    EXPECT_EQ(counters, first_counters) << threads;
  }
  EXPECT_EQ(first.front(), problem.start);
  EXPECT_EQ(first.back(), problem.goal);
  EXPECT_TRUE(problem.is_free(first));
  EXPECT_GT(first_counters.edges_checked, 0U);
  const double share = problem.length(first) / problem.length(found.path);
  EXPECT_LE(share, 1.0 + 1e-12);
  return share;
}

TEST(ImprovePath, MakesPathsShorterInEveryWorldAndTheSameForAnyNumberOfThreads) {
  std::vector<double> shares(5, 0.0);
  constexpr std::uint64_t seeds = 6;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    shares[0] += share_left(problems::point(true), seed) / seeds;
    shares[1] += share_left(problems::body(seed), seed) / seeds;
    shares[2] += share_left(problems::car<CarWorld<DubinsCurve>>(), seed) / seeds;
    shares[3] += share_left(problems::car<CarWorld<ReedsSheppCurve>>(), seed) / seeds;
    shares[4] += share_left(problems::arm(), seed) / seeds;
  }
  for (const double share : shares) EXPECT_LT(share, 0.95);
}

TEST(ImprovePath, ApproachesTheShortestAroundACornerAndKeepsFewStates) {
  const auto problem = problems::point(true);
  const Path<Vec2> path = {{2, 1}, {1, 9}, {4, 6}, {5, 9}, {9, 9}, {8, 1}};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Counters counters;
    const auto shorter = improve_path(problem.view, path, MazeWorld::distance,
                                      {.seed = seed, .worth = 1e-4, .patience = 10}, {}, counters);
    EXPECT_LE(problem.length(shorter), 10.0 * 1.02) << seed;
    EXPECT_GE(problem.length(shorter), 10.0);
    EXPECT_LE(shorter.size(), 8U);
  }
}

TEST(ImprovePath, LeavesWhatCanNotBeShorter) {
  const auto problem = problems::point(false);
  const Path<Vec2> straight = {{2, 1}, {8, 1}};
  const Path<Vec2> in_pieces = {{2, 1}, {3, 1}, {5, 1}, {8, 1}};
  Counters counters;
  EXPECT_EQ(improve_path(problem.view, straight, MazeWorld::distance, {}, {}, counters), straight);
  EXPECT_EQ(improve_path(problem.view, in_pieces, MazeWorld::distance, {}, {}, counters), straight);
  const Path<Vec2> one = {{2, 1}};
  EXPECT_EQ(improve_path(problem.view, one, MazeWorld::distance, {}, {}, counters), one);
  const Deadline past(1e-9);
  EXPECT_THROW(improve_path(problem.view, in_pieces, MazeWorld::distance, {}, {.deadline = &past}, counters), Stopped);
}

/// Three joints of [0, 1]; a wall between 0.4 and 0.6 of the first, whose gate is above 0.8 of the second.
struct Gate {
  static constexpr std::size_t dimension = 3;
  using State = std::array<double, 3>;
  struct Query {};
  static Query make_query() { return {}; }
  static State at_unit(const std::array<double, 3>& u) { return u; }
  static std::size_t unit_dimension() { return dimension; }
  static bool is_free(const State& a, Query&) { return std::abs(a[0] - 0.5) > 0.1 || a[1] > 0.8; }
  static bool is_free_motion(const State& a, const State& b, Query& query) {
    for (int i = 0; i <= 100; ++i) {
      if (!is_free(interpolate(a, b, 0.01 * i), query)) return false;
    }
    return true;
  }
  static double distance(const State& a, const State& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
  static State interpolate(const State& a, const State& b, double t) {
    State c = a;
    for (std::size_t i = 0; i < dimension; ++i) c[i] += t * (b[i] - a[i]);
    return c;
  }
  static State embed(const State& a) { return a; }
};

TEST(ImprovePath, JointsThatTurnForNothingGoEvenlyAfterARound) {
  const Path<Gate::State> path = {{0, 0, 0}, {0.3, 0.85, 1}, {0.5, 0.95, 0}, {0.7, 0.85, 1}, {1, 0, 0.5}};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Counters counters;
    const auto shorter = improve_path(Gate{}, path, Gate::distance, {.seed = seed, .worth = 0.99}, {}, counters);
    const double whole = path_length(shorter, Gate::distance);
    EXPECT_LT(whole, 2.3) << seed;
    double along = 0.0;
    for (std::size_t i = 1; i + 1 < shorter.size(); ++i) {
      along += Gate::distance(shorter[i - 1], shorter[i]);
      EXPECT_NEAR(shorter[i][2], 0.5 * along / whole, 0.1) << seed;
    }
  }
}

}  // namespace
}  // namespace warren
