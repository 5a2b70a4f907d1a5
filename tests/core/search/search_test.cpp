// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "bench/plain_graph.hpp"
#include "core/base/rng.hpp"
#include "core/search/search_queues.hpp"
#include "tests/core/search/search_graphs.hpp"

namespace warren {
namespace {

using Problem = test::PlaneGraph;
using test::random_graph;

/// Floyd-Warshall; weight(v, w) of an edge.
template <class Weight>
std::vector<std::vector<double>> all_distances(const Graph& graph, const Weight& weight) {
  const std::size_t n = graph.vertex_count();
  std::vector<std::vector<double>> d(n, std::vector<double>(n, std::numeric_limits<double>::infinity()));
  for (VertexId v = 0; v < n; ++v) {
    d[v][v] = 0.0;
    for (const VertexId w : graph.neighbours(v)) d[v][w] = weight(v, w);
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
    }
  }
  return d;
}

void expect_path(const Graph& graph, const SearchResult& result, VertexId start, VertexId goal) {
  ASSERT_FALSE(result.path.empty());
  EXPECT_EQ(result.path.front(), start);
  EXPECT_EQ(result.path.back(), goal);
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    const auto row = graph.neighbours(result.path[i - 1]);
    EXPECT_TRUE(std::binary_search(row.begin(), row.end(), result.path[i]));
  }
}

template <class Queue>
SearchResult astar(const Problem& problem, VertexId start, VertexId goal, Queue queue, SearchState& state,
                   bool use_heuristic = true) {
  queue.resize(problem.at.size());
  state.resize(problem.at.size());
  // The margin keeps the rounded heuristic consistent, so that a tie is never lost to the last bit.
  const auto heuristic = [&](VertexId v) {
    return use_heuristic ? (1.0 - 1e-12) * distance(problem.at[v], problem.at[goal]) : 0.0;
  };
  const auto neighbours = [&](VertexId v, const auto& visit) {
    for (const VertexId w : problem.graph.neighbours(v)) visit(w, problem.length(v, w));
  };
  return best_first(start, goal, neighbours, heuristic, queue, state, NeverStop());
}

TEST(BestFirst, FindsTheLengthsOfFloydWarshallFromOneStateUsedAgain) {
  SearchState state;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = random_graph(seed, 20 + 3 * seed, 45 + 3 * seed);
    const auto d = all_distances(problem.graph, [&](VertexId v, VertexId w) { return problem.length(v, w); });
    for (VertexId goal = 0; goal < problem.at.size(); ++goal) {
      for (const bool use_heuristic : {true, false}) {
        const SearchResult result = astar(problem, 3, goal, IndexedHeap<4>(), state, use_heuristic);
        const bool reachable = d[3][goal] != std::numeric_limits<double>::infinity();
        ASSERT_EQ(result.status == SearchStatus::found, reachable);
        if (!reachable) continue;
        ASSERT_NEAR(result.length, d[3][goal], 1e-9);
        expect_path(problem.graph, result, 3, goal);
        double length = 0.0;
        for (std::size_t i = 1; i < result.path.size(); ++i)
          length += problem.length(result.path[i - 1], result.path[i]);
        ASSERT_EQ(length, result.length);
      }
    }
  }
}

TEST(BestFirst, TakesTheSameStepsWithEveryQueue) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = random_graph(seed, 300, 700);
    SearchState state;
    const SearchResult expected = astar(problem, 0, 299, IndexedHeap<4>(), state);
    const auto expect_equal = [&](const char* name, const auto& queue) {
      SCOPED_TRACE(name);
      const SearchResult result = astar(problem, 0, 299, queue, state);
      EXPECT_EQ(result.status, expected.status);
      EXPECT_EQ(result.path, expected.path);
      EXPECT_EQ(result.length, expected.length);
      EXPECT_EQ(result.expanded, expected.expanded);
    };
    expect_equal("binary", IndexedHeap<2>());
    expect_equal("8-ary", IndexedHeap<8>());
    expect_equal("lazy", LazyHeap());
    expect_equal("sorted", SortedArray());
    expect_equal("resorted", ResortedArray());
    expect_equal("linear", LinearScan());
    for (const double width : {0.001, 0.1, 10.0}) expect_equal("bucket", BucketQueue(width));
  }
}

TEST(BestFirst, ExpandsNoMoreWithAConsistentHeuristicThanWithout) {
  for (std::uint64_t seed = 2; seed <= 24; seed += 2) {
    SCOPED_TRACE(seed);
    const Problem problem = random_graph(seed, 300, 900);
    SearchState state;
    const SearchResult with = astar(problem, 0, 299, IndexedHeap<4>(), state, true);
    const SearchResult without = astar(problem, 0, 299, IndexedHeap<4>(), state, false);
    EXPECT_NEAR(with.length, without.length, 1e-9);
    if (seed % 3 != 0) {
      EXPECT_LE(with.expanded, without.expanded);
    }
  }
}

