// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap/prm.hpp"

#include <gtest/gtest.h>

#include <queue>
#include <set>
#include <string>
#include <tuple>

#include "bench/plain_graph.hpp"
#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "solve/kinds/planned_worlds.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"
#include "tests/seeds.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {
namespace {

using test::length_of;

constexpr double clearance = 0.1;

Scene maze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops = 0.0) {
  return maze_scene({rows, cols, seed, MazeAlgorithm::backtracker, loops}, false, {});
}

Vec2 start_of(const Scene& scene) { return {scene.start[0], scene.start[1]}; }
Vec2 goal_of(const Scene& scene) { return {scene.goal[0], scene.goal[1]}; }

RoadmapOptions lattice_options(const Scene& scene) {
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = {scene.maze->rows, scene.maze->cols};
  return options;
}

/// Steps between cell centres on the shortest walk through the cells: an oracle that knows no roadmap.
double shortest_walk(const Scene& scene) {
  const MazeCells cells = cells_of_walls(scene.walls, *scene.maze, {});
  const std::uint32_t cols = cells.cols();
  std::vector<int> steps(std::size_t{cols} * cells.rows(), -1);
  std::queue<std::uint32_t> queue({0U});
  steps[0] = 0;
  const auto go = [&](std::uint32_t from, std::uint32_t to) {
    if (steps[to] >= 0) return;
    steps[to] = steps[from] + 1;
    queue.push(to);
  };
  for (; !queue.empty(); queue.pop()) {
    const std::uint32_t cell = queue.front();
    const std::uint32_t col = cell % cols;
    const std::uint32_t row = cell / cols;
    if (col + 1 < cols && !cells.wall_right(col, row)) go(cell, cell + 1);
    if (col > 0 && !cells.wall_right(col - 1, row)) go(cell, cell - 1);
    if (row + 1 < cells.rows() && !cells.wall_above(col, row)) go(cell, cell + cols);
    if (row > 0 && !cells.wall_above(col, row - 1)) go(cell, cell - cols);
  }
  return steps.back() + 1.0;  // half a step from the start, half a step to the goal
}

/// Every leg against every wall, by plain distances.
void expect_clear(const Scene& scene, const Path<Vec2>& path) {
  ASSERT_GE(path.size(), 2U);
  EXPECT_EQ(path.front(), start_of(scene));
  EXPECT_EQ(path.back(), goal_of(scene));
  for (std::size_t leg = 0; leg + 1 < path.size(); ++leg) {
    for (std::size_t i = 0; i < scene.walls.size(); ++i) {
      ASSERT_GE(distance(Segment{path[leg], path[leg + 1]}, scene.walls.segment(i)), clearance) << leg << " " << i;
    }
  }
}

using Planner = Solution<Vec2> (*)(const AnyWorld<Vec2>&, const Vec2&, const Vec2&, const RoadmapOptions&,
                                   const Execution&, PlannedRoadmap<Vec2>*);
struct NamedPlanner {
  const char* name;
  Planner plan;
};
const std::vector<NamedPlanner> planners = {{"prm", prm<Vec2>}, {"lazy-prm", lazy_prm<Vec2>}};

TEST(Prm, LatticePathIsTheShortestWalkOverCellCentres) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double loops : {0.0, 0.2}) {
      const Scene scene = maze(13, 17, seed, loops);
      const MazeWorld world(scene, clearance, {});
      for (const NamedPlanner& planner : planners) {
        SCOPED_TRACE(std::string(planner.name) + " seed " + std::to_string(seed));
        RoadmapOptions options = lattice_options(scene);
        const auto solution = planner.plan(WorldView(world), start_of(scene), goal_of(scene), options, {}, nullptr);
        ASSERT_EQ(solution.outcome, Outcome::solved);
        EXPECT_DOUBLE_EQ(length_of(solution), shortest_walk(scene));
        expect_clear(scene, solution.path);
      }
    }
  }
}

TEST(Prm, UniformSamplingSolvesEveryMazeWithoutKnobs) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene = maze(5, 7, seed);
    const MazeWorld world(scene, clearance, {});
    for (const SamplerKind sampler : {SamplerKind::uniform, SamplerKind::halton}) {
      for (const NamedPlanner& planner : planners) {
        SCOPED_TRACE(std::string(planner.name) + " seed " + std::to_string(seed));
        RoadmapOptions options;
        options.sampler = sampler;
        options.seed = seed;
        const auto solution = planner.plan(WorldView(world), start_of(scene), goal_of(scene), options, {}, nullptr);
        ASSERT_EQ(solution.outcome, Outcome::solved);
        expect_clear(scene, solution.path);
      }
    }
  }
}

