// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/draw_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/assemble_graph.hpp"

namespace warren {
namespace {

double radius_of(std::span<const Vec2> outline) {
  double radius = 0.0;
  for (const Vec2 p : outline) radius = std::max(radius, norm(p));
  return radius;
}

double travel(const Se2& a, const Se2& b, double radius) {
  return distance(a.position(), b.position()) + radius * std::abs(turn_between(a.theta, b.theta));
}

void add_body(PolygonSet& lines, const Se2& pose, std::span<const Vec2> outline) {
  const Rotation turned(pose.theta);
  std::vector<Vec2> corners;
  for (const Vec2 p : outline) corners.push_back(pose.position() + turned(p));
  lines.add(corners);
}

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

PictureLayer sweep_of(std::span<const Se2> path, std::span<const Vec2> outline) {
  constexpr double most = 400.0;
  PictureLayer layer{.id = "sweep", .part = Part::body, .color = colors::body, .closed = true};
  if (path.empty()) return layer;
  const double radius = radius_of(outline);
  double whole = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) whole += travel(path[i - 1], path[i], radius);
  const double apart = std::max(radius / 3.0, whole / most);
  double due = 0.0;  // way from the leg's first pose to the next outline
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double way = travel(path[i], path[i + 1], radius);
    for (; due < way; due += apart) add_body(layer.lines, interpolate(path[i], path[i + 1], due / way), outline);
    due -= way;
  }
  add_body(layer.lines, path.back(), outline);
  return layer;
}

PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<Se2>>& roadmaps, const Execution& execution) {
  return joined_in_the_plane(roadmaps, execution);
}
PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<Vec2>>& roadmaps, const Execution& execution) {
  return joined_in_the_plane(roadmaps, execution);
}

}  // namespace warren
