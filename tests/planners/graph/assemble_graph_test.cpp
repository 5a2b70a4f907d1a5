// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/assemble_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "bench/plain_graph.hpp"
#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "tests/parallel/on_threads.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using test::on;

/// Up to `count` different edges; reach bounds to - from (0: any).
std::vector<Edge> random_edges(std::uint64_t seed, std::size_t vertices, std::size_t count, std::size_t reach) {
  SequentialRng rng(seed);
  std::set<Edge> edges;
  for (std::size_t i = 0; i < count && vertices > 1; ++i) {
    auto a = static_cast<VertexId>(rng.below(vertices));
    auto b = static_cast<VertexId>(reach == 0 ? rng.below(vertices) : std::min(vertices - 1, a + rng.below(reach)));
    if (a != b) edges.insert({std::min(a, b), std::max(a, b)});
  }
  return {edges.begin(), edges.end()};
}

/// Cuts the edges into parts at borders of `from`, some of them empty.
std::vector<RawVector<Edge>> split(const std::vector<Edge>& edges, std::size_t span) {
  std::vector<RawVector<Edge>> parts;
  for (const Edge& e : edges) {
    parts.resize(std::max<std::size_t>(parts.size(), e.from / span + 1));
    parts[e.from / span].push_back(e);
  }
  return parts;
}

void expect_same(const Graph& graph, const Graph& oracle) {
  ASSERT_EQ(graph.vertex_count(), oracle.vertex_count());
  ASSERT_EQ(graph.edge_count(), oracle.edge_count());
  for (VertexId v = 0; v < graph.vertex_count(); ++v) {
    ASSERT_TRUE(std::ranges::equal(graph.neighbours(v), oracle.neighbours(v))) << "row " << v;
  }
}

struct Case {
  std::size_t vertices, edges, reach, span;
};
constexpr Case cases[] = {{0, 0, 0, 1},           {1, 0, 0, 1},
                          {5, 6, 0, 2},           {300, 900, 0, 7},
                          {40000, 80000, 0, 999}, {70000, 140000, 9, 256},
                          {16384, 30000, 40, 64}, {16385, 30000, 0, 20000}};

TEST(AssembleGraph, OrderedPartsGiveTheSameRowsAsTheSerialBuilder) {
  for (const Case& c : cases) {
    for (const std::uint64_t seed : test::seeds(4)) {
      SCOPED_TRACE("vertices " + std::to_string(c.vertices) + " seed " + std::to_string(seed));
      const auto edges = random_edges(seed, c.vertices, c.edges, c.reach);
      const Graph oracle = bench::plain_graph(c.vertices, edges);
      for (const unsigned threads : {1U, 2U, 3U, 8U}) {
        expect_same(assemble_graph(c.vertices, split(edges, c.span), on(threads)), oracle);
      }
    }
  }
}

TEST(AssembleGraph, AnyOrderOfEdgesAndEndsIsAccepted) {
  for (const std::uint64_t seed : test::seeds(20, 4)) {
    SCOPED_TRACE(seed);
    const std::size_t n = seed % 2 == 0 ? 50 : 40000;
    auto edges = random_edges(seed, n, 2 * n, 0);
    const Graph oracle = bench::plain_graph(n, edges);
    SequentialRng rng(seed);
    for (std::size_t i = edges.size(); i > 1; --i) {  // from a random place on: shuffled and turned round
      const std::size_t first = seed * edges.size() / 21;
      if (i <= first + 1) break;
      std::swap(edges[i - 1], edges[first + rng.below(i - first)]);
      if (rng.below(2) == 0) std::swap(edges[i - 1].from, edges[i - 1].to);
    }
    std::vector<RawVector<Edge>> parts(1);
    for (const Edge& e : edges) {
      if (rng.below(500) == 0) parts.emplace_back();
      parts.back().push_back(e);
    }
    for (const unsigned threads : {1U, 3U}) expect_same(assemble_graph(n, parts, on(threads)), oracle);
  }
}