TEST(Prm, TheLazyPlannerFindsThePathOfTheEagerOne) {
  const Scene scene = maze(9, 9, 4, 0.1);
  const MazeWorld world(scene, clearance, {});
  for (const bool by_nearest : {false, true}) {
    RoadmapOptions options;
    options.samples = 2500;
    if (by_nearest) options.neighbours = 20;
    const auto eager = prm(WorldView(world), start_of(scene), goal_of(scene), options, {});
    ASSERT_EQ(eager.outcome, Outcome::solved);
    const auto found = lazy_prm(WorldView(world), start_of(scene), goal_of(scene), options, {});
    ASSERT_EQ(found.outcome, Outcome::solved);
    EXPECT_NEAR(length_of(found), length_of(eager), 1e-12 * length_of(eager));
    EXPECT_LT(found.counters.edges_checked, eager.counters.edges_checked);
  }
}

TEST(Prm, ResultAndCountersAreTheSameForAnyNumberOfThreads) {
  const Scene scene = maze(25, 25, 3);
  for (const NamedPlanner& planner : planners) {
    SCOPED_TRACE(planner.name);
    RoadmapOptions options;
    const auto plan = [&](unsigned threads) {
      const Execution execution{threads};
      const MazeWorld world(scene, clearance, execution);
      return planner.plan(WorldView(world), start_of(scene), goal_of(scene), options, execution, nullptr);
    };
    const auto one = plan(1);
    ASSERT_EQ(one.outcome, Outcome::solved);
    for (const unsigned threads : {2U, 3U, 8U}) {
      const auto many = plan(threads);
      EXPECT_EQ(many.path, one.path);
      EXPECT_EQ(many.counters, one.counters);
      EXPECT_EQ(many.roadmap.edges, one.roadmap.edges);
    }
  }
}

/// Each parent joined to its vertex, and one a vertex; all of the path in the tree.
void expect_tree(const PlannedRoadmap<Vec2>& roadmap, const Path<Vec2>& path) {
  std::vector<int> parents(roadmap.states.size(), 0);
  std::set<std::pair<double, double>> in_tree;
  for (const Edge& e : roadmap.search_tree) {
    ASSERT_TRUE(std::ranges::binary_search(roadmap.graph.neighbours(e.from), e.to));
    ASSERT_EQ(++parents[e.from], 1);
    in_tree.insert({roadmap.states[e.from].x, roadmap.states[e.from].y});
  }
  for (std::size_t leg = 1; leg + 1 < path.size(); ++leg) ASSERT_TRUE(in_tree.contains({path[leg].x, path[leg].y}));
}

/// So many milestones that lazy_prm searches from both ends.
TEST(Prm, LazySearchFromBothEndsFindsThePathOfTheEagerOneOnAnyNumberOfThreads) {
  const Scene scene = maze(100, 100, 5, 0.05);
  const MazeWorld world(scene, clearance, {});
  const auto plan = [&](Planner planner, const RoadmapOptions& options, unsigned threads, PlannedRoadmap<Vec2>* keep) {
    return planner(WorldView(world), start_of(scene), goal_of(scene), options, Execution{threads}, keep);
  };
  for (const std::uint64_t i : test::seeds(4, 2, 0)) {
    const bool by_nearest = i < 2;
    const SearchKind search = i % 2 == 0 ? SearchKind::astar : SearchKind::dijkstra;
    SCOPED_TRACE(std::to_string(by_nearest) + " " + std::to_string(static_cast<int>(search)));
    RoadmapOptions options;
    options.search = search;
    if (by_nearest) options.neighbours = 16;
    const auto eager = plan(prm<Vec2>, options, 1, nullptr);
    ASSERT_EQ(eager.outcome, Outcome::solved);
    PlannedRoadmap<Vec2> roadmap;
    const auto one = plan(lazy_prm<Vec2>, options, 1, &roadmap);
    ASSERT_EQ(one.outcome, Outcome::solved);
    ASSERT_GE(one.roadmap.milestones, fewest_for_both_ends);
    EXPECT_NEAR(length_of(one), length_of(eager), 1e-12 * length_of(eager));
    EXPECT_LT(one.counters.edges_checked, eager.counters.edges_checked);
    const auto two = plan(lazy_prm<Vec2>, options, 2, nullptr);
    EXPECT_EQ(two.path, one.path);
    EXPECT_EQ(two.counters, one.counters);
    EXPECT_EQ(two.roadmap.edges, one.roadmap.edges);
    expect_tree(roadmap, one.path);
  }
}

