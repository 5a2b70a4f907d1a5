// SPDX-License-Identifier: BSD-3-Clause
#include "core/search/graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "bench/plain_graph.hpp"
#include "core/base/rng.hpp"

namespace warren {
namespace {

std::vector<Edge> random_edges(std::uint64_t seed, std::size_t vertices, std::size_t count) {
  SequentialRng rng(seed);
  std::set<Edge> edges;
  for (std::size_t i = 0; i < count; ++i) {
    const auto a = static_cast<VertexId>(rng.below(vertices));
    const auto b = static_cast<VertexId>(rng.below(vertices));
    if (a != b && !edges.contains({b, a})) edges.insert({a, b});
  }
  return {edges.begin(), edges.end()};
}

TEST(Graph, RowsHoldTheNeighboursOfAnAdjacencyMatrix) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const std::size_t n = 5 + 2 * seed;
    const auto edges = random_edges(seed, n, 3 * n);
    std::vector<std::vector<bool>> joined(n, std::vector<bool>(n, false));
    for (const Edge& e : edges) joined[e.from][e.to] = joined[e.to][e.from] = true;
    const Graph graph = bench::plain_graph(n, edges);
    ASSERT_EQ(graph.vertex_count(), n);
    ASSERT_EQ(graph.edge_count(), edges.size());
    for (VertexId v = 0; v < n; ++v) {
      std::vector<VertexId> expected;
      for (VertexId w = 0; w < n; ++w) {
        if (joined[v][w]) expected.push_back(w);
      }
      ASSERT_TRUE(std::ranges::equal(graph.neighbours(v), expected));
      ASSERT_EQ(graph.degree(v), expected.size());
    }
  }
}

TEST(Graph, WithoutVerticesIsEmpty) {
  EXPECT_EQ(Graph().vertex_count(), 0U);
  EXPECT_EQ(bench::plain_graph(0, {}).edge_count(), 0U);
  EXPECT_EQ(bench::plain_components(Graph()).count, 0U);
}

TEST(Components, LabelsAreTheSmallestVertexThatAFloodReaches) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    const std::size_t n = 10 * seed;
    const Graph graph = bench::plain_graph(n, random_edges(seed, n, n * (seed % 5) / 4));
    const Components found = bench::plain_components(graph);
    std::vector<VertexId> label(n, no_vertex);
    std::size_t count = 0;
    for (VertexId first = 0; first < n; ++first) {
      if (label[first] != no_vertex) continue;
      ++count;
      std::vector<VertexId> open{first};
      label[first] = first;
      while (!open.empty()) {
        const VertexId v = open.back();
        open.pop_back();
        for (const VertexId w : graph.neighbours(v)) {
          if (label[w] == no_vertex) {
            label[w] = first;
            open.push_back(w);
          }
        }
      }
    }
    ASSERT_TRUE(std::ranges::equal(found.label, label));
    ASSERT_EQ(found.count, count);
    ASSERT_EQ(found.size_of(0), static_cast<std::size_t>(std::count(label.begin(), label.end(), 0U)));
    ASSERT_EQ(found.connected(0, static_cast<VertexId>(n - 1)), label[0] == label[n - 1]);
  }
}

}  // namespace
}  // namespace warren
