// SPDX-License-Identifier: BSD-3-Clause
#include "planners/trees/rrt_star.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/planners/trees/sampled_problems.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

namespace problems = sampled_problems;
using problems::SampledProblem;

constexpr double no_cost = std::numeric_limits<double>::infinity();

template <class W>
RrtStarTree<AnyWorldOf<W>> star_of(const SampledProblem<W>& problem, const RrtStarOptions& options) {
  RrtStarOptions with_step = options;
  if (with_step.step == 0.0) with_step.step = usual_step(problem.world);
  return RrtStarTree<AnyWorldOf<W>>(problem.view, problem.start, std::span(&problem.goal, 1), with_step);
}

template <class W>
RrtStarTree<AnyWorldOf<W>> star_of(const SampledProblem<W>&&,
                                   const RrtStarOptions&) = delete;  // it refers to the world

/// Every cost is that of the parent and the motion from it, and the world lets it be made.
template <class W>
void expect_right_costs(const SampledProblem<W>& problem, const MotionTree<AnyWorldOf<W>>& tree) {
  auto query = problem.world.make_query();
  std::size_t wrong = 0;
  std::size_t refused = 0;
  for (VertexId v = 1; v < tree.size(); ++v) {
    const VertexId parent = tree.parent(v);
    ASSERT_LT(parent, tree.size());
    const double length = problem.world.distance(tree.state(parent), tree.state(v));
    wrong += tree.cost(v) == tree.cost(parent) + length ? 0 : 1;
    refused += problem.world.is_free_motion(tree.state(parent), tree.state(v), query) ? 0 : 1;
    ASSERT_LE(tree.way_to_root(v).size(), tree.size());
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(refused, 0U);
}

template <class W>
void expect_a_path_that_gets_shorter(const SampledProblem<W>& problem, const RrtStarOptions& options) {
  RrtStarTree<AnyWorldOf<W>> star = star_of(problem, options);
  Path<typename W::State> best;
  double least = no_cost;
  for (int slice = 0; slice < 60; ++slice) {
    star.advance(500, least, best, {});
    ASSERT_LE(star.cost(), least);
    if (star.cost() == no_cost) continue;
    least = star.cost();
    best = star.path();
    EXPECT_EQ(best.front(), problem.start);
    EXPECT_EQ(best.back(), problem.goal);
    EXPECT_NEAR(problem.length(best), least, 1e-9 * least);
    EXPECT_GE(least, problem.world.distance(problem.start, problem.goal) * (1.0 - 1e-12));
  }
  EXPECT_LT(least, no_cost);
  EXPECT_TRUE(problem.is_free(best));
  EXPECT_GE(star.work(), 60U * 500U);
  expect_right_costs(problem, star.tree());
}

TEST(RrtStar, CostsAreThoseOfTheMotionsAndNeverRiseInEveryWorld) {
  for (const bool informed : {false, true}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " informed " << informed);
      const RrtStarOptions options{.seed = seed, .informed = informed};
      expect_a_path_that_gets_shorter(problems::point(true), options);
      expect_a_path_that_gets_shorter(problems::body(seed), options);
      expect_a_path_that_gets_shorter(problems::car<CarWorld<DubinsCurve>>(), options);
      expect_a_path_that_gets_shorter(problems::car<CarWorld<ReedsSheppCurve>>(), options);
      expect_a_path_that_gets_shorter(problems::arm(), options);
    }
  }
}

/// After so many samples, in slices, with its own path as its guide.
double cost_after(const SampledProblem<MazeWorld>& problem, std::uint64_t samples, const RrtStarOptions& options) {
  RrtStarTree<AnyWorld<Vec2>> star = star_of(problem, options);
  while (star.counters().samples < samples) star.advance(500, star.cost(), star.path(), {});
  return star.cost();
}

