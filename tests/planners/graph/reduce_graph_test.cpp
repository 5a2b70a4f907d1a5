// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/roadmap_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "bench/plain_graph.hpp"
#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/search/search.hpp"
#include "core/search/search_queues.hpp"
#include "tests/core/search/search_graphs.hpp"
#include "tests/parallel/on_threads.hpp"

namespace warren {
namespace {

using test::on;

double edge_length(VertexId v, VertexId w) {
  return 1.0 + uniform(9, std::min(v, w), std::max(v, w)) * ((v + w) % 2);  // half of them tie
}

SearchResult shortest(const Graph& graph, VertexId start, VertexId goal) {
  SearchState state;
  state.resize(graph.vertex_count());
  IndexedHeap<4> heap;
  heap.resize(graph.vertex_count());
  const auto neighbours = [&](VertexId v, const auto& visit) {
    const auto row = graph.neighbours(v);
    for (std::size_t i = 0; i < row.size(); ++i) {
      visit(row[i], graph.has_lengths() ? graph.lengths(v)[i] : edge_length(v, row[i]));
    }
  };
  return best_first(
      start, goal, neighbours, [](VertexId) { return 0.0; }, heap, state, NeverStop());
}

/// Peels one vertex at a time until nothing changes.
std::vector<bool> peeled_naively(const Graph& graph, const std::vector<VertexId>& keep) {
  std::vector<bool> left(graph.vertex_count(), true);
  for (bool changed = true; changed;) {
    changed = false;
    for (VertexId v = 0; v < left.size(); ++v) {
      const auto row = graph.neighbours(v);
      const auto degree = std::count_if(row.begin(), row.end(), [&](VertexId w) { return left[w]; });
      if (!left[v] || degree > 1 || std::count(keep.begin(), keep.end(), v) != 0) continue;
      left[v] = false;
      changed = true;
    }
  }
  return left;
}

template <class Reduced>
void expect_shortest(const Graph& graph, const Reduced& reduced, VertexId start, VertexId goal,
                     const SearchResult& oracle, unsigned threads, RawVector<VertexId>& path) {
  for (VertexId key = 0; key < reduced.graph().vertex_count(); ++key) {
    ASSERT_EQ(reduced.key_of(reduced.vertex_of(key)), key);
    const auto row = reduced.graph().neighbours(key);
    ASSERT_TRUE(std::adjacent_find(row.begin(), row.end(), std::greater_equal<>()) == row.end());
  }
  const SearchResult result = shortest(reduced.graph(), reduced.key_of(start), reduced.key_of(goal));
  ASSERT_EQ(result.status, oracle.status);
  ASSERT_LE(result.expanded, oracle.expanded);
  if (oracle.status != SearchStatus::found) return;
  path = reduced.expand(result.path, on(threads));
  ASSERT_EQ(path.front(), start);
  ASSERT_EQ(path.back(), goal);
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto row = graph.neighbours(path[i - 1]);
    ASSERT_TRUE(std::binary_search(row.begin(), row.end(), path[i]));
    length += edge_length(path[i - 1], path[i]);
  }
  ASSERT_NEAR(length, oracle.length, 1e-9 * oracle.length);
}

void expect_exact(const Graph& graph, VertexId start, VertexId goal) {
  const std::vector<VertexId> keep{start, goal};
  const auto left = peeled_naively(graph, keep);
  const SearchResult oracle = shortest(graph, start, goal);
  const Components labels = bench::plain_components(graph);
  RawVector<VertexId> path_of_one_thread;
  RawVector<VertexId> twice_reduced_path;
  for (const unsigned threads : {1U, 2U, 3U, 8U}) {
    SCOPED_TRACE("threads " + std::to_string(threads));
    const KeyCoverView cover(graph, keep, Peeling::everywhere, on(threads));
    for (VertexId v = 0; v < graph.vertex_count(); ++v) ASSERT_EQ(cover.is_left(v), left[v]) << v;
    RawVector<VertexId> path;
    expect_shortest(graph, reduce_graph(graph, keep, edge_length, on(threads)), start, goal, oracle, threads, path);
    if (threads == 1) path_of_one_thread = path;
    ASSERT_EQ(path, path_of_one_thread);
    const TwiceReducedGraphView twice(graph, keep, edge_length, on(threads));
    ASSERT_EQ(twice.component_count(), labels.count);
    ASSERT_EQ(twice.connected(start, goal), labels.connected(start, goal));
    expect_shortest(graph, twice, start, goal, oracle, threads, path);
    if (threads == 1) twice_reduced_path = path;
    ASSERT_EQ(path, twice_reduced_path);
  }
}

TEST(ReduceGraph, KeepsShortestPathsOfMazes) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    const std::uint32_t side = 5 + static_cast<std::uint32_t>(seed);
    const Graph graph = test::random_maze(seed, side, static_cast<double>(seed % 4) / 10.0, seed % 2 == 0).graph;
    expect_exact(graph, 0, side * side - 1);
    expect_exact(graph, side * side / 2, static_cast<VertexId>(seed));
  }
}

TEST(ReduceGraph, KeepsShortestPathsOfRandomGraphs) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    expect_exact(test::random_graph(seed, 30 + 5 * seed, 36 + 5 * seed + seed * seed / 8).graph, 1, 17);
  }
}

