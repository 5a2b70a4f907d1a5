// SPDX-License-Identifier: BSD-3-Clause
#include "core/search.hpp"

#include <algorithm>

namespace warren {

std::vector<VertexId> SearchState::path_to(VertexId v) const {
  std::vector<VertexId> path;
  for (; v != no_vertex; v = parent_[v]) path.push_back(v);
  std::reverse(path.begin(), path.end());
  return path;
}

SearchResult breadth_first(const Graph& graph, VertexId start, VertexId goal, SearchState& state) {
  SearchResult result;
  std::vector<VertexId> queue{start};
  state.reach(start, 0.0, no_vertex);
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const VertexId v = queue[head];
    state.close(v);
    ++result.expanded;
    if (v == goal) {
      result.status = SearchStatus::found;
      result.path = state.path_to(v);
      return result;
    }
    for (const VertexId w : graph.neighbours(v)) {
      if (state.reached(w)) continue;
      state.reach(w, state.g(v) + 1.0, v);
      queue.push_back(w);
    }
  }
  return result;
}

SearchResult depth_first(const Graph& graph, VertexId start, VertexId goal, SearchState& state) {
  SearchResult result;
  struct Frame {
    VertexId vertex;
    std::uint32_t next;
  };
  std::vector<Frame> stack{{start, 0}};
  state.reach(start, 0.0, no_vertex);
  ++result.expanded;
  while (!stack.empty()) {
    const auto [v, next] = stack.back();
    if (v == goal) {
      result.status = SearchStatus::found;
      result.path = state.path_to(v);
      return result;
    }
    if (next == graph.degree(v)) {
      stack.pop_back();
      continue;
    }
    ++stack.back().next;
    const VertexId w = graph.neighbours(v)[next];
    if (state.reached(w)) continue;
    state.reach(w, state.g(v) + 1.0, v);
    ++result.expanded;
    stack.push_back({w, 0});
  }
  return result;
}

}  // namespace warren
