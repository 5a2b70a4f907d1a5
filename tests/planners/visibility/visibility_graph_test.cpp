// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/visibility_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "tests/planners/visibility/degenerate_worlds.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"
#include "tests/planners/visibility/visibility_oracle.hpp"
#include "tests/seeds.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
namespace {

using test::length_of;

oracle::Point grid_point(Vec2 p) { return {static_cast<std::int64_t>(p.x), static_cast<std::int64_t>(p.y)}; }

oracle::Vertex oracle_vertex(const VisibleCorners& corners, VertexId v) {
  return {grid_point(corners.position(v)), static_cast<int>(v - corners.vertices_first(corners.point(v)))};
}

using VertexPairs = std::set<std::pair<oracle::Vertex, oracle::Vertex>>;

VertexPairs edges_of(const VisibleCorners& corners, const Graph& graph) {
  VertexPairs pairs;
  for (VertexId v = 0; v < graph.vertex_count(); ++v) {
    for (const VertexId w : graph.neighbours(v)) pairs.insert({oracle_vertex(corners, v), oracle_vertex(corners, w)});
  }
  return pairs;
}

VertexPairs edges_by_definition(const oracle::Plane& plane) {
  VertexPairs pairs;
  for (const oracle::Point p : plane.corners()) {
    for (const oracle::Point q : plane.corners()) {
      for (const auto& [i, j] : plane.ways(p, q)) pairs.insert({{p, i}, {q, j}});
    }
  }
  return pairs;
}

std::string text(const VertexPairs& pairs) {
  std::string line;
  const auto add = [&](const oracle::Vertex& v) {
    line += "(" + std::to_string(v.at.x) + "," + std::to_string(v.at.y) + ")#" + std::to_string(v.sector) + " ";
  };
  for (const auto& [v, w] : pairs) {
    add(v);
    add(w);
    line += "\n";
  }
  return line;
}

VertexPairs minus(const VertexPairs& a, const VertexPairs& b) {
  VertexPairs result;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(result, result.end()));
  return result;
}

TEST(VisibilityGraph, FullEdgesAreThoseByDefinitionInDegenerateWorlds) {
  std::size_t crossing_worlds = 0;
  for (const std::uint64_t seed : test::seeds(200, 48, 0)) {
    SCOPED_TRACE(seed);
    const PlaneObstacles world = DegenerateWorlds(seed).make(seed % 3 == 0);
    const VisibleCorners corners(world, {});
    const VisibilityGraph visibility(corners, VisibilityEdges::full, {});
    const oracle::Plane plane(world);
    std::set<oracle::Vertex> vertices;
    for (VertexId v = 0; v < corners.size(); ++v) vertices.insert(oracle_vertex(corners, v));
    ASSERT_EQ(vertices.size(), plane.vertices().size());
    EXPECT_TRUE(vertices == plane.vertices());
    const VertexPairs mine = edges_of(corners, visibility.graph());
    const VertexPairs theirs = edges_by_definition(plane);
    ASSERT_TRUE(mine == theirs) << "missing:\n"
                                << text(minus(theirs, mine)) << "too many:\n"
                                << text(minus(mine, theirs));
    crossing_worlds += corners.pieces().crosses() ? 1 : 0;
  }
  EXPECT_GT(crossing_worlds, test::share(40, 4));
  EXPECT_LT(crossing_worlds, test::share(160, 46));
}

VisibilityOptions with(VisibilityEdges edges, SearchKind search = SearchKind::astar) {
  VisibilityOptions options;
  options.edges = edges;
  options.search = search;
  return options;
}

VisibilityOptions lazily() {
  VisibilityOptions options;
  options.lazy = true;
  return options;
}

/// The judge's word for a path that may touch.
bool verified(const PlaneObstacles& world, const Path<Vec2>& path, Vec2 start, Vec2 goal) {
  Scene scene;
  scene.walls = WallSet::narrowest(world.walls);
  for (std::size_t p = 0; p < world.polygons.size(); ++p) {
    const auto ring = world.polygons[p];
    scene.polygons.push_back({{ring.begin(), ring.end()}, 0});
  }
  scene.bounds = world.bounds ? *world.bounds : Box{{-100, -100}, {100, 100}};
  VerifyOptions options;
  options.contact = Contact::allowed;
  options.start = start;
  options.goal = goal;
  return verify_path(scene, path, options, {}).verified;
}

