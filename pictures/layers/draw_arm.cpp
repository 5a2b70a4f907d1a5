// SPDX-License-Identifier: BSD-3-Clause
// The three views stand as in a technical drawing: from above over the one from the front, the one from the side to
// the right of it, the perspective above that. In the projections every solid is the outline of its hull. All arms are
// models: links of solids that stand in the frames of joints. Of a solid balls that go along a line are drawn as they
// are, all else as triangles.

#include "pictures/layers/draw_arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "parallel/asked_memory.hpp"
#include "pictures/model/axis.hpp"
#include "worlds/arms/arm_kinematics.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

constexpr int round_corners = 24;  // of a cylinder

using Shapes = std::vector<SeenSolid>;

void add_face(Shapes& shapes, const Vec3& a, const Vec3& b, const Vec3& c) {
  shapes.push_back({a, b, -1.0, {}, Part::body, c});
}

/// Between two rings of as many corners, seen from outside anticlockwise from below to above; and the lids.
void add_prism(Shapes& shapes, const std::vector<Vec3>& below, const std::vector<Vec3>& above) {
  for (std::size_t i = 0, j = below.size() - 1; i < below.size(); j = i++) {
    add_face(shapes, below[j], below[i], above[i]);
    add_face(shapes, below[j], above[i], above[j]);
    if (i < 2) continue;
    add_face(shapes, below[0], below[i], below[i - 1]);
    add_face(shapes, above[0], above[i - 1], above[i]);
  }
}

/// As it stands in its own frame.
Shapes shapes_of(const Solid& solid) {
  const Vec3 rise{0.0, 0.0, solid.half.z()};
  Shapes shapes;
  if (solid.kind == SolidKind::sphere || solid.kind == SolidKind::capsule) {
    const Vec3 reach = solid.kind == SolidKind::sphere ? Vec3(Vec3::Zero()) : rise;
    shapes.push_back({-reach, reach, solid.half.x(), {}, Part::body});
  } else if (solid.kind == SolidKind::hull) {
    for (const auto& [a, b, c] : solid.faces) add_face(shapes, solid.corners[a], solid.corners[b], solid.corners[c]);
  } else {
    std::vector<Vec3> ring;
    if (solid.kind == SolidKind::box) {
      for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        ring.emplace_back(x * solid.half.x(), y * solid.half.y(), 0.0);
      }
    } else {
      for (const Vec2 p : circle_outline({}, solid.half.x(), round_corners)) ring.emplace_back(p.x, p.y, 0.0);
    }
    std::vector<Vec3> above = ring;
    for (Vec3& p : ring) p -= rise;
    for (Vec3& p : above) p += rise;
    add_prism(shapes, ring, above);
  }
  return shapes;
}

Shapes moved(Shapes shapes, const Eigen::Isometry3d& to) {
  for (SeenSolid& s : shapes) {
    s.a = to * s.a;
    s.b = to * s.b;
    if (s.c) s.c = to * *s.c;
  }
  return shapes;
}

/// Of all solids that only arms meet, each as its shapes.
std::vector<Shapes> obstacles_of(const Scene& scene, const Execution& execution) {
  std::vector<Shapes> all;
  const auto add = [&](Shapes shapes) {
    for (SeenSolid& s : shapes) {
      s.color = colors::blocked_cell;
      s.part = Part::world;
    }
    push_asked(all, std::move(shapes), execution);
    execution.check();
  };
  for (const Sphere& s : scene.spheres) add({{{s.x, s.y, s.z}, {s.x, s.y, s.z}, s.radius}});
  for (const auto& [low, high] : scene.boxes) add({{Vec3(low.data()), Vec3(high.data()), -1.0}});
  for (const Solid& solid : scene.solids) add(moved(shapes_of(solid), solid.pose));
  return all;
}

// An arm along a path in joint space: what its pictures ask.

/// Frames of joints in the order in which a line goes through the tree, and back from where it ends to where it parts.
void walk(const ArmModel& model, int from, std::vector<int>& line, std::size_t& used) {
  line.push_back(from);
  used = line.size();
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (model.joints[j].parent != from) continue;
    walk(model, static_cast<int>(j), line, used);
    line.push_back(from);
  }
}

/// Refers to the path, which has at least one state.
class ArmPath {
 public:
  ArmPath(const ArmModel& model, std::span<const JointState> states) : kinematics_(model), states_(states) {
    for (const ArmLink& link : model.links) {
      for (const Solid& solid : link.solids) solids_.push_back({link.frame + 1, moved(shapes_of(solid), solid.pose)});
    }
    std::size_t used = 0;
    walk(model, base_frame, line_, used);
    line_.resize(used);
    shares_ = lengths_along(states, [this](const JointState& a, const JointState& b) { return distance(a, b); });
  }

