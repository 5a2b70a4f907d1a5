// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/draw_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/solution.hpp"
#include "parallel/asked_memory.hpp"
#include "pictures/layers/draw_cells.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "worlds/poses/steering_curve.hpp"
#include "worlds/rasters/heading_layers.hpp"

namespace warren {
namespace {

constexpr double most_outlines = 24.0;
constexpr std::size_t most_bends = 24;
constexpr double faintest = 0.25;  // of the outlines, at the start

std::vector<Vec2> moved_to(const Se2& pose, std::span<const Vec2> points) {
  const Rotation turned(pose.theta);
  std::vector<Vec2> moved;
  for (const Vec2 p : points) moved.push_back(pose.position() + turned(p));
  return moved;
}

class BodyDrawing {
 public:
  BodyDrawing(std::span<const Se2> poses, const RobotSpec& robot)
      : poses_(poses),
        drives_(robot.kind == RobotKind::car),
        has_heading_(drives_ || !robot.outline.empty()),
        outline_(robot.outline.empty() ? circle_outline({}, robot.radius, 64) : robot.outline),
        size_(outline_reach(outline_)) {
    const std::vector<double> turns = leg_turns(poses);
    const std::vector<double> lengths = leg_lengths(poses, drives_ ? turns : std::vector<double>(poses.size(), 0.0));
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double turned = drives_ ? 0.0 : size_ * std::abs(turns[i]);
      travels_.push_back((i == 0 ? 0.0 : travels_.back()) + lengths[i] + turned);
    }
  }

  std::vector<PictureLayer> layers() {
    const std::vector<Se2> bends = bends_of();
    std::vector<PictureLayer> layers{sweep()};
    const std::string at_bends = drives_ ? "body where it turns back" : "body at a bend";
    layers.push_back(filled("bodies", at_bends, colors::body, bends));
    layers.push_back(filled("body_start", "body at the start", colors::start, {&poses_.front(), 1}));
    layers.push_back(filled("body_goal", "body at the goal", colors::goal, {&poses_.back(), 1}));
    if (has_heading_) {
      PictureLayer fronts{.id = "fronts",
                          .label = "front",
                          .swatch = MarkShape::front,
                          .part = Part::body,
                          .color = colors::wall,
                          .width = 0.0,
                          .fill = colors::wall};
      for (const Se2& pose : bends) add_front(fronts, pose);
      add_front(fronts, poses_.front());
      add_front(fronts, poses_.back());
      layers.push_back(std::move(fronts));
    }
    std::erase_if(layers, [](const PictureLayer& layer) { return layer.lines.empty(); });
    return layers;
  }

 private:
  Se2 pose_at(double travel) const {
    const PlaceOnPath at = place_on_path(travels_, travel);
    const Se2& from = poses_[at.leg];
    const Se2& to = poses_[at.leg + 1];
    return drives_ ? pose_on_leg(from, to, at.share) : interpolate(from, to, at.share);
  }
  void add_body(PictureLayer& layer, const Se2& pose) const { layer.lines.add(moved_to(pose, outline_)); }
  /// A triangle inside, at the end that goes ahead.
  void add_front(PictureLayer& layer, const Se2& pose) const {
    const Box box = box_around(outline_);
    const double middle = 0.5 * (box.min.y + box.max.y);
    const double half = 0.16 * std::min(box.width(), box.height());
    const double tip = box.max.x - 0.06 * box.width();
    const double end = tip - 1.7 * half;
    layer.lines.add(moved_to(pose, std::array{Vec2{tip, middle}, Vec2{end, middle + half}, Vec2{end, middle - half}}));
  }