TEST(RrtStar, ApproachesTheShortestPath) {
  const SampledProblem<MazeWorld> in_the_open = problems::point(false);
  const SampledProblem<MazeWorld> around_a_wall = problems::point(true);
  for (const bool informed : {false, true}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " informed " << informed);
      const RrtStarOptions options{.seed = seed, .step = 1.0, .informed = informed};
      const double most = informed ? 1.02 : 1.03;
      const std::uint64_t samples = informed ? 2'500 : 6'000;
      const double open = cost_after(in_the_open, samples, options);
      EXPECT_GE(open, 6.0 - 1e-12);
      EXPECT_LE(open, 6.0 * most);
      const double wall = cost_after(around_a_wall, samples, options);
      EXPECT_GE(wall, 10.0);
      EXPECT_LE(wall, 10.0 * most);
    }
  }
}

TEST(RrtStar, IsTheSameTwiceAndInSlices) {
  const SampledProblem<Se2World> problem = problems::body(2);
  RrtStarTree<AnyWorld<Se2>> once = star_of(problem, {.seed = 5});
  RrtStarTree<AnyWorld<Se2>> twice = star_of(problem, {.seed = 5});
  once.advance(9000, no_cost, {}, {});
  while (twice.work() < once.work()) twice.advance(1, no_cost, {}, {});
  EXPECT_EQ(once.path(), twice.path());
  EXPECT_EQ(once.counters(), twice.counters());
  EXPECT_EQ(once.size(), twice.size());
  RrtStarTree<AnyWorld<Se2>> other = star_of(problem, {.seed = 6});
  other.advance(9000, no_cost, {}, {});
  EXPECT_NE(once.path(), other.path());
}

TEST(RrtStar, TakesAPathWithTheCostsThatItHas) {
  const SampledProblem<MazeWorld> problem = problems::point(true);
  const Path<Vec2> around = {{2, 1}, {4, 6}, {6, 6}, {8, 1}};
  const Path<Vec2> nearer = {{2, 1}, {4, 5.5}, {5, 5.1}, {6, 5.5}, {8, 1}};
  RrtStarTree<AnyWorld<Vec2>> star = star_of(problem, {});
  star.take({{3, 1}, {8, 1}}, {});  // not from the start
  EXPECT_EQ(star.size(), 1U);
  star.take(around, {});
  EXPECT_EQ(star.path(), around);
  EXPECT_DOUBLE_EQ(star.cost(), problem.length(around));
  star.take(nearer, {});
  EXPECT_EQ(star.path(), nearer);
  star.take(around, {});  // costs more: nothing changes
  EXPECT_EQ(star.path(), nearer);
  EXPECT_EQ(star.size(), 1U + 3U + 3U);
  star.advance(3000, star.cost(), star.path(), {});
  EXPECT_LT(star.cost(), problem.length(nearer));
  expect_right_costs(problem, star.tree());

  // What hangs on a state that gets cheaper gets cheaper, too.
  RrtStarTree<AnyWorld<Vec2>> detour = star_of(problem, {});
  detour.take({{2, 1}, {1, 9}, {4, 6}, {6, 6}, {8, 1}}, {});
  detour.take({{2, 1}, {4, 6}}, {});
  EXPECT_EQ(detour.path(), around);
  EXPECT_DOUBLE_EQ(detour.cost(), problem.length(around));
}

TEST(RrtStar, AddsNothingThroughWhichNoPathIsCheaper) {
  const SampledProblem<MazeWorld> problem = problems::point(true);
  RrtStarTree<AnyWorld<Vec2>> star = star_of(problem, {.seed = 3});
  star.advance(8000, 10.5, {}, {});
  EXPECT_GT(star.size(), 50U);
  for (VertexId v = 1; v < star.size(); ++v) {
    const Vec2 state = star.tree().state(v);
    EXPECT_LT(star.tree().cost(v) + distance(state, problem.goal), 10.5);
  }
  RrtStarTree<AnyWorld<Vec2>> none = star_of(problem, {.seed = 3});
  none.advance(4000, 5.9, {}, {});  // less than the straight way
  EXPECT_EQ(none.size(), 1U);
  EXPECT_GE(none.work(), 4000U);
}

