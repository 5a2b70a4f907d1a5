// SPDX-License-Identifier: BSD-3-Clause
// Small roadmaps in the plane, written as milestones and edges.
#pragma once

#include <utility>
#include <vector>

#include "core/base/types.hpp"
#include "planners/graph/roadmap_arrays.hpp"

namespace warren::test {

struct Network {
  std::vector<double> states;
  std::vector<EdgeEnd> first;
  std::vector<VertexId> to;
  std::vector<std::uint64_t> edge_states;
  std::vector<VertexId> component;

  RoadmapParts parts() const { return {2, false, states, first, to, edge_states, component}; }
  Vec2 at(VertexId v) const { return {states[2 * v], states[2 * v + 1]}; }
};

struct Link {
  VertexId a, b;
  EdgeState state = EdgeState::free;
};

inline Network network_of(const std::vector<Vec2>& places, const std::vector<Link>& links,
                          std::vector<VertexId> component = {}) {
  Network net;
  for (const Vec2 p : places) net.states.insert(net.states.end(), {p.x, p.y});
  net.component = component.empty() ? std::vector<VertexId>(places.size(), 0) : std::move(component);
  net.edge_states.assign(edge_state_words(2 * links.size()), 0);
  net.first.push_back(0);
  for (VertexId v = 0; v < places.size(); ++v) {
    for (const Link& link : links) {
      if (link.a != v && link.b != v) continue;
      set_edge_state(net.edge_states, net.to.size(), link.state);
      net.to.push_back(link.a == v ? link.b : link.a);
    }
    net.first.push_back(static_cast<EdgeEnd>(net.to.size()));
  }
  return net;
}

}  // namespace warren::test