  /// Not too near to each other, nor too many; of a car where it changes between forwards and backwards.
  std::vector<Se2> bends_of() const {
    std::vector<std::size_t> bends;
    const auto direction = [&](std::size_t leg) {
      const Vec2 way = poses_[leg].position() - poses_[leg - 1].position();
      const Se2 middle = pose_on_leg(poses_[leg - 1], poses_[leg], 0.5);
      return dot(way, Rotation(middle.theta)({1.0, 0.0})) >= 0.0;
    };
    for (std::size_t i = 1; i + 1 < poses_.size(); ++i) {
      if (!drives_ || direction(i) != direction(i + 1)) bends.push_back(i);
    }
    std::vector<Se2> kept;
    const std::size_t apart = bends.size() / most_bends + 1;
    double last = 0.0;
    for (std::size_t k = 0; k < bends.size(); k += apart) {
      const double at = travels_[bends[k]];
      const bool is_apart = at - last >= 0.8 * size_ && travels_.back() - at >= 0.8 * size_;
      if (!drives_ && !is_apart) continue;
      last = at;
      kept.push_back(poses_[bends[k]]);
    }
    return kept;
  }

  PictureLayer sweep() const {
    PictureLayer layer{
        .id = "sweep", .label = "body along the path", .part = Part::body, .color = colors::body, .closed = true};
    const double whole = travels_.back();
    const double count = std::floor(std::min(most_outlines, whole / (0.5 * size_)));
    for (double i = 1.0; i < count; i += 1.0) {
      add_body(layer, pose_at(whole * i / count));
      layer.opacities.push_back(faintest + (1.0 - faintest) * i / count);
    }
    return layer;
  }
  PictureLayer filled(const char* id, const std::string& label, Rgb color, std::span<const Se2> poses) const {
    PictureLayer layer{.id = id,
                       .label = label,
                       .part = Part::body,
                       .color = color,
                       .width = 1.4 * widths::edge,
                       .fill = mixed(color, colors::paper, 35),
                       .opacity = 0.75};
    for (const Se2& pose : poses) add_body(layer, pose);
    return layer;
  }