TEST(BreadthFirst, HopsAreMinimalAndDepthFirstPathsAreValid) {
  SearchState state;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = random_graph(seed, 40 + seed, 60 + seed);
    const auto hops = all_distances(problem.graph, [](VertexId, VertexId) { return 1.0; });
    for (VertexId goal = 0; goal < problem.at.size(); ++goal) {
      const bool reachable = hops[0][goal] != std::numeric_limits<double>::infinity();
      state.resize(problem.at.size());
      const SearchResult bfs = breadth_first(problem.graph, 0, goal, state);
      state.resize(problem.at.size());
      const SearchResult dfs = depth_first(problem.graph, 0, goal, state);
      ASSERT_EQ(bfs.status == SearchStatus::found, reachable);
      ASSERT_EQ(dfs.status == SearchStatus::found, reachable);
      if (!reachable) continue;
      expect_path(problem.graph, bfs, 0, goal);
      expect_path(problem.graph, dfs, 0, goal);
      ASSERT_EQ(static_cast<double>(bfs.path.size() - 1), hops[0][goal]);
      ASSERT_EQ(std::set<VertexId>(dfs.path.begin(), dfs.path.end()).size(), dfs.path.size());
    }
  }
}

TEST(DepthFirst, GoesDownTheFirstNeighbourThatIsNew) {
  const Graph graph = bench::plain_graph(5, std::vector<Edge>{{0, 1}, {0, 4}, {1, 2}, {1, 3}, {3, 4}});
  SearchState state;
  state.resize(5);
  const SearchResult result = depth_first(graph, 0, 4, state);
  EXPECT_EQ(result.path, (RawVector<VertexId>{0, 1, 3, 4}));
  EXPECT_EQ(result.expanded, 5U);
}

TEST(BreadthFirst, TiesGoToTheSmallerParent) {
  const Graph graph = bench::plain_graph(4, std::vector<Edge>{{0, 1}, {0, 2}, {1, 3}, {2, 3}});
  SearchState state;
  state.resize(4);
  EXPECT_EQ(breadth_first(graph, 0, 3, state).path, (RawVector<VertexId>{0, 1, 3}));
}

TEST(Searches, StopWithinOnePollWhenAsked) {
  std::vector<Edge> edges;
  for (VertexId v = 1; v < 5000; ++v) edges.push_back({v - 1, v});
  const Graph graph = bench::plain_graph(5000, edges);
  const auto stop = [] { return true; };
  SearchState state;
  const auto expect_stopped = [](const SearchResult& result) {
    EXPECT_EQ(result.status, SearchStatus::stopped);
    EXPECT_EQ(result.expanded, expansions_per_poll);
    EXPECT_TRUE(result.path.empty());
  };
  state.resize(5000);
  expect_stopped(breadth_first(graph, 0, 4999, state, stop));
  state.resize(5000);
  expect_stopped(depth_first(graph, 0, 4999, state, stop));
  state.resize(5000);
  LazyHeap queue;
  const auto neighbours = [&](VertexId v, const auto& visit) {
    for (const VertexId w : graph.neighbours(v)) visit(w, 1.0);
  };
  expect_stopped(best_first(
      0, 4999, neighbours, [](VertexId) { return 0.0; }, queue, state, stop));
}

TEST(Searches, OfAStartThatIsTheGoalGiveOneVertex) {
  const Problem problem = random_graph(1, 10, 12);
  SearchState state;
  EXPECT_EQ(astar(problem, 4, 4, IndexedHeap<4>(), state).path, (RawVector<VertexId>{4}));
  state.resize(10);
  EXPECT_EQ(breadth_first(problem.graph, 4, 4, state).path, (RawVector<VertexId>{4}));
  state.resize(10);
  EXPECT_EQ(depth_first(problem.graph, 4, 4, state).path, (RawVector<VertexId>{4}));
}

TEST(SearchState, ClearForgetsEverythingThatWasTouched) {
  SearchState state;
  state.resize(1000);
  for (const VertexId v : {0U, 63U, 64U, 500U, 999U}) {
    state.reach(v, v, no_vertex);
    state.close(v);
    EXPECT_TRUE(state.closed(v));
    EXPECT_EQ(state.g(v), v);
    EXPECT_FALSE(state.improves(v, 0.0));
  }
  EXPECT_EQ(state.touched(), (std::vector<VertexId>{0, 63, 64, 500, 999}));
  state.clear();
  for (VertexId v = 0; v < 1000; ++v) {
    ASSERT_FALSE(state.reached(v) || state.closed(v));
    ASSERT_TRUE(state.improves(v, 1e300));
  }
  EXPECT_TRUE(state.touched().empty());
  state.reach(999, 1.0, no_vertex);
  state.resize(500);
  state.resize(2000);
  for (VertexId v = 0; v < 2000; ++v) ASSERT_FALSE(state.reached(v));
}

}  // namespace
}  // namespace warren
