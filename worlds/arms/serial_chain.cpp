// SPDX-License-Identifier: BSD-3-Clause
// Reaches: behind joint j the chain is the rigid pieces S_i = a_i x_i + d_(i+1) z_i, fixed in frame i and of length
// sqrt(a_i^2 + d_(i+1)^2), since x_i is square to z_i; their sum bounds the distance from the axis. While no twist has
// turned z away from the axis, a piece's part along z changes no distance from it and is left out.
#include "worlds/arms/serial_chain.hpp"

#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"

namespace warren {
namespace {

constexpr double most_angle = 6283.0;  // 1000 turns: beyond, sines lose digits that the bounds count on

bool is_length(double x) { return std::abs(x) <= largest_coordinate; }
bool is_angle(double x) { return std::abs(x) <= most_angle; }

void check(const DhJoint& joint, std::size_t number) {
  const std::string where = "joint " + std::to_string(number + 1);
  if (!is_length(joint.d) || !is_length(joint.a)) throw InputError(where, "lengths must be numbers of at most 1e60");
  if (!is_angle(joint.alpha_rad) || !is_angle(joint.offset_rad) || !is_angle(joint.low_rad) ||
      !is_angle(joint.high_rad)) {
    throw InputError(where, "angles must be numbers of at most 1000 turns");
  }
  if (joint.low_rad > joint.high_rad) {
    throw InputError(where, "the lower limit must not exceed the upper one", std::to_string(joint.low_rad));
  }
}

/// A twist by a multiple of half a turn, exactly as tables round it.
bool keeps_axis(double sin_alpha) { return std::abs(sin_alpha) < 1e-15; }

/// Cosine and sine of a twist, exact at the quarter turns of which tables are full.
std::array<double, 2> twist_of(double alpha) {
  const double quarters = alpha / 1.5707963267948966;
  const double nearest = std::round(quarters);
  if (std::abs(quarters - nearest) > 1e-15 * std::max(1.0, std::abs(quarters))) {
    const auto [sine, cosine] = portable::sin_and_cos(alpha);
    return {cosine, sine};
  }
  constexpr std::array<std::array<double, 2>, 4> exact{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  return exact[as_whole<std::size_t>(bounded_whole<std::int64_t>(nearest) & 3)];
}

/// The frame that moves along the chain.
struct Cursor {
  Vec3 p = Vec3::Zero();
  Vec3 x = Vec3::UnitX();
  Vec3 y = Vec3::UnitY();
  Vec3 z = Vec3::UnitZ();

  void turn(const portable::SineAndCosine& angle) {
    const auto [sine, cosine] = angle;
    const Vec3 turned = cosine * x + sine * y;
    y = cosine * y - sine * x;
    x = turned;
  }
  void twist(double cosine, double sine) {
    const Vec3 turned = cosine * y + sine * z;
    z = cosine * z - sine * y;
    y = turned;
  }
};

}  // namespace

SerialChain::SerialChain(const DhTable& table) : table_(table), modified_(table.convention == DhConvention::modified) {
  const std::size_t n = table.joints.size();
  if (n == 0 || n > most_chain_joints) {
    throw InputError("arm", "must have from 1 to 6 joints", std::to_string(n));
  }
  for (std::size_t i = 0; i < n; ++i) check(table.joints[i], i);
  if (!table.tool.matrix().allFinite() || table.tool.translation().cwiseAbs().maxCoeff() > largest_coordinate) {
    throw InputError("tool", "must be numbers of at most 1e60");
  }
  for (std::size_t i = 0; i < n; ++i) {
    const DhJoint& joint = table.joints[i];
    const auto [cosine, sine] = twist_of(joint.alpha_rad);
    steps_[i].offset = joint.offset_rad;
    steps_[i].d = joint.d;
    Step& holder = !modified_ ? steps_[i] : i == 0 ? base_ : steps_[i - 1];
    holder.a = joint.a;
    holder.cos_alpha = cosine;
    holder.sin_alpha = sine;
  }
  find_reaches();
}

std::size_t SerialChain::joint_outside_limits(const JointState& q) const {
  constexpr double rounding = 1e-12;
  for (std::size_t i = 0; i < most_joints; ++i) {
    if (!(q[i] >= low(i) - rounding && q[i] <= high(i) + rounding)) return i;
  }
  return most_joints;
}

Eigen::Isometry3d SerialChain::tool_pose(const JointState& q) const { return frame(q, joint_count()) * table_.tool; }

Eigen::Isometry3d SerialChain::frame(const JointState& q, std::size_t number) const {
  Cursor at;
  const auto slide = [&](const Step& step) {
    at.p += step.a * at.x;
    at.twist(step.cos_alpha, step.sin_alpha);
  };
  slide(base_);
  if (modified_ && number == 0) at = {};
  for (std::size_t i = 0; i < number; ++i) {
    at.turn(portable::sin_and_cos(q[i] + steps_[i].offset));
    at.p += steps_[i].d * at.z;
    if (!modified_ || i + 1 < number) slide(steps_[i]);
  }
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << at.x, at.y, at.z;
  frame.translation() = at.p;
  return frame;
}

void SerialChain::place(const JointState& q, ChainPosture& posture) const {
  Cursor at;
  posture.points[0] = at.p;
  if (modified_) {
    at.p += base_.a * at.x;
    at.twist(base_.cos_alpha, base_.sin_alpha);
  }
  const std::size_t n = joint_count();
  for (std::size_t i = 0; i < n; ++i) {
    const Step& step = steps_[i];
    posture.axes[i] = at.z;
    posture.on_axes[i] = at.p;
    if (moving_[i]) at.turn(portable::sin_and_cos(q[i] + step.offset));
    at.p += step.d * at.z;
    if (modified_) posture.points[i + 1] = at.p;
    if (modified_ && i + 1 == n) break;  // the last frame has no more twist
    at.p += step.a * at.x;
    at.twist(step.cos_alpha, step.sin_alpha);
    if (!modified_) posture.points[i + 1] = at.p;
  }
  const Vec3 tool = table_.tool.translation();
  posture.points[n + 1] = at.p + tool.x() * at.x + tool.y() * at.y + tool.z() * at.z;
}

double SerialChain::reach_of(std::size_t joint, std::size_t point) const {
  const std::size_t n = joint_count();
  const std::size_t origin = std::min(point, n);
  if (origin <= joint) return 0.0;
  double sum = 0.0;
  bool parallel = true;  // z of the frame to the joint's axis
  for (std::size_t i = joint; i < origin; ++i) {
    const Step& step = steps_[i];
    const bool last = i + 1 == origin;
    if (last && modified_) break;  // the origin stands before a and alpha
    parallel = parallel && keeps_axis(step.sin_alpha);
    const double d = last || parallel ? 0.0 : steps_[i + 1].d;
    sum += portable::hypot(step.a, d);
  }
  if (point <= n) return sum;
  const Vec3 tool = table_.tool.translation();
  return sum + (parallel ? portable::hypot(tool.x(), tool.y()) : tool.norm());
}

void SerialChain::find_reaches() {
  constexpr double rounding = 1.0 + 1e-14;
  for (std::size_t joint = 0; joint < joint_count(); ++joint) {
    for (std::size_t point = 0; point < point_count(); ++point) {
      reach_[joint][point] = rounding * reach_of(joint, point);
      moving_[joint] = moving_[joint] || reach_[joint][point] > 0.0;
    }
  }
  whole_reach_ = std::abs(base_.a) + table_.tool.translation().norm();
  for (const Step& step : steps_) whole_reach_ += portable::hypot(step.a, step.d);
}

}  // namespace warren