TEST(VisibilityGraph, PathsAreShortestByDefinitionAndVerifiedInDegenerateWorlds) {
  std::size_t solved = 0;
  std::size_t bent = 0;
  std::size_t apart = 0;
  for (const std::uint64_t seed : test::seeds(200, 48, 0)) {
    SCOPED_TRACE(seed);
    DegenerateWorlds worlds(1000 + seed);
    const PlaneObstacles world = worlds.make(seed % 3 == 0);
    const Vec2 start = worlds.random_point();
    const Vec2 goal = worlds.random_point();
    const oracle::Plane plane(world, {start, goal});
    const double shortest = plane.shortest(start, goal);
    for (const VisibilityOptions& options :
         {with(VisibilityEdges::full), with(VisibilityEdges::reduced), lazily(),
          with(VisibilityEdges::reduced, SearchKind::dijkstra), with(VisibilityEdges::full, SearchKind::bfs)}) {
      const Solution<Vec2> solution = visibility_path(world, start, goal, options, {});
      if (plane.is_blocked(start)) {
        EXPECT_EQ(solution.outcome, Outcome::start_blocked);
      } else if (plane.is_blocked(goal)) {
        EXPECT_EQ(solution.outcome, Outcome::goal_blocked);
      } else if (start == goal) {
        EXPECT_EQ(solution.outcome, Outcome::solved);
      } else if (std::isinf(shortest)) {
        ++apart;
        ASSERT_EQ(solution.outcome, Outcome::not_connected);
      } else {
        ++solved;
        bent += solution.path.size() > 2 ? 1 : 0;
        ASSERT_EQ(solution.outcome, Outcome::solved);
        EXPECT_LE(length_of(solution), options.search == SearchKind::bfs ? 1e9 : shortest + 1e-12);
        EXPECT_GE(length_of(solution), shortest - 1e-12);
        EXPECT_TRUE(verified(world, solution.path, start, goal));
      }
    }
  }
  EXPECT_GT(solved, test::share(300, 40));
  EXPECT_GT(bent, test::share(100, 10));
  if (test::asks_all()) EXPECT_GT(apart, 10U);
}

TEST(VisibilityGraph, GraphIsTheSameForAnyNumberOfThreads) {
  PlaneObstacles world;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      const Vec2 at{3.0 * i + j % 3, 3.0 * j + i % 2};
      const Vec2 ring[] = {at, at + Vec2{1.0, 0.25 * (i % 4)}, at + Vec2{0.5, 1.5}};
      world.polygons.add(ring);
    }
  }
  const auto graph = [&](unsigned threads) {
    Execution execution;
    execution.threads = threads;
    const VisibleCorners corners(world, execution);
    return VisibilityGraph(corners, VisibilityEdges::reduced, execution).graph();
  };
  const Graph one = graph(1);
  EXPECT_GT(one.edge_count(), 1200);
  for (const unsigned threads : {2U, 3U, 8U}) {
    const Graph many = graph(threads);
    ASSERT_EQ(many.vertex_count(), one.vertex_count());
    for (VertexId v = 0; v < one.vertex_count(); ++v) {
      const auto a = one.neighbours(v);
      const auto b = many.neighbours(v);
      ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    }
  }
}

/// A small world with what is known about the way from start to goal.
struct GraphCase {
  const char* name;
  std::vector<std::vector<Vec2>> polygons;
  std::vector<Segment> walls;
  std::optional<Box> bounds;
  Vec2 start, goal;
  Outcome outcome;
  double length = 0.0;
};

