// SPDX-License-Identifier: BSD-3-Clause
// Kept roadmaps of the planners that draw no samples; what their graphs are: docs/file_formats.md, "What a roadmap is".
// A question needs more than such a graph: that is made anew from the world when the roadmap is opened, and a file
// whose graph is not the one that follows from its world is refused, but for the edges of a large visibility graph.
#pragma once

#include <memory>
#include <optional>
#include <type_traits>

#include "planners/grid/skeleton_planner.hpp"
#include "planners/vertical_cells/cell_planner.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/sampled_roadmap.hpp"

namespace warren {

/// SolveKind::build and open for visibility, cells and voronoi of a point or disc.
BuiltArrays build_geometric(const SolveRequest& request);
std::unique_ptr<RoadmapSession> open_geometric(const SolveRequest& request, const RoadmapArrays& arrays,
                                               const ConnectionRule& rule);

/// The same with what samples a Body, for planners that do.
template <class Body>
BuiltArrays build_sampled_or_geometric(const SolveRequest& request) {
  return is_roadmap_planner(request.planner) ? build_sampled<Body>(request) : build_geometric(request);
}
template <class Body>
std::unique_ptr<RoadmapSession> open_sampled_or_geometric(const SolveRequest& request, const RoadmapArrays& arrays,
                                                          const ConnectionRule& rule) {
  return (is_roadmap_planner(request.planner) ? open_sampled<Body> : open_geometric)(request, arrays, rule);
}

/// Known: VisibilityRoadmap, DiscRoadmap, CellRoadmap, AxisRoadmap or SkeletonRoadmap. Refers to the arrays.
template <class Known>
struct GeometricSession : RoadmapSession {
  explicit GeometricSession(const RoadmapArrays& of) : arrays(of) {}
  std::span<const std::uint64_t> edge_states() const override { return arrays.edge_states; }
  double distance(VertexId from, VertexId to) const override {
    if constexpr (std::is_same_v<Known, CellRoadmap>) return known->points.leg_length(from, to);
    const auto at = [&](VertexId v) { return Vec2{arrays.states[2 * v], arrays.states[2 * v + 1]}; };
    return warren::distance(at(from), at(to));
  }

  const RoadmapArrays& arrays;
  std::optional<Known> known;
};

/// What the kept roadmap that is asked knows; nullptr: none is asked.
template <class Known>
const Known* asked_roadmap(const SolveRequest& request) {
  if (request.asked.session == nullptr) return nullptr;
  return &*static_cast<const GeometricSession<Known>*>(request.asked.session)->known;
}

}  // namespace warren
