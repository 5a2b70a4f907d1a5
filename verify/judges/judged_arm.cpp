// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/judged_arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"

namespace warren {
namespace {

bool is_number(const Vec3& v) { return v.cwiseAbs().maxCoeff() <= largest_coordinate && v.allFinite(); }

/// Rodrigues' formula.
SolidFrame turned_about(const Vec3& axis, double angle) {
  const auto [s, c] = portable::sin_and_cos(angle);
  SolidFrame turn;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 e = turn.axes[k];
    turn.axes[k] = c * e + s * axis.cross(e) + (1.0 - c) * axis.dot(e) * axis;
  }
  return turn;
}

void check_frame(int frame, std::size_t joints, const std::string& name) {
  if (frame < base_frame || frame >= as_whole<int>(joints)) {
    throw InputError(name, "must stand in the base or in a joint before it", fmt::format("{}", frame));
  }
}

void check_model(const ArmModel& model) {
  if (model.variables.size() > most_joints || model.joints.size() > most_frames) {
    throw InputError("robot",
                     fmt::format("must have at most {} joints, {} that move on their own", most_frames, most_joints));
  }
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const ArmJoint& joint = model.joints[j];
    const std::string name = fmt::format("robot: joint {}", joint.name);
    check_frame(joint.parent, j, name);
    const bool finite =
        std::abs(joint.multiplier) <= largest_coordinate && std::abs(joint.offset) <= largest_coordinate;
    if (!finite || joint.variable >= model.variables.size()) throw InputError(name, "must follow a variable");
    if (!(std::abs(joint.axis.norm() - 1.0) <= 1e-9)) throw InputError(name, "must have an axis of length 1");
  }
  for (const ArmLink& link : model.links) {
    const std::string name = fmt::format("robot: link {}", link.name);
    check_frame(link.frame, model.joints.size(), name);
    if (link.solids.empty()) throw InputError(name, "must have a solid");
  }
  for (const auto& [a, b] : model.pairs) {
    if (a < model.links.size() && b < model.links.size() && a != b) continue;
    throw InputError("robot", "must have pairs of two of its links", fmt::format("{} {}", a, b));
  }
  check_frame(model.tool_frame, model.joints.size(), "robot: tool");
}

}  // namespace

SolidFrame rigid_frame(const Eigen::Isometry3d& pose, const std::string& name) {
  const Eigen::Matrix3d turn = pose.linear();
  const Eigen::Matrix3d off = turn.transpose() * turn - Eigen::Matrix3d::Identity();
  const bool rigid = off.allFinite() && off.cwiseAbs().maxCoeff() <= 1e-12;
  if (!rigid || !is_number(pose.translation()))
    throw InputError(name, "must have a rigid frame, of numbers up to 1e60");
  return {{turn.col(0), turn.col(1), turn.col(2)}, pose.translation()};
}

SolidCore checked_core(const Solid& solid, SolidFrame& frame, const std::string& name) {
  frame = rigid_frame(solid.pose, name);
  const bool is_hull = solid.kind == SolidKind::hull;
  const bool fits = is_hull
                        ? std::all_of(solid.corners.begin(), solid.corners.end(), is_number) && !solid.corners.empty()
                        : is_number(solid.half) && solid.half.minCoeff() >= 0.0;
  if (!fits)
    throw InputError(name, is_hull ? "must have corners of numbers up to 1e60" : "must have sizes from 0 to 1e60");
  return core_of(solid, frame);
}

JudgedArm::JudgedArm(const ArmModel& model, const Execution& execution) : model_(model) {
  check_model(model);
  std::size_t solids = 0;
  std::size_t corners = 0;
  for (const ArmLink& link : model.links) {
    solids += link.solids.size() + 1;
    for (const Solid& solid : link.solids) corners += solid.corners.size();
  }
  execution.reserve(2 * solids * sizeof(JudgedBody) + corners * sizeof(Vec3));
  bodies_.reserve(solids);
  for (const ArmJoint& joint : model.joints) rigid_frame(joint.origin, fmt::format("robot: joint {}", joint.name));
  rigid_frame(model.tool, "robot: tool");
  for (std::size_t i = 0; i < model.links.size(); ++i) add_link(i);
}

