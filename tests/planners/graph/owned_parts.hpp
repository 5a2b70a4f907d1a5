// SPDX-License-Identifier: BSD-3-Clause
// A roadmap that owns its arrays, drawn at random, for whoever wants to change some of them. Components by a plain
// search over the free edges.
#pragma once

#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "core/base/rng.hpp"
#include "planners/graph/roadmap_arrays.hpp"

namespace warren::test {

struct OwnedParts {
  bool directed = false;
  std::vector<double> states;
  std::vector<EdgeEnd> first{0};
  std::vector<VertexId> to;
  std::vector<std::uint64_t> edge_states;
  std::vector<VertexId> component;

  RoadmapParts parts() const { return {2, directed, states, first, to, edge_states, component}; }
  std::size_t end_of(VertexId v, VertexId w) const {
    std::size_t end = first[v];
    while (to[end] != w) ++end;
    return end;
  }
  void set(VertexId v, VertexId w, EdgeState state) { set_edge_state(edge_states, end_of(v, w), state); }

  /// The smaller label goes over each free edge until nothing changes.
  void label() {
    component.resize(first.size() - 1);
    std::iota(component.begin(), component.end(), 0U);
    for (bool changed = true; changed;) {
      changed = false;
      for (VertexId v = 0; v < component.size(); ++v) {
        for (std::size_t end = first[v]; end < first[v + 1]; ++end) {
          if (edge_state(edge_states, end) != EdgeState::free || component[v] == component[to[end]]) continue;
          component[v] = component[to[end]] = std::min(component[v], component[to[end]]);
          changed = true;
        }
      }
    }
  }
};

/// Edges as pairs; each has a state that depends on the pair, or on the direction too where `directed`.
inline OwnedParts parts_of(std::size_t n, const std::set<std::pair<VertexId, VertexId>>& edges, bool directed) {
  OwnedParts owned;
  owned.directed = directed;
  for (std::size_t i = 0; i < 2 * n; ++i) owned.states.push_back(static_cast<double>(i) / 3);
  std::set<std::pair<VertexId, VertexId>> ends = edges;
  for (const auto& [v, w] : edges) {
    if (!directed) ends.emplace(w, v);
  }
  owned.first.assign(n + 1, 0);
  for (const auto& [v, w] : ends) {
    owned.to.push_back(w);
    ++owned.first[v + 1];
  }
  std::partial_sum(owned.first.begin(), owned.first.end(), owned.first.begin());
  owned.edge_states.assign(edge_state_words(owned.to.size()), 0);
  for (const auto& [v, w] : ends) owned.set(v, w, static_cast<EdgeState>((v + w + (directed && v < w ? 1 : 0)) % 3));
  owned.label();
  return owned;
}

inline OwnedParts random_parts(std::uint64_t seed, std::size_t n, std::size_t edges, bool directed) {
  std::set<std::pair<VertexId, VertexId>> pairs;
  for (std::size_t i = 0; i < edges; ++i) {
    const auto v = static_cast<VertexId>(uniform(seed, i, 0) * static_cast<double>(n));
    const auto w = static_cast<VertexId>(uniform(seed, i, 1) * static_cast<double>(n));
    if (v != w) pairs.emplace(v, w);
  }
  return parts_of(n, pairs, directed);
}

}  // namespace warren::test