TEST(AssembleGraph, EdgesOfStartAndGoalMayFollowAsALastPart) {
  const std::size_t n = 20000;
  const auto edges = random_edges(7, n, 2 * n, 30);
  auto parts = split(edges, 512);
  parts.push_back({{3, 20000}, {19000, 20000}, {5, 20001}, {20000, 20001}});
  std::vector<Edge> all = edges;
  all.insert(all.end(), parts.back().begin(), parts.back().end());
  expect_same(assemble_graph(n + 2, parts, on(2)), bench::plain_graph(n + 2, all));
}

TEST(AssembleGraph, TargetsOutOfOrderWithinARowAreSorted) {
  const std::vector<RawVector<Edge>> parts{{{0, 3}, {0, 1}, {0, 2}, {1, 3}, {1, 2}}};
  expect_same(assemble_graph(4, parts, on(1)),
              bench::plain_graph(4, std::vector<Edge>(parts[0].begin(), parts[0].end())));
}

TEST(AssembleGraph, LengthsStandBesideTheirEdges) {
  const std::vector<RawVector<Edge>> parts{{{0, 2}, {1, 2}}};
  const auto length = [](VertexId v, VertexId w) { return 10.0 * v + w; };
  const Graph graph = with_lengths(assemble_graph(3, parts, on(2)), on(2), length);
  ASSERT_TRUE(graph.has_lengths());
  EXPECT_EQ(graph.lengths(2)[0], 20.0);
  EXPECT_EQ(graph.lengths(2)[1], 21.0);
  EXPECT_EQ(graph.lengths(0)[0], 2.0);
}

TEST(AssembleGraph, BadEdgesAreNamed) {
  const auto message = [](const std::vector<RawVector<Edge>>& parts) {
    return test::refusal<InputError>([&] { assemble_graph(3, parts, on(1)); });
  };
  EXPECT_EQ(message({{{0, 3}}}), "graph: an edge's end is not a vertex (found: 3)");
  EXPECT_EQ(message({{{0, 1}}, {{2, 2}}}), "graph: an edge joins a vertex to itself");
}

TEST(AssembleGraph, StopsAtItsDeadline) {
  const Deadline over(-1.0);
  Execution execution = on(2);
  execution.deadline = &over;
  const std::vector<RawVector<Edge>> parts{{{0, 1}}};
  EXPECT_THROW(assemble_graph(2, parts, execution), Stopped);
}

TEST(ParallelComponents, EqualTheSerialOnes) {
  for (const std::uint64_t seed : test::seeds(24, 6)) {
    SCOPED_TRACE(seed);
    const std::size_t n = seed % 3 == 0 ? 60000 : 200 * seed;
    const std::size_t reach = seed % 2 == 0 ? 0 : 50;
    const Graph graph = bench::plain_graph(n, random_edges(seed, n, n * (seed % 4 + 1) / 3, reach));
    const Components oracle = bench::plain_components(graph);
    for (const unsigned threads : {1U, 2U, 3U, 8U}) {
      const Components found = components(graph, on(threads));
      ASSERT_EQ(found.label, oracle.label);
      ASSERT_EQ(found.count, oracle.count);
    }
  }
}

TEST(ParallelComponents, OneLongPathInBadOrderIsOneComponent) {
  const std::size_t n = 100000;  // neighbours lie far apart, so that nearly every edge leaves its block
  std::vector<Edge> edges;
  for (std::size_t i = 1; i < n; ++i) {
    const auto a = static_cast<VertexId>((i - 1) * 61607 % n);
    const auto b = static_cast<VertexId>(i * 61607 % n);
    edges.push_back({std::min(a, b), std::max(a, b)});
  }
  const Graph graph = bench::plain_graph(n, edges);
  for (const unsigned threads : {1U, 2U, 8U}) {
    const Components found = components(graph, on(threads));
    EXPECT_EQ(found.count, 1U);
    EXPECT_EQ(*std::max_element(found.label.begin(), found.label.end()), 0U);
  }
}

}  // namespace
}  // namespace warren