TEST(ReduceGraph, KeepsShortestPathsThroughManyBlocks) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    constexpr std::uint32_t side = 230;  // four blocks
    const Graph graph = test::random_maze(seed, side, static_cast<double>(seed % 3) / 10.0, seed % 2 == 0).graph;
    const auto start = static_cast<VertexId>(seed);
    const VertexId goal = side * side - 1;
    const SearchResult oracle = shortest(graph, start, goal);
    RawVector<VertexId> path_of_one_thread;
    for (const unsigned threads : {1U, 2U, 8U}) {
      RawVector<VertexId> path;
      const TwiceReducedGraphView reduced(graph, std::vector<VertexId>{start, goal}, edge_length, on(threads));
      expect_shortest(graph, reduced, start, goal, oracle, threads, path);
      if (threads == 1) path_of_one_thread = path;
      ASSERT_EQ(path, path_of_one_thread);
    }
  }
}

TEST(ReduceGraph, ReducesByBlocksToNoMoreKeysThanAsAWhole) {
  for (const double loops : {0.0, 0.1, 0.5}) {
    SCOPED_TRACE(loops);
    const Graph graph = test::random_maze(7, 230, loops, true).graph;
    const std::vector<VertexId> keep{0, 230 * 230 - 1};
    const std::size_t keys = KeyCoverView(graph, keep, Peeling::everywhere, on(2)).key_count();
    EXPECT_LE(TwiceReducedGraphView(graph, keep, edge_length, on(2)).graph().vertex_count(), keys);
    EXPECT_GT(KeyCoverView(graph, keep, Peeling::within_blocks, on(2)).key_count(), keys);
  }
}

TEST(ReduceGraph, FollowsDeadEndsThroughManyBlocks) {
  // A comb in bad order: the next vertex of each tooth lies in another block.
  constexpr std::size_t n = 90'000;
  std::vector<VertexId> number(n);
  for (std::size_t i = 0; i < n; ++i) number[i] = static_cast<VertexId>(i * 30'011 % n);
  std::vector<Edge> edges;
  for (std::size_t i = 1; i < n; ++i) edges.push_back({number[i - 1], number[i]});
  edges.push_back({number[10'000], number[20'000]});  // one ring, with a dead end at either side
  const Graph graph = bench::plain_graph(n, edges);
  for (const unsigned threads : {1U, 2U, 8U}) {
    const std::vector<VertexId> keep{number[12'000], number[15'000]};
    const ReducedGraphView reduced = reduce_graph(graph, keep, edge_length, on(threads));
    ASSERT_EQ(reduced.graph().vertex_count(), 2U);  // the junctions have lost their dead ends
    EXPECT_EQ(reduced.graph().edge_count(), 1U);    // the shorter of the ring's two sides
    const auto path =
        reduced.expand(std::vector<VertexId>{reduced.key_of(keep[0]), reduced.key_of(keep[1])}, on(threads));
    ASSERT_EQ(path.size(), 3001U);
    for (std::size_t i = 0; i < path.size(); ++i) ASSERT_EQ(path[i], number[12'000 + i]);
  }
}

TEST(ReduceGraph, OfATreeWithoutKeptVerticesNothingIsLeft) {
  const Graph graph = test::random_maze(3, 40, 0.0, true).graph;
  EXPECT_EQ(KeyCoverView(graph, {}, Peeling::everywhere, on(2)).key_count(), 0U);
  EXPECT_EQ(reduce_graph(graph, {}, edge_length, on(2)).graph().vertex_count(), 0U);
}

TEST(ReduceGraph, OfAPerfectMazeOnlyThePathIsLeft) {
  const Graph graph = test::random_maze(5, 60, 0.0, false).graph;
  const std::vector<VertexId> keep{0, 3599};
  const ReducedGraphView reduced = reduce_graph(graph, keep, edge_length, on(2));
  ASSERT_EQ(reduced.graph().vertex_count(), 2U);
  EXPECT_EQ(reduced.expand(std::vector<VertexId>{0, 1}, on(1)), shortest(graph, 0, 3599).path);
}

TEST(ReduceGraph, CountsComponentsThatHaveNoKey) {
  std::vector<Edge> edges;
  VertexId next = 0;
  const auto ring = [&](VertexId size, bool with_tail) {
    const VertexId first = next;
    for (VertexId i = 0; i < size; ++i) edges.push_back({first + i, first + (i + 1) % size});
    next += size;
    if (with_tail) edges.push_back({first + size / 2, next++});
  };
  ring(3, false);
  ring(100, true);
  ring(40'000, false);  // over three blocks of vertices
  ring(5, true);
  next += 7;  // vertices without an edge
  for (VertexId i = 0; i < 20'000; ++i) edges.push_back({next + i, next + i + 1});
  next += 20'001;
  ring(4, false);
  const VertexId kept = next - 2;
  const Graph graph = bench::plain_graph(next, edges);
  for (const auto& keep :
       {std::vector<VertexId>{}, std::vector<VertexId>{1, kept}, std::vector<VertexId>{50, 60'100}}) {
    const TwiceReducedGraphView reduced(graph, keep, edge_length, on(2));
    EXPECT_EQ(reduced.component_count(), bench::plain_components(graph).count);
    EXPECT_EQ(reduced.component_count(), 13U);
  }
}

TEST(ReduceGraph, RefusesAKeptVertexThatIsNotThere) {
  const Graph graph = test::random_maze(5, 3, 0.0, false).graph;
  EXPECT_THROW(KeyCoverView(graph, std::vector<VertexId>{9}, Peeling::everywhere, on(1)), InputError);
}

}  // namespace
}  // namespace warren
