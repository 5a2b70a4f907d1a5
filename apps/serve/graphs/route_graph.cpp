// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/graphs/route_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "apps/serve/graphs/edge_judge.hpp"
#include "apps/serve/http/http_message.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/kept/export_roadmap.hpp"

namespace warren::serve {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw HttpError(400, "bad_graph", "graph", message); }

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

std::vector<RouteEnds> ends_of(const RouteGraph& graph) {
  if (graph.nodes.empty()) refuse("Nav2 loads no route graph without nodes, and this one has none");
  if (graph.edges.empty()) refuse("Nav2 loads no route graph without edges, and this one has none");
  if (graph.nodes.size() > most_route_nodes || graph.edges.size() > most_route_edges) {
    throw HttpError(413, "graph_too_large", "graph",
                    fmt::format("at most {} nodes and {} edges, each one way, are edited here",
                                grouped(most_route_nodes), grouped(most_route_edges)));
  }
  std::map<std::uint32_t, std::size_t> places;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const std::uint32_t id = graph.nodes[i].id;
    if (!places.emplace(id, i).second) refuse(fmt::format("the id {} is given to two nodes", id));
  }
  const auto place_of = [&](std::uint32_t id, const RouteEdge& edge) {
    const auto found = places.find(id);
    if (found == places.end()) refuse(fmt::format("edge {}: there is no node {}", edge.id, id));
    return found->second;
  };
  std::vector<RouteEnds> ends;
  for (const RouteEdge& edge : graph.edges) ends.push_back({place_of(edge.from, edge), place_of(edge.to, edge)});
  return ends;
}

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
