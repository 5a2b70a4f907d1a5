// SPDX-License-Identifier: BSD-3-Clause
// A roadmap that was built without a question answers as the planner does that builds one for each.
#include "planners/roadmap/ask_roadmap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scenes/mazes/maze_generator.hpp"
#include "solve/kinds/planned_worlds.hpp"
#include "tests/worlds/poses/body_scenes.hpp"
#include "worlds/plane/maze_world.hpp"
#include "worlds/poses/car_world.hpp"

namespace warren {
namespace {

Scene maze(double loops, std::uint32_t side = 12) {
  return maze_scene({side, side, 3, MazeAlgorithm::backtracker, loops}, false, {});
}

template <class State, bool one_way>
AskedRoadmap<AnyWorld<State, one_way>> asked(const AnyWorld<State, one_way>& world, const RoadmapOptions& options,
                                             bool lazy, unsigned threads = 2) {
  Execution execution;
  execution.threads = threads;
  BuiltRoadmap<State> built = build_roadmap(world, options, lazy, execution);
  return {world, std::move(built.states), std::move(built.candidates), built.edge_states, built.rule, lazy, execution};
}

template <World W>
Solution<typename W::State> planned(const W& world, const typename W::State& start, const typename W::State& goal,
                                    const RoadmapOptions& options, bool lazy) {
  if constexpr (W::one_way) {
    return one_way_prm(world, start, goal, options, lazy, {});
  } else {
    return lazy ? lazy_prm(world, start, goal, options, {}) : prm(world, start, goal, options, {});
  }
}

/// Asks about all pairs of the states; the counts of edges depend on what was known, all else does not. A large lazy
/// planner's search leaves dead ends of a maze out, which that of a kept roadmap doesn't know.
template <World W>
std::size_t expect_the_planners_answers(const W& world, const std::vector<typename W::State>& states,
                                        const RoadmapOptions& options, bool lazy) {
  const auto roadmap = asked(world, options, lazy);
  AskScratch scratch;
  std::size_t solved = 0;
  for (const auto& start : states) {
    for (const auto& goal : states) {
      const auto expected = planned(world, start, goal, options, lazy);
      const auto answer = ask_roadmap(roadmap, start, goal, options, {}, scratch);
      EXPECT_EQ(answer.outcome, expected.outcome);
      EXPECT_TRUE(std::equal(answer.path.begin(), answer.path.end(), expected.path.begin(), expected.path.end()));
      const bool large = expected.roadmap.milestones >= fewest_for_both_ends;
      if (lazy && large && W::in_plane && !options.neighbours) {
        EXPECT_GE(answer.counters.expanded, expected.counters.expanded);
      } else {
        EXPECT_EQ(answer.counters.expanded, expected.counters.expanded);
      }
      EXPECT_EQ(answer.roadmap.milestones, expected.roadmap.milestones);
      if (!lazy) {
        EXPECT_EQ(answer.roadmap.components, expected.roadmap.components);
      }
      if (!lazy && !W::one_way) {
        EXPECT_EQ(answer.roadmap.edges, expected.roadmap.edges);
      }
      EXPECT_EQ(answer.separation.start_size, expected.separation.start_size);
      EXPECT_EQ(answer.separation.goal_size, expected.separation.goal_size);
      solved += answer.outcome == Outcome::solved ? 1 : 0;
    }
  }
  return solved;
}

/// Two of them are blocked.
std::vector<Vec2> some_places() { return {{1, 1}, {12, 12}, {3.2, 7.1}, {6.5, 6.1}, {10.9, 2}, {0.5, 0.5}}; }

TEST(AskRoadmap, AnswersAsThePlannerDoesInMazes) {
  for (const double loops : {0.0, 0.2}) {
    const Scene scene = maze(loops);
    const MazeWorld own(scene, 0.1, {});
    const WorldView world(own);
    for (const bool lazy : {false, true}) {
      for (const std::uint64_t samples : {400, 4000}) {
        SCOPED_TRACE(std::to_string(loops) + (lazy ? " lazy " : " ") + std::to_string(samples));
        RoadmapOptions options;
        options.samples = samples;
        const std::size_t solved = expect_the_planners_answers(world, some_places(), options, lazy);
        EXPECT_GE(solved, samples == 4000 ? 16U : 4U);
      }
    }
  }
}

TEST(AskRoadmap, AnswersByEverySearchAndRule) {
  const Scene scene = maze(0.2);
  const MazeWorld own(scene, 0.1, {});
  const WorldView world(own);
  RoadmapOptions options;
  options.samples = 3000;
  for (const SearchKind search : {SearchKind::astar, SearchKind::dijkstra, SearchKind::bfs, SearchKind::dfs}) {
    options.search = search;
    expect_the_planners_answers(world, some_places(), options, false);
  }
  options.search = SearchKind::astar;
  options.neighbours = 7;
  expect_the_planners_answers(world, some_places(), options, false);
  expect_the_planners_answers(world, some_places(), options, true);
}

TEST(AskRoadmap, AnswersOnTheLattice) {
  const Scene scene = maze(0.1);
  const MazeWorld own(scene, 0.1, {});
  const WorldView world(own);
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = {scene.maze->rows, scene.maze->cols};
  EXPECT_EQ(expect_the_planners_answers(world, some_places(), options, false), 16U);
}

TEST(AskRoadmap, AnswersFromBothEndsWhereItIsLarge) {
  const Scene scene = maze(0.2, 60);
  const MazeWorld own(scene, 0.1, {});
  const WorldView world(own);
  RoadmapOptions options;
  options.samples = 90'000;
  const std::vector<Vec2> places{{1, 1}, {60, 60}, {30, 10}};
  for (const bool lazy : {false, true}) expect_the_planners_answers(world, places, options, lazy);
  options.neighbours = 16;  // by which no dead end is left out, so that all counts are the same again
  expect_the_planners_answers(world, places, options, true);
}

TEST(AskRoadmap, AnswersForCarsThatOnlyDriveForwards) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {12, 6}};
  scene.walls = WallSet::narrowest(std::vector<Segment>{{{3, 0}, {3, 3.5}}, {{6, 6}, {6, 2.5}}, {{9, 0}, {9, 3.5}}});
  const CarWorld<DubinsCurve> own(scene, CarOptions{.turning_radius = 0.7, .radius = 0.2}, {});
  const WorldView world(own);
  RoadmapOptions options;
  for (const std::uint64_t samples : {60, 600}) {
    options.samples = samples;
    for (const bool lazy : {false, true}) {
      expect_the_planners_answers(world, {{1, 1, 0}, {11, 1, 0}, {11, 1, 3}, {5, 5, 1}}, options, lazy);
    }
  }
}

