// SPDX-License-Identifier: BSD-3-Clause
// The three views stand as in a technical drawing: from above over the one from the front, the one from the side to
// the right of it, the perspective above that. In the projections a sphere is a circle, a box a rectangle, a capsule a
// stadium.

#include "pictures/layers/draw_arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "pictures/model/axis.hpp"
#include "scenes/scene/scene.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {
namespace {

double joint_distance(const JointState& a, const JointState& b) {
  double square = 0.0;
  for (std::size_t j = 0; j < most_joints; ++j) square += (b[j] - a[j]) * (b[j] - a[j]);
  return std::sqrt(square);
}

JointState between(const JointState& a, const JointState& b, double t) {
  JointState q;
  for (std::size_t j = 0; j < most_joints; ++j) q[j] = a[j] + t * (b[j] - a[j]);
  return q;
}

// An arm along a path in joint space: what its pictures ask.

std::vector<std::size_t> points_apart(const SerialChain& chain) {
  ChainPosture rest;
  chain.place({}, rest);
  std::vector<std::size_t> points{0};
  for (std::size_t i = 1; i < chain.point_count(); ++i) {
    if ((rest.points[i] - rest.points[i - 1]).norm() > 1e-12 * chain.reach()) points.push_back(i);
  }
  return points;
}

/// Refers to the path, which has at least one state.
class ArmPath {
 public:
  ArmPath(const DhTable& table, std::span<const JointState> states)
      : chain_(table), points_(points_apart(chain_)), states_(states), shares_{0.0} {
    for (std::size_t i = 1; i < states.size(); ++i) {
      shares_.push_back(shares_.back() + joint_distance(states[i - 1], states[i]));
    }
  }

  std::span<const JointState> states() const { return states_; }
  /// In joint space.
  double length() const { return shares_.back(); }
  /// The ends of the links, from the base.
  std::vector<Vec3> spine(const JointState& q) const {
    ChainPosture at;
    chain_.place(q, at);
    std::vector<Vec3> ends;
    for (const std::size_t point : points_) ends.push_back(at.points[point]);
    return ends;
  }
  Vec3 tool(const JointState& q) const {
    ChainPosture at;
    chain_.place(q, at);
    return at.points[chain_.point_count() - 1];
  }

  /// Where it is when that share of the length is behind, 0 .. 1.
  JointState at(double moment) const {
    const double way = moment * length();
    std::size_t i = 1;
    while (i + 1 < states_.size() && shares_[i] < way) ++i;
    if (i >= states_.size() || !(shares_[i] > shares_[i - 1])) return states_.front();
    return between(states_[i - 1], states_[i],
                   std::clamp((way - shares_[i - 1]) / (shares_[i] - shares_[i - 1]), 0.0, 1.0));
  }

  struct Place {
    double moment;  ///< the share of the length that is behind, 0 .. 1
    JointState q;
  };
  /// All states, and more between them so that there are about `count` evenly along the path. Throws Stopped.
  std::vector<Place> places(double count, const Execution& execution) const {
    std::vector<Place> all{{0.0, states_.front()}};
    if (!(length() > 0.0)) return all;
    for (std::size_t i = 1; i < states_.size(); ++i) {
      execution.check();
      const double leg = shares_[i] - shares_[i - 1];
      const double parts = std::max(1.0, std::ceil(count * leg / length()));
      for (double part = 1.0; part <= parts; part += 1.0) {
        const double t = part / parts;
        all.push_back({(shares_[i - 1] + t * leg) / length(), between(states_[i - 1], states_[i], t)});
      }
    }
    return all;
  }