  /// A frame is as frames() has it.
  const std::vector<MovingArm::Link>& solids() const { return solids_; }
  std::span<const JointState> states() const { return states_; }
  /// In joint space.
  double length() const { return shares_.back(); }
  /// Of the base, then of each joint.
  std::vector<Eigen::Isometry3d> frames(const JointState& q) const {
    ArmPosture posture;
    kinematics_.place(q, posture);
    std::vector<Eigen::Isometry3d> all;
    for (int number = base_frame; number < static_cast<int>(kinematics_.model().joints.size()); ++number) {
      const MovingFrame& frame = ArmKinematics::frame(posture, number);
      Eigen::Isometry3d& to = all.emplace_back(Eigen::Isometry3d::Identity());
      to.linear() = frame.turn;
      to.translation() = frame.at;
    }
    return all;
  }
  std::vector<Shapes> bodies(const JointState& q) const {
    const std::vector<Eigen::Isometry3d> at = frames(q);
    std::vector<Shapes> all;
    for (const MovingArm::Link& solid : solids_) {
      all.push_back(moved(solid.shapes, at[static_cast<std::size_t>(solid.frame)]));
    }
    return all;
  }
  /// A line through the origins of the frames, and to the tool.
  std::vector<Vec3> spine(const JointState& q) const {
    const std::vector<Eigen::Isometry3d> at = frames(q);
    std::vector<Vec3> points;
    for (const int frame : line_) {
      points.push_back(frame == base_frame ? base() : Vec3(at[static_cast<std::size_t>(frame + 1)].translation()));
      if (frame != kinematics_.model().tool_frame) continue;
      points.push_back(tool(q));
      if (frame != line_.back()) points.push_back(points[points.size() - 2]);
    }
    return points;
  }
  Vec3 base() const { return kinematics_.model().base; }
  Vec3 tool(const JointState& q) const { return kinematics_.tool_pose(q).translation(); }

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
  double distance(const JointState& a, const JointState& b) const {
    double square = 0.0;
    for (std::size_t j = 0; j < kinematics_.size(); ++j) {
      const double way = variable_way(kinematics_.model().variables[j], a[j], b[j]);
      square += way * way;
    }
    return std::sqrt(square);
  }
  JointState between(const JointState& a, const JointState& b, double t) const {
    JointState q{};
    for (std::size_t j = 0; j < kinematics_.size(); ++j) {
      q[j] = a[j] + t * variable_way(kinematics_.model().variables[j], a[j], b[j]);
    }
    return q;
  }

  ArmKinematics kinematics_;
  std::vector<MovingArm::Link> solids_;
  std::vector<int> line_;
  std::span<const JointState> states_;
  std::vector<double> shares_;  // of each state: the length up to it
};

// An arm and its obstacles as solids, seen in perspective.