  std::span<const Se2> poses_;
  bool drives_;  // as a car on straights and arcs; else straight on and turning evenly
  bool has_heading_;
  std::vector<Vec2> outline_;
  double size_;                  // of the farthest point
  std::vector<double> travels_;  // way of the farthest point, at most, until each pose
};

void add_curve(PictureLayer& layer, const Se2& a, const Se2& b, const RobotSpec& car) {
  const auto shortest = car.steering == SteeringKind::dubins        ? DubinsCurve::shortest
                        : car.steering == SteeringKind::reeds_shepp ? ReedsSheppCurve::shortest
                                                                    : DifferentialCurve::shortest;
  const SteeringCurve curve(a, b, shortest(a, b, car.turning_radius), car.turning_radius);
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
std::vector<Edge> motions_of(const PlannedRoadmap<Se2>& roadmap, const RobotSpec& car, const Execution& execution) {
  execution.reserve(roadmap.motions.size() * sizeof(Edge));
  if (!roadmap.motions.empty()) return roadmap.motions;
  std::vector<Edge> motions;
  for (VertexId v = 0; v < roadmap.graph.vertex_count(); ++v) {
    execution.poll(v);
    for (const VertexId w : roadmap.graph.neighbours(v)) {
      if (car.steering == SteeringKind::dubins || v < w) push_asked(motions, {v, w}, execution);
    }
  }
  return motions;
}

constexpr double degree = std::numbers::pi / 180.0;

Vec2 position_of(const Se2& state) { return state.position(); }
Vec2 position_of(Vec2 state) { return state; }

/// From cells into the world.
std::function<Vec2(Vec2)> placed(const HeadingCells& heading) {
  return [&heading, turned = Rotation(heading.yaw_rad)](Vec2 p) { return heading.origin + turned(heading.cell * p); };
}

/// As far as the reference point may be while some of the body is in the bounds, or at the obstacles.
LayerOptions one_layer(const Scene& scene, const RobotSpec& robot, double clearance, const Execution& execution) {
  constexpr double cells = 400.0;
  constexpr double most_cells = 20'000.0;
  constexpr double least_cells = 16.0;
  const double reach = clearance + outline_reach(robot.outline);
  LayerOptions options;
  options.clearance = clearance;
  const Box inner = scene.bounds ? *scene.bounds : obstacle_box(scene, execution);
  if (inner.empty()) return options;
  const Box box = inner.grown(reach);
  options.region = box;
  const double longer = std::max(box.width(), box.height());
  const double shorter = std::min(box.width(), box.height());
  options.grid.cell = std::min(longer / cells, std::max(shorter / least_cells, longer / most_cells));
  return options;
}

/// The label says which share of them is drawn, if not all are.
PictureLayer arrows_of(const std::vector<Se2>& states, std::string id, const std::string& label, double length) {
  constexpr std::size_t most_arrows = 2000;
  const std::size_t apart = (states.size() + most_arrows - 1) / most_arrows;
  std::vector<Se2> drawn;
  for (std::size_t i = 0; i < states.size(); i += apart) drawn.push_back(states[i]);
  PictureLayer layer = heading_arrows(drawn, length);
  layer.id = std::move(id);
  layer.label = drawn.size() < states.size() ? fmt::format("{} ({} of {})", label, drawn.size(), states.size()) : label;
  layer.over_roadmap = true;
  return layer;
}

}  // namespace

std::vector<PictureLayer> bodies_along(std::span<const Se2> poses, const RobotSpec& robot) {
  if (poses.empty() || (robot.outline.empty() && !(robot.radius > 0.0))) return {};
  return BodyDrawing(poses, robot).layers();
}

PictureLayer heading_arrows(std::span<const Se2> poses, double length) {
  PictureLayer layer{.id = "headings", .label = "heading", .color = colors::outline};
  for (const Se2& pose : poses) {
    const Rotation turned(pose.theta);
    const auto at = [&](double x, double y) { return pose.position() + turned(Vec2{x * length, y * length}); };
    layer.lines.add(std::array{pose.position(), at(1.0, 0.0), at(0.7, 0.2), at(1.0, 0.0), at(0.7, -0.2)});
  }
  return layer;
}

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
    constexpr std::size_t bytes_a_curve = 512;
    if (++drawn % 256 == 0) execution.reserve(256 * bytes_a_curve);
    add_curve(layer, a, b, car);
  };
  for (const PlannedRoadmap<Se2>& roadmap : roadmaps) {
    const RawVector<Se2>& states = roadmap.states;
    for (const Edge& motion : motions_of(roadmap, car, execution))
      add(curves.edges, states[motion.from], states[motion.to]);
    for (const Edge& edge : roadmap.search_tree) {
      if (edge.to != no_vertex) add(curves.trees, states[edge.to], states[edge.from]);
    }
    for (const Se2& state : states) push_asked(curves.milestones, state.position(), execution);
  }
  return curves;
}

void check_has_headings(const RobotSpec& robot) {
  if (!robot.outline.empty()) return;
  const char* why = robot.kind == RobotKind::car                                      ? "a round car takes"
                    : robot.kind == RobotKind::point || robot.kind == RobotKind::disc ? "a point and a disc take"
                                                                                      : nullptr;
  if (why == nullptr) throw UsageError("@heading: an arm has joints, and no heading");
  throw UsageError(
      fmt::format("@heading: {} the same room at any heading; it is for polygons and cars with an outline", why));
}

HeadingCells heading_cells(const Scene& scene, const RobotSpec& robot, double clearance, double heading_rad,
                           const Execution& execution) {
  check_has_headings(robot);
  HeadingCells cells;
  cells.yaw_rad = scene.map ? scene.map->yaw_rad : 0.0;
  const double seen_rad = heading_rad - cells.yaw_rad;
  cells.heading_degrees = seen_rad / degree;
  RobotSpec standing{.kind = RobotKind::polygon, .outline = moved_to({0.0, 0.0, seen_rad}, robot.outline)};
  HeadingLayers layers =
      scene.map ? map_layers(*scene.map, standing.outline, 1, clearance, execution)
                : orientation_layers(scene, standing, one_layer(scene, standing, clearance, execution), execution);
  cells.cell = layers.cell;
  const Vec2 corner = layers.origin - 0.5 * layers.cell * Vec2{1.0, 1.0};
  cells.origin = scene.map ? world_point(*scene.map, {0.0, 0.0}) : corner;
  cells.blocked = std::move(layers.bitmaps[layers.standing.front()]);
  return cells;
}

