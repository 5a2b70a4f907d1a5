// SPDX-License-Identifier: BSD-3-Clause
// The three views stand as in a technical drawing: from above over the one from the front, the one from the side to
// the right of it. A sphere is a circle in all of them, a box a rectangle, a capsule a stadium.
#include "pictures/layers/draw_arm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "worlds/arms/arm_world.hpp"

namespace warren {
namespace {

/// One projection: which axes run right and up, and where its panel stands.
struct Projection {
  std::array<int, 2> axes;
  Vec2 shift;
  Vec2 at(const Vec3& p) const { return shift + Vec2{p[axes[0]], p[axes[1]]}; }
};

std::vector<Vec2> circle(Vec2 centre, double radius) {
  constexpr int corners = 64;
  std::vector<Vec2> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    points.push_back(centre + Vec2{radius * portable::cos(angle), radius * portable::sin(angle)});
  }
  return points;
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

class ArmDrawing {
 public:
  ArmDrawing(const Scene& scene, const DhTable& table, double radius, std::span<const JointState> path)
      : scene_(scene), radius_(radius), chain_(table), links_(links_of(chain_)), path_(path) {
    measure();
    lay_out();
  }
  /// In the views of another drawing.
  ArmDrawing(const Scene& scene, const DhTable& table, double radius, std::span<const JointState> path,
             const ArmDrawing& frame)
      : ArmDrawing(scene, table, radius, path) {
    low_ = frame.low_;
    high_ = frame.high_;
    lay_out();
  }

  /// Where the tool is at these, in each view, instead of its trace.
  std::vector<PictureLayer> places(std::span<const JointState> states, std::span<const ToolLines> lines) const;
  ArmViews draw() const {
    ArmViews views;
    views.stage.source = scene_.source;
    for (const Projection& view : views_) add_obstacles(view, views.stage);
    views.panels = panels();
    views.layers = {sweep(), arm_at("start", path_.front(), colors::start), arm_at("goal", path_.back(), colors::goal),
                    trace()};
    if (path_.size() == 1) views.layers.erase(views.layers.begin() + 2);
    return views;
  }

 private:
  static constexpr double margin = 0.1;  // of the extent

  void include(const Vec3& p, double radius) {
    low_ = low_.cwiseMin(p - Vec3::Constant(radius));
    high_ = high_.cwiseMax(p + Vec3::Constant(radius));
  }
  ChainPosture posture(const JointState& q) const {
    ChainPosture at;
    chain_.place(q, at);
    return at;
  }
  Vec3 tool(const JointState& q) const { return posture(q).points[chain_.point_count() - 1]; }
  /// The path in pieces of about this length in joint space.
  std::vector<JointState> pieces(double length) const;
  double joint_length() const;
  void measure();
  void lay_out();
  void add_obstacles(const Projection& view, Scene& stage) const;
  std::vector<AxesPanel> panels() const;
  PictureLayer sweep() const;
  PictureLayer arm_at(const char* id, const JointState& q, Rgb color) const;
  PictureLayer trace() const;

  const Scene& scene_;
  double radius_;
  SerialChain chain_;
  std::vector<ArmLink> links_;
  std::span<const JointState> path_;
  Vec3 low_ = Vec3::Zero();
  Vec3 high_ = Vec3::Zero();
  double room_ = 1.0;  // around each view
  std::array<Projection, 3> views_;
};

double ArmDrawing::joint_length() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < path_.size(); ++i) {
    double square = 0.0;
    for (std::size_t j = 0; j < most_joints; ++j) square += std::pow(path_[i][j] - path_[i - 1][j], 2.0);
    sum += std::sqrt(square);
  }
  return sum;
}

std::vector<JointState> ArmDrawing::pieces(double length) const {
  std::vector<JointState> states{path_.front()};
  for (std::size_t i = 1; i < path_.size(); ++i) {
    double square = 0.0;
    for (std::size_t j = 0; j < most_joints; ++j) square += std::pow(path_[i][j] - path_[i - 1][j], 2.0);
    const int count = std::max(1, static_cast<int>(std::ceil(std::sqrt(square) / length)));
    for (int k = 1; k <= count; ++k) {
      JointState q;
      const double t = static_cast<double>(k) / count;
      for (std::size_t j = 0; j < most_joints; ++j) q[j] = path_[i - 1][j] + t * (path_[i][j] - path_[i - 1][j]);
      states.push_back(q);
    }
  }
  return states;
}

void ArmDrawing::measure() {
  include(Vec3::Zero(), radius_);
  for (const Sphere& s : scene_.spheres) include({s.x, s.y, s.z}, s.radius);
  for (const auto& [low, high] : scene_.boxes) {
    include({low[0], low[1], low[2]}, 0.0);
    include({high[0], high[1], high[2]}, 0.0);
  }
  constexpr double pieces_a_path = 60.0;
  for (const JointState& q : pieces(std::max(joint_length() / pieces_a_path, 1e-3))) {
    const ChainPosture at = posture(q);
    for (const ArmLink& link : links_) include(at.points[link.to], radius_);
  }
}

