// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap_search.hpp"

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

}  // namespace warren