/// The obstacles alone, seen from the front, the right and above, in `box`. low, high: of all that is to be seen.
SolidView solids_of(const std::vector<Shapes>& obstacles, const Box& box, const Vec3& low, const Vec3& high,
                    const Execution& execution) {
  constexpr double floor_a_reach = 1.3;
  SolidView view{.box = box,
                 .target = 0.5 * (low + high),
                 .azimuth_rad = -0.3 * std::numbers::pi,
                 .rise_rad = 0.13 * std::numbers::pi,
                 .floor = Vec3::Zero()};
  double reach = 0.0;
  const auto include = [&](const Vec3& p, double radius) {
    reach = std::max(reach, (p - view.target).norm() + radius);
  };
  for (const Shapes& shapes : obstacles) {
    execution.check();
    for (const SeenSolid& s : shapes) {
      for_each_point(s, include);
      if (s.radius != 0.0) push_asked(view.solids, s, execution);
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
/// The arm at start and goal and, paler, between them; and the tool's way. radius: five times that of this line.
void add_arm(SolidView& view, const ArmPath& path, double radius, const Execution& execution) {
  constexpr int postures = 5;
  constexpr double trace_pieces = 200.0;
  constexpr unsigned pale = 45;
  const auto add = [&](const JointState& q, Rgb color, double by) {
    execution.check();
    for (const Shapes& shapes : path.bodies(q)) {
      for (SeenSolid s : shapes) {
        s.color = color;
        if (s.radius >= 0.0) s.radius = std::max(by * s.radius, least_radius * view.reach);
        push_asked(view.solids, s, execution);
      }
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

/// Of a convex solid, seen from far.
std::vector<Vec2> outline_of(const Projection& view, const Shapes& shapes) {
  std::vector<Vec2> points;
  for (const SeenSolid& s : shapes) {
    for_each_point(s, [&](const Vec3& p, double radius) {
      const Vec2 at = view.at(p);
      if (!(radius > 0.0)) return points.push_back(at);
      for (const Vec2 corner : circle_outline(at, radius, 64)) points.push_back(corner);
    });
  }
  return convex_hull(std::move(points));
}

class ArmDrawing {
 public:
  /// seen: all states that the views have room for.
  ArmDrawing(const Scene& scene, const ArmPath& seen, const Execution& execution)
      : scene_(scene), execution_(execution), obstacles_(obstacles_of(scene, execution)) {
    measure(seen);
    lay_out();
  }

  Picture draw(const ArmPath& path) const {
    auto stage = std::make_unique<Scene>();
    stage->source = scene_.source;
    for (const Projection& view : views_) add_obstacles(view, *stage);
    const Scene& seen = *stage;
    Picture views{.scene = seen, .stage = std::move(stage)};
    const PictureLayer start = arm_at("start", path, path.states().front(), colors::start);
    views.layers = {start};
    if (path.states().size() > 1) {
      views.layers = {sweep(path), start, arm_at("goal", path, path.states().back(), colors::goal), trace(path)};
    }
    views.solids = solids_of(obstacles_, perspective_, low_, high_, execution_);
    add_arm(*views.solids, path, radius_, execution_);
    views.panels = panels(views.solids->square);
    constexpr double moments = 120.0;
    MovingArm& arm = views.arm.emplace(
        MovingArm{.radius = radius_, .views = {views_.begin(), views_.end()}, .links = path.solids()});
    for (const ArmPath::Place& at : path.places(moments, execution_)) {
      arm.moments.push_back(at.moment);
      arm.spines.push_back(path.spine(at.q));
      arm.tools.push_back(path.tool(at.q));
      arm.frames.push_back(path.frames(at.q));
    }
    return views;
  }

  /// Where the tool is at these, in each view, instead of its trace.
  std::vector<PictureLayer> places(std::span<const Vec3> tools, std::span<const ToolLines> lines) const {
    constexpr std::size_t bytes_a_line = 2 * (2 * sizeof(Vec2) + sizeof(std::uint32_t));  // of lists that double
    std::vector<PictureLayer> layers;
    for (const ToolLines& some : lines) {
      execution_.reserve(views_.size() * some.edges.size() * bytes_a_line);
      PictureLayer& layer = layers.emplace_back(
          PictureLayer{.id = some.id, .label = some.label, .color = some.color, .width = some.width});
      for (const Projection& view : views_) {
        for (std::size_t i = 0; i < some.edges.size(); ++i) {
          execution_.poll(i);
          layer.lines.add(std::array{view.at(tools[some.edges[i].from]), view.at(tools[some.edges[i].to])});
        }
      }
    }
    PictureLayer& dots = layers.emplace_back(PictureLayer{.id = "milestones",
                                                          .label = "tool at a state",
                                                          .swatch = MarkShape::disc,
                                                          .color = colors::outline,
                                                          .width = widths::milestone});
    execution_.reserve(views_.size() * tools.size() * bytes_a_line);
    for (const Projection& view : views_) {
      for (std::size_t i = 0; i < tools.size(); ++i) {
        execution_.poll(i);
        dots.lines.add(std::array{view.at(tools[i]), view.at(tools[i])});
      }
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
    low_ = high_ = seen.base();
    const auto take = [this](const Vec3& p, double radius) { include(p, radius); };
    for (const Shapes& shapes : obstacles_) {
      execution_.check();
      for (const SeenSolid& s : shapes) for_each_point(s, take);
    }
    // Of links with many corners the boxes around them, in their frames.
    std::vector<MovingArm::Link> rough;
    for (const MovingArm::Link& solid : seen.solids()) {
      if (solid.shapes.empty()) continue;
      const bool is_ball = solid.shapes.front().radius >= 0.0;
      if (is_ball) radius_ = std::max(radius_, solid.shapes.front().radius);
      SeenSolid around = solid.shapes.front();
      for (const SeenSolid& s : solid.shapes) {
        if (is_ball) break;
        for (const Vec3& p : {s.a, s.b, *s.c}) {
          around.a = around.a.cwiseMin(p);
          around.b = around.b.cwiseMax(p);
        }
      }
      around.c.reset();
      rough.push_back({solid.frame, {around}});
    }
    constexpr double places = 60.0;
    for (const ArmPath::Place& at : seen.places(places, execution_)) {
      const std::vector<Eigen::Isometry3d> frames = seen.frames(at.q);
      for (const MovingArm::Link& solid : rough) {
        const Eigen::Isometry3d& frame = frames[static_cast<std::size_t>(solid.frame)];
        for_each_point(solid.shapes.front(), [&](const Vec3& p, double radius) { include(frame * p, radius); });
      }
      include(seen.tool(at.q), 0.0);
    }
    include(seen.base(), radius_);
    constexpr double thin = 0.012;
    if (!(radius_ > 0.0)) radius_ = thin * (high_ - low_).maxCoeff();
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
    for (const Shapes& shapes : obstacles_) {
      execution_.check();
      if (shapes.empty() || shapes.front().radius == 0.0) continue;
      stage.polygons.push_back({outline_of(view, shapes)});
      if (stage.polygons.back().corners.size() < 3) stage.polygons.pop_back();
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
      add_outlines(layer, path.bodies(at.q));
    }
    return layer;
  }

  PictureLayer arm_at(const char* id, const ArmPath& path, const JointState& q, Rgb color) const {
    PictureLayer layer{.id = std::string("arm_at_") + id,
                       .label = std::string("arm at the ") + id,
                       .part = Part::body,
                       .color = color,
                       .width = widths::edge,
                       .fill = mixed(color, colors::paper, 45),
                       .opacity = 0.7};
    add_outlines(layer, path.bodies(q));
    return layer;
  }
  void add_outlines(PictureLayer& layer, const std::vector<Shapes>& bodies) const {
    execution_.check();
    for (const Projection& view : views_) {
      for (const Shapes& shapes : bodies) layer.lines.add(outline_of(view, shapes));
    }
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
    for (const Projection& view : views_) {
      std::vector<Vec2> seen;
      for (const Vec3& p : way) seen.push_back(view.at(p));
      layer.lines.add(seen);
    }
    return layer;
  }

  const Scene& scene_;
  const Execution& execution_;
  std::vector<Shapes> obstacles_;
  double radius_ = 0.0;  ///< of lines that stand for the arm
  Vec3 low_;
  Vec3 high_;
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
void add_places(SolidView& view, std::span<const Vec3> tools, std::span<const ToolLines> lines,
                const Execution& execution) {
  std::size_t count = tools.size();
  for (const ToolLines& some : lines) count += some.edges.size();
  execution.reserve(2 * (view.solids.size() + count) * sizeof(SeenSolid));  // two arrays while the solids move
  view.solids.reserve(view.solids.size() + count);
  const auto add = [&](const Vec3& a, const Vec3& b, double radius, Rgb color, double share) {
    constexpr double least_share = 0.6;  // paler ones would be grey in their own shade
    const auto percent = static_cast<unsigned>(100.0 * std::max(share, least_share));
    view.solids.push_back({a, b, radius * view.reach, mixed(color, colors::paper, percent), Part::roadmap});
  };
  for (const ToolLines& some : lines) {
    constexpr double thread = 0.002;
    constexpr double least_thread = 0.0008;  // some pixels still see it
    double ink = 0.0;
    for (std::size_t i = 0; i < some.edges.size(); ++i) {
      execution.poll(i);
      ink += 2.0 * thread * (tools[some.edges[i].to] - tools[some.edges[i].from]).norm() / view.reach;
    }
    const double share = thinned(ink);
    view.is_thinned = view.is_thinned || share < 1.0;
    for (std::size_t i = 0; i < some.edges.size(); ++i) {
      execution.poll(i);
      add(tools[some.edges[i].from], tools[some.edges[i].to], std::max(share * thread, least_thread), some.color,
          share);
    }
  }
  constexpr double bead = 0.008;
  constexpr double least_bead = 0.002;
  const double share = thinned(std::numbers::pi * bead * bead * static_cast<double>(tools.size()));
  for (std::size_t i = 0; i < tools.size(); ++i) {
    execution.poll(i);
    add(tools[i], tools[i], std::max(share * bead, least_bead), colors::outline, share);
  }
}

}  // namespace

Picture arm_roadmap_views(const Scene& scene, const ArmModel& model, const JointState& start,
                          std::span<const JointState> states, std::span<const ToolLines> lines,
                          const Execution& execution) {
  execution.reserve(states.size() * (sizeof(JointState) + 2 * sizeof(Vec3)));
  std::vector<JointState> seen{start};
  seen.insert(seen.end(), states.begin(), states.end());
  const ArmPath all(model, seen);
  const ArmPath stands(model, std::span(seen).first(1));
  const ArmDrawing drawing(scene, all, execution);
  Picture views = drawing.draw(stands);
  std::vector<Vec3> tools;
  for (std::size_t i = 0; i < states.size(); ++i) {
    execution.poll(i);
    tools.push_back(all.tool(states[i]));
  }
  std::vector<PictureLayer> places = drawing.places(tools, lines);
  views.layers.insert(views.layers.begin(), std::move_iterator(places.begin()), std::move_iterator(places.end()));
  add_places(*views.solids, tools, lines, execution);
  return views;
}

Picture arm_views(const Scene& scene, const ArmModel& model, std::span<const JointState> path,
                  const Execution& execution) {
  const ArmPath along(model, path);
  return ArmDrawing(scene, along, execution).draw(along);
}

}  // namespace warren