void JudgedArm::add_link(std::size_t link) {
  const ArmLink& from = model_.links[link];
  balls_.push_back(bodies_.size());
  if (from.solids.size() != 1) bodies_.push_back({{}, {}, from.frame, link, bodies_.size() + 1, from.solids.size()});
  Vec3 low = Vec3::Constant(largest_coordinate);
  Vec3 high = -low;
  double reach = 0.0;
  for (const Solid& solid : from.solids) {
    JudgedBody body;
    body.core = checked_core(solid, body.frame, fmt::format("robot: link {}", from.name));
    body.joint = from.frame;
    body.owner = link;
    const Vec3 room = Vec3::Constant(body.core.far + body.core.radius);
    low = low.cwiseMin(body.frame.at - room);
    high = high.cwiseMax(body.frame.at + room);
    reach = std::max(reach, body.frame.at.norm() + body.core.far);
    bodies_.push_back(std::move(body));
  }
  JudgedBody& ball = bodies_[balls_.back()];
  if (ball.parts > 0) {
    ball.frame.at = 0.5 * low + 0.5 * high;
    for (std::size_t i = ball.first_part; i < bodies_.size(); ++i) {
      const JudgedBody& part = bodies_[i];
      const double far = (part.frame.at - ball.frame.at).norm() + part.core.far + part.core.radius;
      ball.core.radius = std::max(ball.core.radius, far * (1.0 + 1e-14));
    }
    reach = std::max(reach, ball.frame.at.norm());
  }
  reach_.push_back(reach * (1.0 + 1e-14));
}

int JudgedArm::joint_behind(int a, int b) const {
  while (a != b) {
    int& later = a > b ? a : b;
    later = model_.joints[as_whole<std::size_t>(later)].parent;
  }
  return a;
}

double JudgedArm::value_of(std::size_t joint, const JointState& q) const {
  return model_.joints[joint].multiplier * q[model_.joints[joint].variable] + model_.joints[joint].offset;
}

void JudgedArm::frames_at(const JointState& from, const JointState& way, double share,
                          std::vector<JudgedFrame>& frames) const {
  frames.resize(model_.joints.size() + 1);
  frames[0] = {};
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    const ArmJoint& joint = model_.joints[j];
    const Eigen::Isometry3d& origin = joint.origin;
    const double rate = joint.multiplier * way[joint.variable];
    const double value = joint.multiplier * (from[joint.variable] + share * way[joint.variable]) + joint.offset;
    const JudgedFrame& parent = frames[as_whole<std::size_t>(joint.parent + 1)];
    const SolidFrame own = parent.frame.frame(
        {{origin.linear().col(0), origin.linear().col(1), origin.linear().col(2)}, origin.translation()});
    const Vec3 axis = joint.axis.normalized();
    const Vec3 line = own.turned(axis);
    JudgedFrame& frame = frames[j + 1];
    frame = {own, parent.spin, parent.drift};
    if (joint.slides) {
      frame.frame.at += value * line;
      frame.drift += rate * line;
    } else {
      frame.frame = own.frame(turned_about(axis, value));
      frame.spin += rate * line;
      frame.drift += rate * own.at.cross(line);
    }
  }
}

std::vector<Sway> JudgedArm::sways(std::span<const double> turns, std::span<const double> values) const {
  const std::size_t row = model_.joints.size() + 1;
  std::vector<Sway> all(model_.links.size() * row);
  for (std::size_t l = 0; l < model_.links.size(); ++l) {
    Sway sway{reach_[l]};
    int j = model_.links[l].frame;
    for (;;) {
      all[l * row + as_whole<std::size_t>(j + 1)] = sway;
      if (j == base_frame) break;
      const ArmJoint& joint = model_.joints[as_whole<std::size_t>(j)];
      const double turn = turns[as_whole<std::size_t>(j)] * (1.0 + 1e-14);
      if (joint.slides) {
        sway.reach += values[as_whole<std::size_t>(j)];
        sway.speed += turn;
      } else {
        sway.bend += turn * (turn * sway.reach + 2.0 * sway.speed);
        sway.speed += turn * sway.reach;
      }
      sway.reach = (sway.reach + joint.origin.translation().norm()) * (1.0 + 1e-14);
      j = joint.parent;
    }
  }
  return all;
}

SolidFrame JudgedArm::tool_at(const JointState& q) const {
  std::vector<JudgedFrame> frames;
  frames_at(q, JointState{}, 0.0, frames);
  return frames[as_whole<std::size_t>(model_.tool_frame + 1)].frame.frame(rigid_frame(model_.tool, "robot: tool"));
}

}  // namespace warren