void ArmDrawing::lay_out() {
  const Vec3 size = high_ - low_;
  room_ = margin * std::max(size.maxCoeff(), 1e-9);
  const Vec2 right{size.x() + 3.0 * room_, 0.0};
  const Vec2 above{0.0, size.z() + 3.0 * room_};
  views_ = {Projection{{0, 2}, Vec2{-low_.x(), -low_.z()}}, Projection{{0, 1}, above + Vec2{-low_.x(), -low_.y()}},
            Projection{{1, 2}, right + Vec2{-low_.y(), -low_.z()}}};
}

void ArmDrawing::add_obstacles(const Projection& view, Scene& stage) const {
  for (const Sphere& s : scene_.spheres) {
    if (s.radius > 0.0) stage.polygons.push_back({circle(view.at({s.x, s.y, s.z}), s.radius)});
  }
  for (const auto& [low, high] : scene_.boxes) {
    const Vec2 a = view.at({low[0], low[1], low[2]});
    const Vec2 b = view.at({high[0], high[1], high[2]});
    stage.polygons.push_back({{a, {b.x, a.y}, b, {a.x, b.y}}});
  }
}

std::vector<AxesPanel> ArmDrawing::panels() const {
  constexpr std::array<const char*, 3> names{"x", "y", "z"};
  std::vector<AxesPanel> panels;
  const Vec2 room{0.5 * room_, 0.5 * room_};
  for (const Projection& view : views_) {
    panels.push_back({.box = {view.at(low_) - room, view.at(high_) + room},
                      .origin = view.shift,
                      .x_label = names[static_cast<std::size_t>(view.axes[0])],
                      .y_label = names[static_cast<std::size_t>(view.axes[1])]});
  }
  return panels;
}

PictureLayer ArmDrawing::sweep() const {
  constexpr double bodies = 24.0;
  PictureLayer layer{.id = "sweep",
                     .label = "arm along the path",
                     .part = Part::body,
                     .color = colors::body,
                     .width = 0.5 * widths::edge,
                     .closed = true};
  for (const JointState& q : pieces(std::max(joint_length() / bodies, 1e-9))) {
    const ChainPosture at = posture(q);
    for (const Projection& view : views_) {
      for (const ArmLink& link : links_) {
        layer.lines.add(stadium(view.at(at.points[link.from]), view.at(at.points[link.to]), radius_));
      }
    }
  }
  return layer;
}

PictureLayer ArmDrawing::arm_at(const char* id, const JointState& q, Rgb color) const {
  PictureLayer layer{.id = std::string("arm_at_") + id,
                     .label = std::string("arm at the ") + id,
                     .part = Part::body,
                     .color = color,
                     .width = widths::wall};
  const ChainPosture at = posture(q);
  for (const Projection& view : views_) {
    std::vector<Vec2> spine{view.at(at.points[links_.front().from])};
    for (const ArmLink& link : links_) spine.push_back(view.at(at.points[link.to]));
    layer.lines.add(spine);
  }
  return layer;
}

PictureLayer ArmDrawing::trace() const {
  constexpr double pieces_a_path = 400.0;
  PictureLayer layer{.id = "trace",
                     .label = "path of the tool",
                     .part = Part::path,
                     .color = colors::path,
                     .width = 0.6 * widths::path};
  const std::vector<JointState> states = pieces(std::max(joint_length() / pieces_a_path, 1e-9));
  for (const Projection& view : views_) {
    std::vector<Vec2> line;
    for (const JointState& q : states) line.push_back(view.at(tool(q)));
    layer.lines.add(line);
  }
  return layer;
}

std::vector<PictureLayer> ArmDrawing::places(std::span<const JointState> states,
                                             std::span<const ToolLines> lines) const {
  std::vector<Vec3> tools;
  for (const JointState& q : states) tools.push_back(tool(q));
  std::vector<PictureLayer> layers;
  for (const ToolLines& some : lines) {
    PictureLayer& layer =
        layers.emplace_back(PictureLayer{.id = some.id, .label = some.label, .color = some.color, .width = some.width});
    for (const Projection& view : views_) {
      for (const Edge& e : some.edges) layer.lines.add(std::array{view.at(tools[e.from]), view.at(tools[e.to])});
    }
  }
  PictureLayer& dots = layers.emplace_back(PictureLayer{
      .id = "milestones", .label = "tool at a state", .color = colors::outline, .width = widths::milestone});
  for (const Projection& view : views_) {
    for (const Vec3& p : tools) dots.lines.add(std::array{view.at(p), view.at(p)});
  }
  return layers;
}

}  // namespace

ArmViews arm_roadmap_views(const Scene& scene, const DhTable& table, double radius, const JointState& start,
                           std::span<const JointState> states, std::span<const ToolLines> lines) {
  std::vector<JointState> seen{start};
  seen.insert(seen.end(), states.begin(), states.end());
  const ArmDrawing drawing(scene, table, radius, seen);
  ArmViews views = ArmDrawing(scene, table, radius, std::span(seen).first(1), drawing).draw();
  const std::vector<PictureLayer> places = drawing.places(states, lines);
  views.layers.insert(views.layers.begin(), places.begin(), places.end());
  return views;
}

ArmViews arm_views(const Scene& scene, const DhTable& table, double radius, std::span<const JointState> path) {
  return ArmDrawing(scene, table, radius, path).draw();
}

}  // namespace warren