 private:
  SerialChain chain_;
  std::vector<std::size_t> points_;  // of the chain, each apart from the one before
  std::span<const JointState> states_;
  std::vector<double> shares_;  // of each state: the length up to it
};

// An arm and its obstacles as solids, seen in perspective.

Vec3 corner(const std::array<double, 3>& c) { return {c[0], c[1], c[2]}; }

/// The obstacles alone, seen from the front, the right and above, in `box`. low, high: of all that is to be seen.
SolidView solids_of(const Scene& scene, const Box& box, const Vec3& low, const Vec3& high, const Execution& execution) {
  constexpr double azimuth_rad = -0.3 * std::numbers::pi;
  constexpr double rise_rad = 0.13 * std::numbers::pi;
  constexpr double floor_a_reach = 1.3;
  SolidView view;
  view.box = box;
  view.azimuth_rad = azimuth_rad;
  view.rise_rad = rise_rad;
  view.target = 0.5 * (low + high);
  execution.reserve((scene.spheres.size() + scene.boxes.size()) * sizeof(SeenSolid));
  double reach = 0.0;
  const auto include = [&](const Vec3& p, double radius) {
    reach = std::max(reach, (p - view.target).norm() + radius);
  };
  for (const Sphere& s : scene.spheres) {
    const Vec3 centre{s.x, s.y, s.z};
    if (s.radius > 0.0) view.solids.push_back({centre, centre, s.radius, colors::blocked_cell, Part::world});
    include(centre, s.radius);
  }
  for (const auto& [from, to] : scene.boxes) {
    view.solids.push_back({corner(from), corner(to), -1.0, colors::blocked_cell, Part::world});
    for (int k = 0; k < 8; ++k) {
      include({(k & 1) != 0 ? from[0] : to[0], (k & 2) != 0 ? from[1] : to[1], (k & 4) != 0 ? from[2] : to[2]}, 0.0);
    }
  }
  // What is not an obstacle is inside of low and high.
  include({low.x(), 0.5 * (low.y() + high.y()), 0.5 * (low.z() + high.z())}, 0.0);
  include({0.5 * (low.x() + high.x()), low.y(), 0.5 * (low.z() + high.z())}, 0.0);
  include({0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), low.z()}, 0.0);
  view.reach = reach > 0.0 ? reach : 1.0;
  view.floor_side = 2.0 * floor_a_reach * view.reach;
  const double half = floor_a_reach * view.reach;
  constexpr double squares = 12.0;
  view.square = tick_step(view.floor_side, squares);
  view.floor = {view.target.x() - half, view.target.y() - half, low.z()};
  return view;
}
/// The arm at start and goal and, paler, between them; and the tool's way. radius: of the links.
void add_arm(SolidView& view, const ArmPath& path, double radius, const Execution& execution) {
  constexpr int postures = 5;
  constexpr double trace_pieces = 200.0;
  constexpr unsigned pale = 45;
  const auto add = [&](const JointState& q, Rgb color, double by) {
    const std::vector<Vec3> spine = path.spine(q);
    const double r = std::max(by * radius, least_radius * view.reach);
    for (std::size_t i = 1; i < spine.size(); ++i) {
      view.solids.push_back({spine[i - 1], spine[i], r, color, Part::body});
    }
  };
  add(path.states().front(), colors::start, 1.0);
  if (path.states().size() == 1) return;
  // Where these stand in start and goal they are under them.
  constexpr double thinner = 0.98;
  for (int k = 1; k <= postures; ++k) {
    add(path.at(static_cast<double>(k) / (postures + 1)), mixed(colors::body, colors::paper, pale), thinner);
  }
  add(path.states().back(), colors::goal, 1.0);
  const std::vector<ArmPath::Place> trace = path.places(trace_pieces, execution);
  const double thin = std::max(0.2 * radius, least_radius * view.reach);
  for (std::size_t i = 1; i < trace.size(); ++i) {
    view.solids.push_back({path.tool(trace[i - 1].q), path.tool(trace[i].q), thin, colors::path, Part::path});
  }
}

/// The outline of a capsule seen from far.
std::vector<Vec2> stadium(Vec2 a, Vec2 b, double radius) {
  constexpr int half = 12;
  const double heading = a == b ? 0.0 : portable::atan2(b.y - a.y, b.x - a.x);
  std::vector<Vec2> points;
  for (const auto& [end, turn] : {std::pair{b, -0.5}, std::pair{a, 0.5}}) {
    for (int i = 0; i <= half; ++i) {
      const double angle = heading + std::numbers::pi * (turn + static_cast<double>(i) / half);
      points.push_back(end + Vec2{radius * portable::cos(angle), radius * portable::sin(angle)});
    }
  }
  return points;
}

