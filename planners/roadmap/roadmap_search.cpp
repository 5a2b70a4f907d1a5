// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap/roadmap_search.hpp"

#include <numeric>

namespace warren {

std::vector<Edge> search_tree(const SearchState& state) {
  std::vector<Edge> tree;
  for (const VertexId v : state.touched()) {
    if (state.parent(v) != no_vertex) tree.push_back({v, state.parent(v)});
  }
  return tree;
}

std::vector<Edge> search_trees(const SearchState& forward, const SearchState& backward) {
  std::vector<Edge> tree = search_tree(forward);
  for (const Edge& e : search_tree(backward)) {
    if (!forward.reached(e.from)) tree.push_back(e);
  }
  return tree;
}

namespace detail {

bool is_stringy(const Graph& graph, const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 16;
  const std::size_t n = graph.vertex_count();
  std::vector<std::size_t> counts(chunk_count(n, grain), 0);
  for_chunks(n, grain, execution, [&](Range r) {
    std::size_t count = 0;
    for (std::size_t v = r.first; v < r.last; ++v) {
      count += static_cast<std::size_t>(graph.neighbours(static_cast<VertexId>(v)).size() <= 2);
    }
    counts[r.first / grain] = count;
  });
  return 2 * std::accumulate(counts.begin(), counts.end(), std::size_t{0}) >= n;
}

std::vector<Edge> expanded_tree(const TwiceReducedGraphView& reduced, const std::vector<Edge>& keys,
                                const Execution& execution) {
  std::vector<Edge> tree;
  for (const Edge& e : keys) {
    const RawVector<VertexId> chain = reduced.expand(std::array{e.from, e.to}, execution);
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) tree.push_back({chain[i], chain[i + 1]});
  }
  return tree;
}

}  // namespace detail

}  // namespace warren
