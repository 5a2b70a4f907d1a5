// SPDX-License-Identifier: BSD-3-Clause
#include "serve/graphs/built_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "scenes/text/human_units.hpp"
#include "serve/graphs/edge_judge.hpp"
#include "serve/http/http_message.hpp"
#include "solve/roadmaps/export_of_roadmap.hpp"

namespace warren::serve {
namespace {

RobotSpec disc_around(const RobotSpec& robot) {
  if (robot.kind != RobotKind::polygon) return robot;
  RobotSpec disc{.kind = RobotKind::disc};
  for (const Vec2 corner : robot.outline) disc.radius = std::max(disc.radius, norm(corner));
  return disc;
}

void check_size(std::uint64_t nodes, std::uint64_t edge_ends) {
  if (nodes <= most_route_nodes && edge_ends <= most_route_edges) return;
  throw HttpError(413, "graph_too_large", "graph",
                  fmt::format("it has more than {} nodes or {} edges, each one way, which nobody edits by hand; "
                              "'warren build' and 'warren export' write it",
                              grouped(most_route_nodes), grouped(most_route_edges)));
}

/// Node v has id v; the i-th edge has that of all nodes and i.
RouteGraph graph_of(const RoadmapParts& parts, const Execution& execution) {
  check_size(parts.vertex_count(), parts.to.size());
  RouteGraph graph;
  for (VertexId v = 0; v < parts.vertex_count(); ++v) {
    const std::span<const double> state = parts.state(v);
    RouteNode node{.id = v, .at = {state[0], state[1]}};
    if (parts.dimension > 2) node.theta = state[2];
    graph.nodes.push_back(std::move(node));
  }
  auto id = static_cast<std::uint32_t>(parts.vertex_count());
  for (VertexId v = 0; v < parts.vertex_count(); ++v) {
    execution.check();
    for (EdgeEnd end = parts.first[v]; end < parts.first[v + 1]; ++end) {
      if (parts.state_of_end(end) != EdgeState::free) continue;
      const Vec2 from = graph.nodes[v].at;
      const Vec2 to = graph.nodes[parts.to[end]].at;
      graph.edges.push_back({.id = id++, .from = v, .to = parts.to[end], .cost = distance(from, to)});
    }
  }
  return graph;
}

}  // namespace

RouteGraph graph_of_roadmap(const Roadmap& roadmap, const Execution& execution) {
  check_drives_edges(roadmap.robot);
  if (roadmap.lattice == nullptr) return graph_of(roadmap.arrays.parts(), execution);
  check_size(count_states(roadmap), 0);
  const RoadmapArrays arrays = arrays_of(roadmap.lattice->passages(), execution);
  return graph_of(arrays.parts(), execution);
}

void check_has_axis(const Scene& scene, const RobotSpec& robot, double clearance) {
  check_buildable(scene, {.robot = disc_around(robot), .clearance = clearance}, {.planner = PlannerKind::voronoi});
}

Roadmap built_roadmap(const Scene& scene, const RobotSpec& robot, double clearance, const GraphOptions& options,
                      const Execution& execution) {
  const bool is_axis = options.kind == GraphKind::axis;
  const Question body{.robot = is_axis ? disc_around(robot) : robot, .clearance = clearance};
  SolveOptions how{.planner = is_axis ? PlannerKind::voronoi : PlannerKind::prm, .seed = options.seed};
  how.roadmap = {.samples = options.samples, .neighbours = options.neighbours};
  how.validate();
  check_buildable(scene, body, how);
  execution.reserve(scene.walls.size() * sizeof(Segment));
  return build_within(scene, body, how, execution, IndexChoice::none);
}

RouteGraph built_graph(const Scene& scene, const RobotSpec& robot, double clearance, const GraphOptions& options,
                       const Execution& execution) {
  check_drives_edges(robot);
  if (options.samples) check_size(*options.samples, 0);
  return graph_of_roadmap(built_roadmap(scene, robot, clearance, options, execution), execution);
}

}  // namespace warren::serve