std::vector<Vec2> seen_from(const Projection& view, std::span<const Vec3> points) {
  std::vector<Vec2> seen;
  for (const Vec3& p : points) seen.push_back(view.at(p));
  return seen;
}

class ArmDrawing {
 public:
  /// seen: all states that the views have room for.
  ArmDrawing(const Scene& scene, double radius, const ArmPath& seen, const Execution& execution)
      : scene_(scene), radius_(radius), execution_(execution) {
    measure(seen);
    lay_out();
  }

  ArmViews draw(const ArmPath& path) const {
    ArmViews views;
    views.stage.source = scene_.source;
    for (const Projection& view : views_) add_obstacles(view, views.stage);
    const PictureLayer start = arm_at("start", path, path.states().front(), colors::start);
    if (path.states().size() == 1) {
      views.layers = {start};
    } else {
      views.layers = {sweep(path), start, arm_at("goal", path, path.states().back(), colors::goal), trace(path)};
    }
    views.solids = solids_of(scene_, perspective_, low_, high_, execution_);
    add_arm(views.solids, path, radius_, execution_);
    views.panels = panels(views.solids.square);
    constexpr double moments = 120.0;
    views.arm = {.radius = radius_, .views = {views_.begin(), views_.end()}};
    for (const ArmPath::Place& at : path.places(moments, execution_)) {
      views.arm.moments.push_back(at.moment);
      views.arm.spines.push_back(path.spine(at.q));
      views.arm.tools.push_back(path.tool(at.q));
    }
    return views;
  }

  /// Where the tool is at these, in each view, instead of its trace.
  std::vector<PictureLayer> places(std::span<const Vec3> tools, std::span<const ToolLines> lines) const {
    std::vector<PictureLayer> layers;
    constexpr std::size_t lines_a_poll = 1 << 12;
    for (const ToolLines& some : lines) {
      PictureLayer& layer = layers.emplace_back(
          PictureLayer{.id = some.id, .label = some.label, .color = some.color, .width = some.width});
      for (const Projection& view : views_) {
        for (std::size_t i = 0; i < some.edges.size(); ++i) {
          if (i % lines_a_poll == 0) execution_.check();
          layer.lines.add(std::array{view.at(tools[some.edges[i].from]), view.at(tools[some.edges[i].to])});
        }
      }
    }
    PictureLayer& dots = layers.emplace_back(PictureLayer{.id = "milestones",
                                                          .label = "tool at a state",
                                                          .swatch = MarkShape::disc,
                                                          .color = colors::outline,
                                                          .width = widths::milestone});
    for (const Projection& view : views_) {
      for (const Vec3& p : tools) dots.lines.add(std::array{view.at(p), view.at(p)});
    }
    return layers;
  }

 private:
  static constexpr double margin = 0.1;  // of the extent

