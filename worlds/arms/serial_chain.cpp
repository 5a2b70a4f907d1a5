// SPDX-License-Identifier: BSD-3-Clause
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
  whole_reach_ = std::abs(base_.a) + table_.tool.translation().norm();
  for (const Step& step : steps_) whole_reach_ += portable::hypot(step.a, step.d);
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

}  // namespace warren
