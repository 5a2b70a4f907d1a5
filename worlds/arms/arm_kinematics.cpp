// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/arm_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"

namespace warren {
namespace {

std::size_t frame_number(int frame) { return as_whole<std::size_t>(frame); }

/// Whoever made the model has told users what is wrong with their files; here no number may name what is not there.
void check_model(const ArmModel& model) {
  const std::size_t variables = model.variables.size();
  const int joints = as_whole<int>(model.joints.size());
  bool is_whole = variables >= 1 && variables <= most_joints && model.joints.size() <= most_frames &&
                  model.tool_frame >= base_frame && model.tool_frame < joints;
  for (const ArmVariable& variable : model.variables) is_whole &= variable.low <= variable.high;
  for (int j = 0; j < joints; ++j) {
    const ArmJoint& joint = model.joints[frame_number(j)];
    is_whole &= joint.parent >= base_frame && joint.parent < j && joint.variable < variables;
    is_whole &= std::abs(joint.axis.norm() - 1.0) < 1e-9;
  }
  for (const ArmLink& link : model.links) is_whole &= link.frame >= base_frame && link.frame < joints;
  for (const LinkPair& pair : model.pairs) is_whole &= pair[0] < pair[1] && pair[1] < model.links.size();
  if (!is_whole) throw InputError("arm", "must be a tree of at most 32 joints that 1 to 14 variables move", model.name);
}

/// The turn about an axis of length 1.
Eigen::Matrix3d turn_about(const Vec3& axis, double angle) {
  const auto [sine, cosine] = portable::sin_and_cos(angle);
  const Vec3 swept = sine * axis;
  Eigen::Matrix3d turn = ((1.0 - cosine) * axis) * axis.transpose();
  turn.diagonal().array() += cosine;
  turn(0, 1) -= swept.z();
  turn(1, 0) += swept.z();
  turn(0, 2) += swept.y();
  turn(2, 0) -= swept.y();
  turn(1, 2) -= swept.x();
  turn(2, 1) += swept.x();
  return turn;
}

/// From the frame before a joint to the one behind it.
void pass_joint(const ArmJoint& joint, const JointState& q, Eigen::Matrix3d& turn, Vec3& at) {
  const double value = joint.multiplier * q[joint.variable] + joint.offset;
  at = turn * joint.origin.translation() + at;
  turn *= joint.origin.linear();
  if (joint.slides) {
    at += turn * (value * joint.axis);
  } else {
    turn *= turn_about(joint.axis, value);
  }
}

}  // namespace

ArmKinematics::ArmKinematics(ArmModel model) : model_(std::move(model)) {
  check_model(model_);
  std::vector<double> reach(model_.joints.size(), 0.0);
  for (const ArmLink& link : model_.links) {
    for (const Solid& solid : link.solids) {
      const Vec3 along = solid.half.z() * solid.pose.linear().col(2);
      const Vec3 middle = solid.pose.translation();
      const double rim = solid.kind == SolidKind::cylinder ? solid.half.x() : 0.0;
      if (solid.kind == SolidKind::sphere) add_reach(link.frame, middle, 0.0, solid.half.x(), reach);
      if (solid.kind == SolidKind::cylinder || solid.kind == SolidKind::capsule) {
        const double margin = solid.half.x() - rim;
        add_reach(link.frame, middle - along, rim, margin, reach);
        add_reach(link.frame, middle + along, rim, margin, reach);
      }
      for (int corner = 0; corner < 8 && solid.kind == SolidKind::box; ++corner) {
        const Vec3 sides(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
        add_reach(link.frame, placed_point(solid.pose, solid.half.cwiseProduct(sides)), 0.0, 0.0, reach);
      }
      for (const Vec3& corner : solid.corners) add_reach(link.frame, placed_point(solid.pose, corner), 0.0, 0.0, reach);
    }
  }
  std::vector<double> of_tool(reach.size(), 0.0);
  add_reach(model_.tool_frame, model_.tool.translation(), 0.0, 0.0, of_tool);
  for (std::size_t j = 0; j < reach.size(); ++j) {
    const ArmJoint& joint = model_.joints[j];
    tool_reach_[joint.variable] += std::abs(joint.multiplier) * of_tool[j];
    if (std::max(reach[j], of_tool[j]) > 1e-12 && joint.multiplier != 0.0) moving_[joint.variable] = true;
  }
}

/// How far a ball that is fixed in a frame may come from the axes of this frame and those before it, and with its
/// margin from the base.
void ArmKinematics::add_reach(int frame, Vec3 centre, double radius, double margin, std::vector<double>& reach) {
  constexpr double upward = 1.0 + 1e-12;
  while (frame != base_frame) {
    const std::size_t number = frame_number(frame);
    const ArmJoint& joint = model_.joints[number];
    const Vec3 beside = joint.axis.dot(centre) * joint.axis;
    if (joint.slides) {
      const ArmVariable& variable = model_.variables[joint.variable];
      const double middle = 0.5 * (variable.low + variable.high);
      reach[number] = std::max(reach[number], 1.0);
      centre += (joint.multiplier * middle + joint.offset) * joint.axis;
      radius += upward * std::abs(joint.multiplier) * (variable.high - middle);
    } else {
      radius = upward * ((centre - beside).norm() + radius);
      reach[number] = std::max(reach[number], radius);
      centre = beside;
    }
    centre = placed_point(joint.origin, centre);
    frame = joint.parent;
  }
  whole_reach_ = std::max(whole_reach_, margin + ((centre - model_.base).norm() + radius));
}

const MovingFrame& ArmKinematics::frame(const ArmPosture& posture, int number) {
  static const MovingFrame base;
  return number == base_frame ? base : posture[frame_number(number)];
}

void ArmKinematics::place(const JointState& q, ArmPosture& posture) const {
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    const MovingFrame& parent = frame(posture, model_.joints[j].parent);
    MovingFrame& own = posture[j];
    own = {.turn = parent.turn, .at = parent.at};
    pass_joint(model_.joints[j], q, own.turn, own.at);
  }
}

Eigen::Isometry3d ArmKinematics::tool_pose(const JointState& q) const {
  std::array<std::size_t, most_frames> behind;  // NOLINT(*-member-init): only what is written is read
  std::size_t count = 0;
  for (int at = model_.tool_frame; at != base_frame; at = model_.joints[frame_number(at)].parent) {
    behind[count++] = frame_number(at);
  }
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 place = Vec3::Zero();
  while (count > 0) pass_joint(model_.joints[behind[--count]], q, turn, place);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn;
  pose.translation() = place;
  return pose * model_.tool;
}

std::size_t ArmKinematics::variable_outside_limits(const JointState& q) const {
  constexpr double rounding = 1e-12;
  for (std::size_t i = 0; i < most_joints; ++i) {
    if (!std::isfinite(q[i])) return i;
    if (i < size() && model_.variables[i].continuous) continue;
    const double low = i < size() ? model_.variables[i].low : 0.0;
    const double high = i < size() ? model_.variables[i].high : 0.0;
    if (q[i] < low - rounding || q[i] > high + rounding) return i;
  }
  return most_joints;
}

}  // namespace warren