  void include(const Vec3& p, double radius) {
    low_ = low_.cwiseMin(p - Vec3::Constant(radius));
    high_ = high_.cwiseMax(p + Vec3::Constant(radius));
  }
  void measure(const ArmPath& seen) {
    include(Vec3::Zero(), radius_);
    for (const Sphere& s : scene_.spheres) include({s.x, s.y, s.z}, s.radius);
    for (const auto& [low, high] : scene_.boxes) {
      include(corner(low), 0.0);
      include(corner(high), 0.0);
    }
    constexpr double places = 60.0;
    for (const ArmPath::Place& at : seen.places(places, execution_)) {
      for (const Vec3& end : seen.spine(at.q)) include(end, radius_);
    }
  }
  /// Above the view from the side, and beyond where that is narrow, stands the perspective.
  void lay_out() {
    const Vec3 size = high_ - low_;
    const double extent = std::max(size.maxCoeff(), 1e-9);
    room_ = margin * extent;
    const Vec2 right{size.x() + 3.0 * room_, 0.0};
    const Vec2 above{0.0, size.z() + 3.0 * room_};
    views_ = {Projection{{0, 2}, Vec2{-low_.x(), -low_.z()}}, Projection{{0, 1}, above + Vec2{-low_.x(), -low_.y()}},
              Projection{{1, 2}, right + Vec2{-low_.y(), -low_.z()}}};
    const Vec2 low = right + above - Vec2{0.5 * room_, 0.5 * room_};
    const double side = extent + room_;
    perspective_ = {low, low + Vec2{side, side}};
  }
  void add_obstacles(const Projection& view, Scene& stage) const {
    constexpr std::size_t obstacles_a_poll = 256;
    for (std::size_t i = 0; i < scene_.spheres.size(); ++i) {
      if (i % obstacles_a_poll == 0) execution_.check();
      const Sphere& s = scene_.spheres[i];
      if (s.radius > 0.0) stage.polygons.push_back({circle_outline(view.at({s.x, s.y, s.z}), s.radius, 64)});
    }
    for (const auto& [low, high] : scene_.boxes) {
      const Vec2 a = view.at(corner(low));
      const Vec2 b = view.at(corner(high));
      stage.polygons.push_back({{a, {b.x, a.y}, b, {a.x, b.y}}});
    }
  }
  std::vector<AxesPanel> panels(double square) const {
    constexpr std::array<const char*, 3> names{"x", "y", "z"};
    std::vector<AxesPanel> panels;
    const Vec2 room{0.5 * room_, 0.5 * room_};
    for (const Projection& view : views_) {
      panels.push_back({.box = {view.at(low_) - room, view.at(high_) + room},
                        .origin = view.shift,
                        .x_label = names[static_cast<std::size_t>(view.axes[0])],
                        .y_label = names[static_cast<std::size_t>(view.axes[1])]});
    }
    panels.push_back(
        {.box = perspective_, .y_label = fmt::format("perspective, squares of {:.4g}", square), .has_ticks = false});
    return panels;
  }

  PictureLayer sweep(const ArmPath& path) const {
    constexpr double bodies = 24.0;
    PictureLayer layer{.id = "sweep",
                       .label = "arm along the path",
                       .part = Part::body,
                       .color = colors::body,
                       .width = 0.5 * widths::edge,
                       .closed = true};
    for (const ArmPath::Place& at : path.places(bodies, execution_)) {
      const std::vector<Vec3> spine = path.spine(at.q);
      for (const Projection& view : views_) {
        for (std::size_t i = 1; i < spine.size(); ++i) {
          layer.lines.add(stadium(view.at(spine[i - 1]), view.at(spine[i]), radius_));
        }
      }
    }
    return layer;
  }

  PictureLayer arm_at(const char* id, const ArmPath& path, const JointState& q, Rgb color) const {
    PictureLayer layer{.id = std::string("arm_at_") + id,
                       .label = std::string("arm at the ") + id,
                       .part = Part::body,
                       .color = color,
                       .width = widths::wall};
    const std::vector<Vec3> spine = path.spine(q);
    for (const Projection& view : views_) layer.lines.add(seen_from(view, spine));
    return layer;
  }
  PictureLayer trace(const ArmPath& path) const {
    constexpr double pieces = 400.0;
    PictureLayer layer{.id = "trace",
                       .label = "path of the tool",
                       .part = Part::path,
                       .color = colors::path,
                       .width = 0.6 * widths::path};
    std::vector<Vec3> way;
    for (const ArmPath::Place& at : path.places(pieces, execution_)) way.push_back(path.tool(at.q));
    for (const Projection& view : views_) layer.lines.add(seen_from(view, way));
    return layer;
  }

  const Scene& scene_;
  double radius_;
  const Execution& execution_;
  Vec3 low_ = Vec3::Zero();
  Vec3 high_ = Vec3::Zero();
  double room_ = 1.0;  // around each view
  std::array<Projection, 3> views_;
  Box perspective_;
};