TEST(AskRoadmap, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = maze(0.1);
  const MazeWorld own(scene, 0.1, {});
  const WorldView world(own);
  const RoadmapOptions options;  // grows
  const AskedRoadmap<AnyWorld<Vec2>> one = asked(world, options, false, 1);
  for (const unsigned threads : {2U, 3U, 8U}) {
    const AskedRoadmap<AnyWorld<Vec2>> more = asked(world, options, false, threads);
    EXPECT_TRUE(std::equal(one.states.begin(), one.states.end(), more.states.begin(), more.states.end()));
    EXPECT_TRUE(std::ranges::equal(one.candidates.targets(), more.candidates.targets()));
    EXPECT_TRUE(std::ranges::equal(one.edge_states(), more.edge_states()));
  }
}

TEST(AskRoadmap, GrowsUntilWhatIsJoinedStaysJoined) {
  const Scene scene = maze(0.0, 15);
  const MazeWorld own(scene, 0.1, {});
  const WorldView world(own);
  std::size_t joined = 0;
  std::size_t asked_for = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RoadmapOptions options;
    options.seed = seed;
    const AskedRoadmap<AnyWorld<Vec2>> roadmap = asked(world, options, false);
    AskScratch scratch;
    for (std::uint64_t i = 0; i < 20; ++i) {
      const Vec2 start = uniform_state(world, 1000 + seed, 2 * i);
      const Vec2 goal = uniform_state(world, 1000 + seed, 2 * i + 1);
      const auto answer = ask_roadmap(roadmap, start, goal, options, {}, scratch);
      if (answer.outcome == Outcome::start_blocked || answer.outcome == Outcome::goal_blocked) continue;
      ++asked_for;
      joined += answer.outcome == Outcome::solved ? 1 : 0;
    }
  }
  EXPECT_GE(asked_for, 40U);
  EXPECT_GE(joined, asked_for - 2);  // of a perfect maze, where every cell can be reached
}

TEST(AskRoadmap, LearnsWhatItHasAskedTheWorld) {
  const Scene scene = maze(0.2);
  const MazeWorld own(scene, 0.1, {});
  const WorldView world(own);
  RoadmapOptions options;
  options.samples = 3000;
  const AskedRoadmap<AnyWorld<Vec2>> roadmap = asked(world, options, true);
  AskScratch scratch;
  const auto first = ask_roadmap(roadmap, {1, 1}, {12, 12}, options, {}, scratch);
  const auto second = ask_roadmap(roadmap, {1, 1}, {12, 12}, options, {}, scratch);
  EXPECT_EQ(first.outcome, Outcome::solved);
  EXPECT_GT(first.counters.edges_checked, second.counters.edges_checked + 100);
  Counters counters;
  const auto checked = check_edges(world, roadmap.states, roadmap.candidates, {}, counters);
  for (std::size_t end = 0; end < roadmap.candidates.targets().size(); ++end) {
    const EdgeState known = edge_state(roadmap.edge_states(), end);
    if (known == EdgeState::unchecked) continue;
    EXPECT_EQ(known, edge_state(checked, end));
  }
}

}  // namespace
}  // namespace warren
