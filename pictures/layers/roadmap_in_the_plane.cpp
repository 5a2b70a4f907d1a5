// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/roadmap_in_the_plane.hpp"

#include "parallel/assemble_graph.hpp"

namespace warren {
namespace {

Vec2 position_of(const Se2& state) { return state.position(); }
Vec2 position_of(Vec2 state) { return state; }

template <class State>
PlannedRoadmap<Vec2> joined_in_the_plane(const std::vector<PlannedRoadmap<State>>& roadmaps,
                                         const Execution& execution) {
  PlannedRoadmap<Vec2> plane;
  std::vector<Edge> edges;
  for (const PlannedRoadmap<State>& roadmap : roadmaps) {
    const auto first = static_cast<VertexId>(plane.states.size());
    for (const State& state : roadmap.states) plane.states.push_back(position_of(state));
    for (VertexId v = 0; v < roadmap.graph.vertex_count(); ++v) {
      if (v % 1024 == 0) execution.check();
      for (const VertexId w : roadmap.graph.neighbours(v)) {
        if (v < w) edges.push_back({first + v, first + w});
      }
    }
    for (const Edge& edge : roadmap.search_tree) {
      if (edge.to != no_vertex) plane.search_tree.push_back({first + edge.from, first + edge.to});
    }
  }
  plane.graph = assemble_graph(plane.states.size(), edges, execution);
  return plane;
}

}  // namespace

PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<Se2>>& roadmaps, const Execution& execution) {
  return joined_in_the_plane(roadmaps, execution);
}
PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<Vec2>>& roadmaps, const Execution& execution) {
  return joined_in_the_plane(roadmaps, execution);
}

}  // namespace warren