/// How much thinner and paler balls and threads become whose ink would cover the view: the root of the share of it that
/// they may cover, at most 1. ink: square reaches.
double thinned(double ink) {
  constexpr double allowed = 0.3 * 4.0;
  return ink > allowed ? std::sqrt(allowed / ink) : 1.0;
}

/// The same in the perspective: edges as threads, states as beads.
class Places {
 public:
  Places(SolidView& view, std::span<const Vec3> tools, const Execution& execution)
      : view_(view), tools_(tools), execution_(execution) {}

  void add(std::span<const ToolLines> lines) {
    std::size_t count = tools_.size();
    for (const ToolLines& some : lines) count += some.edges.size();
    execution_.reserve(2 * (view_.solids.size() + count) * sizeof(SeenSolid));  // two arrays while the solids move
    view_.solids.reserve(view_.solids.size() + count);
    for (const ToolLines& some : lines) add_threads(some);
    constexpr double bead = 0.008;
    constexpr double least_bead = 0.002;
    const double share = thinned(std::numbers::pi * bead * bead * static_cast<double>(tools_.size()));
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      if (i % edges_a_poll == 0) execution_.check();
      const Vec3& p = tools_[i];
      add_solid(p, p, std::max(share * bead, least_bead), colors::outline, share);
    }
  }

 private:
  void add_threads(const ToolLines& some) {
    constexpr double thread = 0.002;
    constexpr double least_thread = 0.0008;  // some pixels still see it
    double ink = 0.0;
    for (std::size_t i = 0; i < some.edges.size(); ++i) {
      if (i % edges_a_poll == 0) execution_.check();
      ink += 2.0 * thread * (tools_[some.edges[i].to] - tools_[some.edges[i].from]).norm() / view_.reach;
    }
    const double share = thinned(ink);
    view_.is_thinned = view_.is_thinned || share < 1.0;
    for (std::size_t i = 0; i < some.edges.size(); ++i) {
      if (i % edges_a_poll == 0) execution_.check();
      add_solid(tools_[some.edges[i].from], tools_[some.edges[i].to], std::max(share * thread, least_thread),
                some.color, share);
    }
  }

  void add_solid(const Vec3& a, const Vec3& b, double radius, Rgb color, double share) {
    constexpr double least_share = 0.6;  // paler ones would be grey in their own shade
    const auto percent = static_cast<unsigned>(100.0 * std::max(share, least_share));
    view_.solids.push_back({a, b, radius * view_.reach, mixed(color, colors::paper, percent), Part::roadmap});
  }

  static constexpr std::size_t edges_a_poll = 1 << 12;
  SolidView& view_;
  std::span<const Vec3> tools_;
  const Execution& execution_;
};

}  // namespace

ArmViews arm_roadmap_views(const Scene& scene, const DhTable& table, double radius, const JointState& start,
                           std::span<const JointState> states, std::span<const ToolLines> lines,
                           const Execution& execution) {
  std::vector<JointState> seen{start};
  seen.insert(seen.end(), states.begin(), states.end());
  const ArmPath all(table, seen);
  const ArmPath stands(table, std::span(seen).first(1));
  const ArmDrawing drawing(scene, radius, all, execution);
  ArmViews views = drawing.draw(stands);
  std::vector<Vec3> tools;
  constexpr std::size_t states_a_poll = 1 << 10;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i % states_a_poll == 0) execution.check();
    tools.push_back(all.tool(states[i]));
  }
  const std::vector<PictureLayer> places = drawing.places(tools, lines);
  views.layers.insert(views.layers.begin(), places.begin(), places.end());
  Places(views.solids, tools, execution).add(lines);
  return views;
}

ArmViews arm_views(const Scene& scene, const DhTable& table, double radius, std::span<const JointState> path,
                   const Execution& execution) {
  const ArmPath along(table, path);
  return ArmDrawing(scene, radius, along, execution).draw(along);
}

}  // namespace warren