/// So many vertices, and most of them on chains, that prm reduces the roadmap before it searches it.
TEST(Prm, LargeLatticesAreReducedWithoutChangingTheAnswer) {
  for (const double loops : {0.0, 0.1}) {
    for (const SearchKind search : {SearchKind::astar, SearchKind::dijkstra}) {
      SCOPED_TRACE(std::to_string(loops) + " " + std::to_string(static_cast<int>(search)));
      const Scene scene = maze(230, 250, 3, loops);
      RoadmapOptions options = lattice_options(scene);
      options.search = search;
      PlannedRoadmap<Vec2> roadmap;
      const auto plan = [&](unsigned threads) {
        const Execution execution{threads};
        const MazeWorld world(scene, clearance, execution);
        return prm(WorldView(world), start_of(scene), goal_of(scene), options, execution, &roadmap);
      };
      const auto one = plan(1);
      ASSERT_EQ(one.outcome, Outcome::solved);
      ASSERT_GE(one.roadmap.milestones, fewest_for_both_ends);
      EXPECT_LT(one.counters.expanded, one.roadmap.milestones / 4);
      EXPECT_EQ(one.roadmap.components, bench::plain_components(roadmap.graph).count);
      EXPECT_DOUBLE_EQ(length_of(one), shortest_walk(scene));
      expect_tree(roadmap, one.path);
      const auto two = plan(2);
      EXPECT_EQ(two.path, one.path);
      EXPECT_EQ(two.counters, one.counters);
    }
  }
}

TEST(Prm, EverySearchAndQueueFindsAPathAndTheOptimalOnesAgree) {
  const Scene scene = maze(11, 11, 6, 0.3);
  const MazeWorld world(scene, clearance, {});
  RoadmapOptions options = lattice_options(scene);
  const double shortest = shortest_walk(scene);
  for (const QueueKind queue :
       {QueueKind::heap, QueueKind::lazy_heap, QueueKind::sorted_array, QueueKind::resorted_array}) {
    for (const SearchKind search : {SearchKind::astar, SearchKind::dijkstra, SearchKind::bfs, SearchKind::dfs}) {
      options.queue = queue;
      options.search = search;
      const auto solution = prm(WorldView(world), start_of(scene), goal_of(scene), options, {});
      ASSERT_EQ(solution.outcome, Outcome::solved);
      expect_clear(scene, solution.path);
      if (search == SearchKind::dfs) {
        EXPECT_GE(length_of(solution), shortest);
      } else {
        EXPECT_DOUBLE_EQ(length_of(solution), shortest);
      }
    }
  }
}

/// A closed box around the goal, the cell in the last row and column.
Scene walled_off(std::uint32_t rows, std::uint32_t cols) {
  Scene scene = maze(rows, cols, 2);
  const double left = cols - 0.5;
  const double bottom = rows - 0.5;
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) walls.push_back(scene.walls.segment(i));
  for (const Segment& s : {Segment{{left, bottom}, {left + 1, bottom}}, Segment{{left, bottom}, {left, bottom + 1}}})
    walls.push_back(s);
  scene.walls = WallSet::narrowest(walls);
  return scene;
}

TEST(Prm, TellsHowFarStartAndGoalAreApart) {
  const Scene scene = walled_off(6, 6);
  const MazeWorld world(scene, clearance, {});
  const MazeCells cells = cells_of_walls(scene.walls, *scene.maze, {});
  std::uint64_t reachable = 0;
  for (std::uint32_t cell = 0; cell < 36; ++cell) reachable += flood_connects(cells, {0, 0}, {cell % 6, cell / 6}, {});
  for (const NamedPlanner& planner : planners) {
    SCOPED_TRACE(planner.name);
    RoadmapOptions options = lattice_options(scene);
    const auto solution = planner.plan(WorldView(world), start_of(scene), goal_of(scene), options, {}, nullptr);
    EXPECT_EQ(solution.outcome, Outcome::not_connected);
    EXPECT_TRUE(solution.path.empty());
    EXPECT_EQ(solution.separation.start_size, reachable + 1);
    EXPECT_EQ(solution.separation.goal_size, 2U);
    EXPECT_DOUBLE_EQ(solution.separation.nearest_gap, 1.0);
  }
}