TEST(RrtStar, GrowsNoMoreThanItMay) {
  const SampledProblem<MazeWorld> problem = problems::point(true);
  RrtStarTree<AnyWorld<Vec2>> star = star_of(problem, {.nodes = 100});
  star.advance(100'000, no_cost, {}, {});
  EXPECT_TRUE(star.is_full());
  EXPECT_LE(star.size(), 101U);  // a goal may come with the last
  EXPECT_LT(star.work(), 100'000U);
}

TEST(RrtStar, StartsAtAGoal) {
  SampledProblem<MazeWorld> problem = problems::point(true);
  problem.goal = problem.start;
  RrtStarTree<AnyWorld<Vec2>> star = star_of(problem, {});
  EXPECT_EQ(star.cost(), 0.0);
  EXPECT_EQ(star.path(), Path<Vec2>{problem.start});
  star.advance(100, 0.0, {}, {});
  EXPECT_EQ(star.size(), 1U);
}

TEST(RrtStar, StopsAtTheDeadline) {
  const SampledProblem<MazeWorld> problem = problems::point(true);
  RrtStarTree<AnyWorld<Vec2>> star = star_of(problem, {});
  const Deadline past(1e-9);
  EXPECT_THROW(star.advance(1000, no_cost, {}, {.deadline = &past}), Stopped);
}

template <class W>
void expect_bounded_paths(const SampledProblem<W>& problem, std::uint64_t first) {
  const RrtOptions options{.nodes = 5000, .seed = first};
  const double step = usual_step(problem.world);
  const std::span<const typename W::State> goals(&problem.goal, 1);
  double most = no_cost;
  int found = 0;
  for (std::uint64_t index = 1; index <= 8; ++index) {
    detail::RrtConnectSearch<AnyWorldOf<W>> search(problem.view, problem.start, goals, options, step, index);
    if (most < no_cost) search.bound(most);
    search.advance_by_work(20'000, {});
    if (!search.arrived()) continue;
    ++found;
    const Path<typename W::State> path = search.path();
    EXPECT_EQ(path.front(), problem.start);
    EXPECT_EQ(path.back(), problem.goal);
    EXPECT_TRUE(problem.is_free(path));
    EXPECT_NEAR(problem.length(path), search.cost(), 1e-9 * search.cost());
    EXPECT_LT(search.cost(), most);
    most = std::min(most, 0.97 * search.cost());
  }
  EXPECT_GE(found, 2);
}

TEST(RrtConnectBound, PathsAreCheaperThanIt) {
  for (const std::uint64_t seed : test::seeds(4)) {
    SCOPED_TRACE(seed);
    expect_bounded_paths(problems::point(true), seed);
    expect_bounded_paths(problems::body(seed), seed);
    expect_bounded_paths(problems::car<CarWorld<DubinsCurve>>(), seed);
    expect_bounded_paths(problems::car<CarWorld<ReedsSheppCurve>>(), seed);
    expect_bounded_paths(problems::arm(), seed);
  }
}

/// A finite one draws where a path within it may lead, however wide it is.
TEST(RrtConnectBound, AnInfiniteOneChangesNothing) {
  const SampledProblem<Se2World> problem = problems::body(3);
  const RrtOptions options{.places = false};
  const std::span<const Se2> goals(&problem.goal, 1);
  detail::RrtConnectSearch<AnyWorld<Se2>> plain(problem.view, problem.start, goals, options, 1.0, 3);
  detail::RrtConnectSearch<AnyWorld<Se2>> wide(problem.view, problem.start, goals, options, 1.0, 3);
  wide.bound(std::numeric_limits<double>::infinity());
  plain.advance(10'000, {});
  wide.advance_by_work(1'000'000, {});
  ASSERT_TRUE(plain.arrived());
  EXPECT_EQ(plain.path(), wide.path());
  EXPECT_EQ(plain.counters(), wide.counters());
}

}  // namespace
}  // namespace warren
