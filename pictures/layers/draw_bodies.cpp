// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/draw_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "worlds/poses/steering_curve.hpp"

namespace warren {
namespace {

constexpr double most_outlines = 24.0;
constexpr std::size_t most_bends = 24;
constexpr double faintest = 0.25;  // of the outlines, at the start

std::vector<Vec2> outline_of(const RobotSpec& robot) {
  if (!robot.outline.empty()) return robot.outline;
  std::vector<Vec2> circle;
  constexpr int corners = 64;
  for (int i = 0; i < corners && robot.radius > 0.0; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    circle.push_back({robot.radius * portable::cos(angle), robot.radius * portable::sin(angle)});
  }
  return circle;
}

class BodyDrawing {
 public:
  BodyDrawing(std::span<const Se2> poses, const RobotSpec& robot, BodyMotion motion)
      : poses_(poses), motion_(motion), outline_(outline_of(robot)) {
    for (const Vec2 p : outline_) size_ = std::max(size_, norm(p));
    has_heading_ = motion == BodyMotion::driving || !robot.outline.empty();
    const std::vector<double> lengths =
        leg_lengths(poses, motion == BodyMotion::driving ? leg_turns(poses) : std::vector<double>(poses.size(), 0.0));
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double turn = i == 0 ? 0.0 : std::abs(turn_between(poses[i - 1].theta, poses[i].theta));
      travels_.push_back((i == 0 ? 0.0 : travels_.back()) + lengths[i] +
                         (motion == BodyMotion::straight ? size_ * turn : 0.0));
    }
  }

  std::vector<PictureLayer> layers() {
    const std::vector<Se2> bends = bends_of();
    std::vector<PictureLayer> layers{sweep()};
    const std::string at_bends = motion_ == BodyMotion::driving ? "body where it turns back" : "body at a bend";
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
                          .closed = true,
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
    const auto after = std::upper_bound(travels_.begin(), travels_.end(), travel);
    const std::size_t i =
        std::clamp<std::size_t>(static_cast<std::size_t>(after - travels_.begin()), 1, poses_.size() - 1);
    const double leg = travels_[i] - travels_[i - 1];
    const double share = leg > 0.0 ? std::clamp((travel - travels_[i - 1]) / leg, 0.0, 1.0) : 0.0;
    return motion_ == BodyMotion::driving ? pose_on_leg(poses_[i - 1], poses_[i], share)
                                          : interpolate(poses_[i - 1], poses_[i], share);
  }
  void add_body(PictureLayer& layer, const Se2& pose) const {
    const Rotation turned(pose.theta);
    std::vector<Vec2> corners;
    for (const Vec2 p : outline_) corners.push_back(pose.position() + turned(p));
    layer.lines.add(corners);
  }
  void add_front(PictureLayer& layer, const Se2& pose) const;
  std::vector<Se2> bends_of() const;
  PictureLayer sweep() const;
  PictureLayer filled(const char* id, const std::string& label, Rgb color, std::span<const Se2> poses) const {
    PictureLayer layer{.id = id,
                       .label = label,
                       .part = Part::body,
                       .color = color,
                       .width = 1.4 * widths::edge,
                       .closed = true,
                       .fill = mixed(color, colors::paper, 35),
                       .opacity = 0.75};
    for (const Se2& pose : poses) add_body(layer, pose);
    return layer;
  }

  std::span<const Se2> poses_;
  BodyMotion motion_;
  std::vector<Vec2> outline_;
  double size_ = 0.0;  // of the farthest point
  bool has_heading_ = false;
  std::vector<double> travels_;  // way of the farthest point, at most, until each pose
};

/// A triangle inside, at the end that goes ahead.
void BodyDrawing::add_front(PictureLayer& layer, const Se2& pose) const {
  Box box;
  for (const Vec2 p : outline_) box.include(p);
  const double middle = 0.5 * (box.min.y + box.max.y);
  const double half = 0.16 * std::min(box.width(), box.height());
  const double tip = box.max.x - 0.06 * box.width();
  const Rotation turned(pose.theta);
  std::vector<Vec2> triangle;
  for (const Vec2 p :
       {Vec2{tip, middle}, Vec2{tip - 1.7 * half, middle + half}, Vec2{tip - 1.7 * half, middle - half}}) {
    triangle.push_back(pose.position() + turned(p));
  }
  layer.lines.add(triangle);
}

/// Not too near to each other, nor too many; of a car where it changes between forwards and backwards.
std::vector<Se2> BodyDrawing::bends_of() const {
  std::vector<std::size_t> bends;
  const auto direction = [&](std::size_t leg) {
    const Vec2 way = poses_[leg].position() - poses_[leg - 1].position();
    const Se2 middle = pose_on_leg(poses_[leg - 1], poses_[leg], 0.5);
    return dot(way, Rotation(middle.theta)({1.0, 0.0})) >= 0.0;
  };
  for (std::size_t i = 1; i + 1 < poses_.size(); ++i) {
    if (motion_ == BodyMotion::straight || direction(i) != direction(i + 1)) bends.push_back(i);
  }
  std::vector<Se2> kept;
  const std::size_t apart = bends.size() / most_bends + 1;
  double last = 0.0;
  for (std::size_t k = 0; k < bends.size(); k += apart) {
    const double at = travels_[bends[k]];
    const bool is_apart = at - last >= 0.8 * size_ && travels_.back() - at >= 0.8 * size_;
    if (motion_ == BodyMotion::straight && !is_apart) continue;
    last = at;
    kept.push_back(poses_[bends[k]]);
  }
  return kept;
}

PictureLayer BodyDrawing::sweep() const {
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

}  // namespace

std::vector<PictureLayer> bodies_along(std::span<const Se2> poses, const RobotSpec& robot, BodyMotion motion) {
  if (poses.empty() || (robot.outline.empty() && !(robot.radius > 0.0))) return {};
  return BodyDrawing(poses, robot, motion).layers();
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

}  // namespace warren