TEST(Prm, KnowsTheComponentsOfWhatItReduces) {
  const Scene scene = walled_off(230, 250);
  const MazeWorld world(scene, clearance, {});
  PlannedRoadmap<Vec2> roadmap;
  const auto solution = prm(WorldView(world), start_of(scene), goal_of(scene), lattice_options(scene), {}, &roadmap);
  EXPECT_EQ(solution.outcome, Outcome::not_connected);
  ASSERT_GE(solution.roadmap.milestones, fewest_for_both_ends);
  const Components oracle = bench::plain_components(roadmap.graph);
  const auto start = static_cast<VertexId>(roadmap.states.size() - 2);
  EXPECT_GT(oracle.count, 1U);
  EXPECT_EQ(solution.roadmap.components, oracle.count);
  EXPECT_EQ(solution.separation.start_size, oracle.size_of(start));
  EXPECT_EQ(solution.separation.goal_size, oracle.size_of(start + 1));
}

TEST(Prm, BlockedEndsAreNamed) {
  const Scene scene = maze(5, 5, 1);
  const MazeWorld world(scene, clearance, {});
  EXPECT_EQ(prm(WorldView(world), {1.0, 0.55}, goal_of(scene), {}, {}).outcome, Outcome::start_blocked);
  EXPECT_EQ(prm(WorldView(world), start_of(scene), {99.0, 1.0}, {}, {}).outcome, Outcome::goal_blocked);
  EXPECT_EQ(lazy_prm(WorldView(world), {1.0, 0.5}, goal_of(scene), {}, {}).outcome, Outcome::start_blocked);
}

TEST(Prm, StartEqualToGoalIsAPathOfLengthZero) {
  const Scene scene = maze(5, 5, 1);
  const MazeWorld world(scene, clearance, {});
  const auto solution = prm(WorldView(world), {2, 2}, {2, 2}, lattice_options(scene), {});
  ASSERT_EQ(solution.outcome, Outcome::solved);
  EXPECT_EQ(length_of(solution), 0.0);
}

TEST(Prm, ADeadlineInThePastStopsThePlan) {
  const Scene scene = maze(30, 30, 1);
  const Deadline deadline(0.0);
  const Execution execution{1, &deadline};
  const MazeWorld world(scene, clearance, {});
  for (const NamedPlanner& planner : planners) {
    const auto solution = planner.plan(WorldView(world), start_of(scene), goal_of(scene), {}, execution, nullptr);
    EXPECT_EQ(solution.outcome, Outcome::stopped) << planner.name;
    EXPECT_EQ(solution.stop_reason, StopReason::time);
  }
}

TEST(Prm, KeepsTheRoadmapWhereAsked) {
  const Scene scene = maze(7, 7, 5);
  const MazeWorld world(scene, clearance, {});
  for (const NamedPlanner& planner : planners) {
    SCOPED_TRACE(planner.name);
    RoadmapOptions options = lattice_options(scene);
    PlannedRoadmap<Vec2> roadmap;
    const auto solution = planner.plan(WorldView(world), start_of(scene), goal_of(scene), options, {}, &roadmap);
    ASSERT_EQ(roadmap.states.size(), 51U);
    EXPECT_EQ(roadmap.graph.vertex_count(), 51U);
    EXPECT_EQ(solution.roadmap.milestones, 51U);
    EXPECT_EQ(roadmap.states[49], start_of(scene));
    EXPECT_EQ(roadmap.states[50], goal_of(scene));
    EXPECT_FALSE(roadmap.search_tree.empty());
    auto query = world.make_query();
    for (VertexId v = 0; v < 51; ++v) {
      for (const VertexId w : roadmap.graph.neighbours(v)) {
        EXPECT_TRUE(world.is_free_motion(roadmap.states[v], roadmap.states[w], query));
      }
    }
  }
}

}  // namespace
}  // namespace warren