PictureLayer blocked_at_heading(const HeadingCells& heading, const Execution& execution) {
  const double degrees = heading.heading_degrees + heading.yaw_rad / degree;
  PictureLayer layer =
      cells_layer(fmt::format("layer_{:.0f}", degrees), fmt::format("no room at {:.4g} degrees", degrees),
                  heading.blocked, placed(heading), execution);
  layer.fill = colors::no_room;
  layer.blocks = false;
  return layer;
}

PictureLayer arrows_among(const HeadingCells& heading, const Execution& execution) {
  constexpr std::uint32_t most_a_side = 24;
  const std::uint32_t apart = std::max(heading.blocked.width(), heading.blocked.height()) / most_a_side + 1;
  const auto at = placed(heading);
  std::vector<Se2> poses;
  for (std::uint32_t y = apart / 2; y < heading.blocked.height(); y += apart) {
    execution.check();
    for (std::uint32_t x = apart / 2; x < heading.blocked.width(); x += apart) {
      if (heading.blocked.test(x, y)) continue;
      const Vec2 p = at({x + 0.5, y + 0.5});
      poses.push_back({p.x, p.y, heading.yaw_rad + heading.heading_degrees * degree});
    }
  }
  return heading_arrows(poses, 0.6 * apart * heading.cell);
}

std::vector<PictureLayer> state_arrows(std::span<const Se2> states, double heading_rad) {
  constexpr double near_rad = 10.0 * degree;
  std::vector<Se2> near;
  std::vector<Se2> others;
  Box box;
  for (const Se2& state : states) {
    (std::abs(turn_between(heading_rad, state.theta)) <= near_rad ? near : others).push_back(state);
    box.include(state.position());
  }
  if (states.empty()) return {};
  const double extent = std::max(box.width(), box.height());
  const double length =
      std::clamp(extent / std::sqrt(static_cast<double>(states.size())), extent / 60.0, extent / 25.0);
  std::vector<PictureLayer> layers{
      arrows_of(others, "other_headings", "state, turned as its arrow", length),
      arrows_of(near, "near_headings", fmt::format("state turned by {:.4g} ± 10 degrees", heading_rad / degree),
                1.3 * length)};
  layers[1].color = colors::wall;
  layers[1].width = 1.6 * widths::edge;
  return layers;
}

template <class State>
PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<State>>& roadmaps, const Execution& execution) {
  PlannedRoadmap<Vec2> plane;
  std::vector<Edge> edges;
  for (const PlannedRoadmap<State>& roadmap : roadmaps) {
    const auto first = static_cast<VertexId>(plane.states.size());
    for (const State& state : roadmap.states) push_asked(plane.states, position_of(state), execution);
    for (VertexId v = 0; v < roadmap.graph.vertex_count(); ++v) {
      if (v % 1024 == 0) execution.check();
      for (const VertexId w : roadmap.graph.neighbours(v)) {
        if (v < w) push_asked(edges, {first + v, first + w}, execution);
      }
    }
    for (std::size_t i = 0; i < roadmap.search_tree.size(); ++i) {
      execution.poll(i);
      const Edge& edge = roadmap.search_tree[i];
      if (edge.to != no_vertex) push_asked(plane.search_tree, {first + edge.from, first + edge.to}, execution);
    }
  }
  plane.graph = assemble_graph(plane.states.size(), edges, execution);
  return plane;
}
template PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<Se2>>&, const Execution&);
template PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<Vec2>>&, const Execution&);

}  // namespace warren
