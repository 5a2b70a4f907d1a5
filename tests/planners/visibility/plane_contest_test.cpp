// SPDX-License-Identifier: BSD-3-Clause
// Everybody who claims the shortest path finds it, by exact rationals, in worlds as strangers make them; the long form
// is tools/campaign. And the worlds in which somebody once did not.
#include "tests/planners/visibility/plane_contest.hpp"

#include <gtest/gtest.h>

namespace warren {
namespace {

using test::ContestTally;
using test::disagreement;
using test::PlaneProblem;
using test::scene_text;
using test::StrangeWorlds;

TEST(PlaneContest, AllFindTheShortestPathOfStrangeWorlds) {
  ContestTally tally;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const PlaneProblem problem = StrangeWorlds(seed).make();
    EXPECT_EQ(disagreement(problem, tally), "") << scene_text(test::smallest_disagreement(problem));
  }
  EXPECT_GT(tally.solved, 100);
  EXPECT_GT(tally.bent, 30);
  EXPECT_GT(tally.apart, 10);
  EXPECT_GT(tally.blocked, 10);
  EXPECT_GT(tally.refused, 10) << "by cells, since obstacles overlap";
  EXPECT_LT(tally.refused, 100) << "else cells compete too seldom";
}

struct WorldOnceLost {
  const char* name;
  std::vector<std::vector<Vec2>> polygons;
  std::vector<Segment> walls;
  std::optional<Box> bounds;
  Vec2 start, goal;
};
const WorldOnceLost worlds_once_lost[] = {
    {"walls that share an end, in sight of which the way turns back",
     {},
     {{{1, 3}, {2, 5}}, {{2, 2}, {2, 5}}},
     Box{{0, 0}, {8, 8}},
     {1.5, 3.75},
     {3, 5}},
    {"start in a polygon and goal out of the obstacles' box",
     {{{0, 0}, {6, 0}, {0, 4}}},
     {},
     std::nullopt,
     {1, 1},
     {-6, 4}},
};

TEST(PlaneContest, AllFindTheShortestPathWhereSomebodyOnceDidNot) {
  for (const WorldOnceLost& c : worlds_once_lost) {
    SCOPED_TRACE(c.name);
    PlaneProblem problem{{{}, c.walls, c.bounds}, c.start, c.goal};
    for (const auto& ring : c.polygons) problem.obstacles.polygons.add(ring);
    ContestTally tally;
    EXPECT_EQ(disagreement(problem, tally), "");
  }
}

TEST(PlaneContest, MakesAWorldThatSomebodyFailsInAsSmallAsItStaysWrong) {
  // A polygon that runs clockwise is no valid input: its outside counts as inside.
  PlaneProblem problem{{{}, {{{8, 8}, {9, 9}}, {{7, 1}, {7, 2}}}, Box{{0, 0}, {12, 12}}}, {1, 5}, {11, 5}};
  problem.obstacles.polygons.add(std::vector<Vec2>{{4, 2}, {4, 8}, {8, 8}, {8, 2}});
  ContestTally tally;
  ASSERT_NE(disagreement(problem, tally), "");
  const PlaneProblem small = test::smallest_disagreement(problem);
  EXPECT_NE(disagreement(small, tally), "");
  EXPECT_TRUE(small.obstacles.walls.empty());
  EXPECT_FALSE(small.obstacles.bounds);
}

}  // namespace
}  // namespace warren
