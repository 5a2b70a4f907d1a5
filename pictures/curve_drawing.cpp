// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/curve_drawing.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace warren {
namespace {

/// Adds one body to the layer: its outline, or a circle of two halves.
void add_body(PictureLayer& layer, const Se2& pose, const RobotSpec& robot) {
  std::vector<Vec2> corners;
  if (robot.outline.empty()) {
    const Vec2 off{robot.radius, 0.0};
    corners = {pose.position() + off, pose.position() - off, pose.position() + off};
    layer.turns.insert(layer.turns.end(), {0.0, std::numbers::pi, std::numbers::pi});
  } else {
    const Rotation turned(pose.theta);
    for (const Vec2 p : robot.outline) corners.push_back(pose.position() + turned(p));
    layer.turns.insert(layer.turns.end(), corners.size(), 0.0);
  }
  layer.lines.add(corners);
}

double size_of(const RobotSpec& robot) {
  double size = robot.radius;
  for (const Vec2 p : robot.outline) size = std::max(size, norm(p));
  return size;
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

/// Each free motion once; one_way: in its direction.
std::vector<Edge> motions_of(const Roadmap<Se2>& roadmap, bool one_way) {
  if (!roadmap.motions.empty()) return roadmap.motions;
  std::vector<Edge> motions;
  for (VertexId v = 0; v < roadmap.graph.vertex_count(); ++v) {
    for (const VertexId w : roadmap.graph.neighbours(v)) {
      if (one_way || v < w) motions.push_back({v, w});
    }
  }
  return motions;
}

}  // namespace

void append_joints(std::vector<Se2>& poses, const SteeringCurve& curve) {
  constexpr double most_rad = 0.5 * std::numbers::pi * (1.0 + 1e-9);
  double begin = 0.0;
  for (std::size_t i = 0; i < curve.piece_count(); ++i) {
    const SteeringPiece& piece = curve.piece(i);
    const double parts =
        piece.steer == Steer::straight ? 1.0 : std::max(1.0, std::ceil(std::abs(piece.length) / most_rad));
    for (double part = 1.0; part < parts; part += 1.0) {
      poses.push_back(curve.at(begin + curve.piece_length(i) * part / parts));
    }
    begin += curve.piece_length(i);
    Se2 joint = curve.joint(i + 1);
    if (i + 1 < curve.piece_count()) joint.theta = wrapped_angle(joint.theta);
    poses.push_back(joint);
  }
}

std::vector<double> leg_turns(std::span<const Se2> poses) {
  std::vector<double> turns(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) turns[i] = turn_between(poses[i - 1].theta, poses[i].theta);
  return turns;
}

std::vector<double> leg_lengths(std::span<const Se2> poses, std::span<const double> turns) {
  std::vector<double> lengths(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double chord = distance(poses[i - 1].position(), poses[i].position());
    const double half = 0.5 * turns[i];
    lengths[i] = half == 0.0 ? chord : chord * half / std::sin(half);
  }
  return lengths;
}

std::vector<double> path_turns(const RobotSpec& robot, const StateList& states) {
  if (robot.kind != RobotKind::car || states.width != 3) return {};
  std::vector<Se2> poses;
  for (std::size_t i = 0; i < states.size(); ++i) poses.push_back({states[i][0], states[i][1], states[i][2]});
  return leg_turns(poses);
}

void draw_curves(Drawing& drawing, const std::vector<Roadmap<Se2>>& roadmaps, bool one_way, const CurveBetween& curve,
                 const Execution& execution) {
  PictureLayer edges{"edges", colors::components[0], widths::edge, {}};
  PictureLayer trees{"search_tree", colors::search_tree, widths::search_tree, {}};
  std::size_t drawn = 0;
  for (const Roadmap<Se2>& roadmap : roadmaps) {
    for (const Edge& motion : motions_of(roadmap, one_way)) {
      if (++drawn % 256 == 0) execution.check();
      add_curve(edges, curve(roadmap.states[motion.from], roadmap.states[motion.to]));
    }
    for (const Edge& edge : roadmap.search_tree) {
      if (++drawn % 256 == 0) execution.check();
      if (edge.to != no_vertex) add_curve(trees, curve(roadmap.states[edge.to], roadmap.states[edge.from]));
    }
    for (const Se2& state : roadmap.states) drawing.roadmap.states.push_back(state.position());
  }
  drawing.roadmap.graph = Graph::from_edges(drawing.roadmap.states.size(), {});
  drawing.layers.push_back(std::move(edges));
  drawing.layers.push_back(std::move(trees));
}

Se2 pose_on_leg(const Se2& a, const Se2& b, double t) {
  constexpr double no_turn = 1e-9;
  if (t <= 0.0) return a;
  if (t >= 1.0) return b;
  const double turn = turn_between(a.theta, b.theta);
  if (std::abs(turn) < no_turn) return interpolate(a, b, t);
  // A part of an arc is a chord along the heading halfway, as the whole is.
  const double share = std::sin(0.5 * t * turn) / std::sin(0.5 * turn);
  const Rotation back(0.5 * (t - 1.0) * turn);
  const Vec2 p = a.position() + share * back(b.position() - a.position());
  return {p.x, p.y, wrapped_angle(a.theta + t * turn)};
}

PictureLayer car_sweep(std::span<const Se2> poses, const RobotSpec& robot) {
  constexpr double most = 400.0;
  PictureLayer layer{"sweep", colors::second_layer, widths::edge, {}, true};
  if (poses.empty() || !(size_of(robot) > 0.0)) return layer;
  const std::vector<double> lengths = leg_lengths(poses, leg_turns(poses));
  const double whole = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  const double apart = std::max(size_of(robot) / 3.0, whole / most);
  double next = 0.0;  // on the leg at hand
  for (std::size_t i = 1; i < poses.size(); ++i) {
    for (; next < lengths[i]; next += apart) {
      add_body(layer, pose_on_leg(poses[i - 1], poses[i], next / lengths[i]), robot);
    }
    next -= lengths[i];
  }
  add_body(layer, poses.back(), robot);
  return layer;
}

}  // namespace warren