TEST(VisibilityPath, CasesKnownByHand) {
  const std::vector<Vec2> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const std::vector<Vec2> right{{2, 0}, {4, 0}, {4, 2}, {2, 2}};
  const std::vector<Vec2> above{{2, 2}, {4, 2}, {4, 4}, {2, 4}};
  const double diagonal = std::sqrt(2.0);
  const Box tight{{-1, 0}, {5, 2}};
  const GraphCase cases[] = {
      {"nothing in the way", {}, {}, {}, {0, 0}, {3, 4}, Outcome::solved, 5.0},
      {"round a square", {square}, {}, {}, {-1, 1}, {3, 1}, Outcome::solved, 2 * diagonal + 2},
      {"along a side", {square}, {}, {}, {-1, 0}, {3, 0}, Outcome::solved, 4},
      {"from inside", {square}, {}, {}, {1, 1}, {3, 1}, Outcome::start_blocked},
      {"to the inside", {square}, {}, {}, {3, 1}, {1, 1}, Outcome::goal_blocked},
      {"from a side", {square}, {}, {}, {1, 0}, {3, 0}, Outcome::solved, 2},
      {"from a corner", {square}, {}, {}, {0, 0}, {2, 2}, Outcome::solved, 4},
      {"through a side that two share",
       {square, right},
       {},
       {},
       {2, -1},
       {2, 3},
       Outcome::solved,
       2 + 2 * std::sqrt(5.0)},
      {"start on a side that two share", {square, right}, {}, {}, {2, 1}, {2, 3}, Outcome::not_connected},
      {"through a corner that two share", {square, above}, {}, {}, {1, 3}, {3, 1}, Outcome::solved, 4 + 2 * diagonal},
      {"through the end of a wall", {}, {{{0, 0}, {0, 5}}}, {}, {-1, 0}, {1, 0}, Outcome::solved, 2},
      {"round a wall", {}, {{{0, -4}, {0, 3}}}, {}, {-4, 0}, {4, 0}, Outcome::solved, 10},
      {"along a wall", {}, {{{0, 0}, {4, 0}}}, {}, {-1, 0}, {5, 0}, Outcome::solved, 6},
      {"where two walls meet",
       {},
       {{{0, -9}, {0, 0}}, {{0, 0}, {0, 9}}},
       Box{{-9, -9}, {9, 9}},
       {-1, 0},
       {1, 0},
       Outcome::not_connected},
      {"a wall of no length", {}, {{{0, 0}, {0, 0}}}, {}, {-1, 0}, {1, 0}, Outcome::solved, 2},
      {"walls that cross",
       {},
       {{{-2, -2}, {2, 2}}, {{-2, 2}, {2, -2}}},
       {},
       {-1, 0},
       {1, 0},
       Outcome::solved,
       2 * (2 + std::sqrt(5.0))},
      {"between bounds and square", {square}, {}, tight, {-1, 1}, {3, 1}, Outcome::not_connected},
      {"outside of the bounds", {square}, {}, tight, {-2, 1}, {3, 1}, Outcome::start_blocked},
      {"start is goal", {square}, {}, {}, {0, 0}, {0, 0}, Outcome::solved, 0},
  };
  for (const GraphCase& c : cases) {
    SCOPED_TRACE(c.name);
    PlaneObstacles world{{}, c.walls, c.bounds};
    for (const auto& ring : c.polygons) world.polygons.add(ring);
    for (const VisibilityOptions& options : {with(VisibilityEdges::full), with(VisibilityEdges::reduced), lazily()}) {
      const Solution<Vec2> solution = visibility_path(world, c.start, c.goal, options, {});
      EXPECT_EQ(name_of(solution.outcome), name_of(c.outcome));
      EXPECT_NEAR(length_of(solution), c.length, 1e-12);  // without a path: 0
    }
  }
}

TEST(VisibilityPath, GivesWayToTheDeadline) {
  PlaneObstacles world;
  const Vec2 ring[] = {{0, 0}, {2, 0}, {1, 2}};
  world.polygons.add(ring);
  const SignalFlag signal{2};
  const Deadline deadline(1e9, std::numeric_limits<std::size_t>::max(), &signal);
  Execution execution;
  execution.deadline = &deadline;
  EXPECT_EQ(visibility_path(world, {-1, 1}, {3, 1}, {}, execution).outcome, Outcome::stopped);
}

TEST(VisibilityPath, KeepsTheGraphForPictures) {
  PlaneObstacles world;
  const Vec2 ring[] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  world.polygons.add(ring);
  for (const VisibilityOptions& options : {with(VisibilityEdges::full), lazily()}) {
    PlannedRoadmap<Vec2> keep;
    const Solution<Vec2> solution = visibility_path(world, {-1, 1}, {3, 1}, options, {}, &keep);
    ASSERT_EQ(keep.states.size(), 6);
    EXPECT_EQ(keep.graph.vertex_count(), 6);
    EXPECT_EQ(keep.graph.edge_count(), solution.roadmap.edges);
    EXPECT_EQ(keep.states[4], (Vec2{-1, 1}));
  }
}

TEST(VisibilityPath, RefusesLazyWithAnythingButReducedAStar) {
  VisibilityOptions options = lazily();
  options.edges = VisibilityEdges::full;
  EXPECT_THROW(visibility_path({}, {0, 0}, {1, 1}, options, {}), InputError);
  options = lazily();
  options.search = SearchKind::bfs;
  EXPECT_THROW(visibility_path({}, {0, 0}, {1, 1}, options, {}), InputError);
}

/// A side so short, straight to the right, that it hides no whole direction.
TEST(VisibilityPath, TakesSidesThatAreHardlyWiderThanAPoint) {
  PlaneObstacles plane;
  plane.polygons.add(std::vector<Vec2>{{1, -0.5}, {2, 0}, {1, 0.5}, {1, 1e-10}, {1, 0}});
  plane.bounds = Box{{-1, -2}, {4, 2}};
  const auto solution = visibility_path(plane, {0, 0}, {3, 0}, {}, {});
  ASSERT_EQ(solution.outcome, Outcome::solved);
  EXPECT_EQ(solution.path.size(), 3U);
}

}  // namespace
}  // namespace warren
