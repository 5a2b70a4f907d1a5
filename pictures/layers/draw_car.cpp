// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/draw_car.hpp"

#include "worlds/poses/dubins_curve.hpp"
#include "worlds/poses/reeds_shepp_curve.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {
namespace {

SteeringCurve curve_between(const Se2& a, const Se2& b, const RobotSpec& car) {
  const auto shortest = car.steering == SteeringKind::dubins ? DubinsCurve::shortest : ReedsSheppCurve::shortest;
  return {a, b, shortest(a, b, car.turning_radius), car.turning_radius};
}

void add_curve(PictureLayer& layer, const SteeringCurve& curve) {
  std::vector<Se2> poses{curve.joint(0)};
  append_joints(poses, curve);
  std::vector<Vec2> chain;
  for (const Se2& pose : poses) chain.push_back(pose.position());
  const std::vector<double> turns = leg_turns(poses);
  layer.turns.insert(layer.turns.end(), turns.begin(), turns.end());
  layer.lines.add(chain);
}

/// Each free motion once; where the car can't reverse, in its direction: an edge leads from the vertex in whose row it
/// stands.
std::vector<Edge> motions_of(const PlannedRoadmap<Se2>& roadmap, const RobotSpec& car) {
  if (!roadmap.motions.empty()) return roadmap.motions;
  std::vector<Edge> motions;
  for (VertexId v = 0; v < roadmap.graph.vertex_count(); ++v) {
    for (const VertexId w : roadmap.graph.neighbours(v)) {
      if (car.steering == SteeringKind::dubins || v < w) motions.push_back({v, w});
    }
  }
  return motions;
}

}  // namespace

CarCurves car_curves(std::span<const PlannedRoadmap<Se2>> roadmaps, const RobotSpec& car, const Execution& execution) {
  CarCurves curves{.edges = {.id = "edges", .label = "motion of the roadmap or tree", .color = colors::components[0]},
                   .trees = {.id = "search_tree",
                             .label = "search tree",
                             .part = Part::search,
                             .color = colors::search_tree,
                             .width = widths::search_tree},
                   .milestones = {}};
  std::size_t drawn = 0;
  const auto add = [&](PictureLayer& layer, const Se2& a, const Se2& b) {
    if (++drawn % 256 == 0) execution.check();
    add_curve(layer, curve_between(a, b, car));
  };
  for (const PlannedRoadmap<Se2>& roadmap : roadmaps) {
    const RawVector<Se2>& states = roadmap.states;
    for (const Edge& motion : motions_of(roadmap, car)) add(curves.edges, states[motion.from], states[motion.to]);
    for (const Edge& edge : roadmap.search_tree) {
      if (edge.to != no_vertex) add(curves.trees, states[edge.to], states[edge.from]);
    }
    for (const Se2& state : states) curves.milestones.push_back(state.position());
  }
  return curves;
}

}  // namespace warren
