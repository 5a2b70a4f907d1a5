// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/assemble_graph.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "bench/plain_graph.hpp"
#include "core/base/rng.hpp"
#include "core/search/graph.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

TEST(UnionForest, HasTheSmallestVertexOfEachComponentAsItsRoot) {
  constexpr std::size_t n = 5000;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<Edge> edges(n * (1 + seed % 4) / 2);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const auto vertex = [&](unsigned axis) { return static_cast<VertexId>(uniform(seed, i, axis) * n); };
      edges[i] = {vertex(0), vertex(1)};
      if (edges[i].from == edges[i].to) edges[i] = {0, 1};
    }
    std::vector<VertexId> parent(n);
    std::iota(parent.begin(), parent.end(), 0U);
    const UnionForest forest(parent);
    for_chunks(edges.size(), 16, {.threads = 8}, [&](Range r) {
      for (std::size_t i = r.first; i < r.last; ++i) forest.join(edges[i].from, edges[i].to);
    });
    const Components plain = bench::plain_components(bench::plain_graph(n, edges));
    for (VertexId v = 0; v < n; ++v) {
      EXPECT_EQ(forest.root_of(v), plain.label[v]);
      EXPECT_EQ(forest.root(v), plain.label[v]);
    }
  }
}

}  // namespace
}  // namespace warren
