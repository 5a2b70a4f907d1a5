// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/serial_chain.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "worlds/arms/arm_kinematics.hpp"

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

/// Turns two axes of a frame, the first towards the second.
void turn_axes(Vec3& from, Vec3& to, double cosine, double sine) {
  const Vec3 turned = cosine * from + sine * to;
  to = cosine * to - sine * from;
  from = turned;
}

// The arm of a Denavit-Hartenberg table as a model: its joints, a capsule between any two consecutive points of the
// chain that are apart, the tool. And of any model the pairs of links that are no use to keep apart: nothing moves one
// against the other, or they touch whatever the arm does, as far as 1,000 states tell (MoveIt's assistant finds its
// pairs that way, too).
//
// In the notation of serial_chain.hpp: the model's frame i turns with joint i and has its axis for z, at the point
// where the sequence Rz ... begins; frame i of the table stands at its `tail`.

using Eigen::Isometry3d;

/// What one row of a table does while its joint is at 0.
Isometry3d step_of(DhConvention convention, DhJoint row) {
  row.offset_rad = 0.0;
  DhTable table;
  table.convention = convention;
  table.joints = {row};
  return SerialChain(table).frame({}, 1);
}

/// A frame between two points, whose z leads from one to the other.
Isometry3d frame_between(const Vec3& a, const Vec3& b) {
  Isometry3d frame = Isometry3d::Identity();
  const Vec3 z = (b - a).normalized();
  Eigen::Index least = 0;
  z.cwiseAbs().minCoeff(&least);
  const Vec3 x = z.cross(Vec3::Unit(least)).normalized();
  frame.linear() << x, z.cross(x), z;
  frame.translation() = 0.5 * (a + b);
  return frame;
}

/// Links that what is between them keeps so near that they always touch are no use to keep apart.
void add_pairs(ArmModel& model, double touch) {
  for (std::size_t near = 0; near < model.links.size(); ++near) {
    double between = 0.0;
    for (std::size_t far = near + 2; far < model.links.size(); ++far) {
      between += 2.0 * model.links[far - 1].solids.front().half.z();
      if (between > touch) model.pairs.push_back({as_whole<std::uint32_t>(near), as_whole<std::uint32_t>(far)});
    }
  }
}

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
  Vec3 place = Vec3::Zero();
  Vec3 x = Vec3::UnitX();
  Vec3 y = Vec3::UnitY();
  Vec3 z = Vec3::UnitZ();
  const auto slide = [&](const Step& step) {
    place += step.a * x;
    turn_axes(y, z, step.cos_alpha, step.sin_alpha);
  };
  if (!modified_ || number > 0) slide(base_);
  for (std::size_t i = 0; i < number; ++i) {
    const auto [sine, cosine] = portable::sin_and_cos(q[i] + steps_[i].offset);
    turn_axes(x, y, cosine, sine);
    place += steps_[i].d * z;
    if (!modified_ || i + 1 < number) slide(steps_[i]);
  }
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << x, y, z;
  frame.translation() = place;
  return frame;
}

ArmModel model_of(const DhTable& table, double radius, bool self_collision, double clearance) {
  const SerialChain chain(table);
  for (const double length : {radius, clearance}) {
    if (!(length >= 0.0 && length <= largest_coordinate)) {
      throw InputError("arm", "radius and clearance must be numbers from 0 to 1e60", std::to_string(length));
    }
  }
  ArmModel model;
  model.name = "arm";
  for (std::size_t i = 0; i < most_chain_joints; ++i) {
    model.variables.push_back({.name = "joint " + std::to_string(i + 1), .low = chain.low(i), .high = chain.high(i)});
  }
  const auto add_link = [&](int frame, const Vec3& from, const Vec3& to) {
    const double length = (to - from).norm();
    if (length <= 1e-12 * chain.reach()) return;
    const Solid capsule{SolidKind::capsule, frame_between(from, to), {radius, radius, 0.5 * length}};
    model.links.push_back({"link " + std::to_string(model.links.size()), frame, {capsule}});
  };
  const bool modified = table.convention == DhConvention::modified;
  Isometry3d tail = Isometry3d::Identity();
  for (std::size_t i = 0; i < table.joints.size(); ++i) {
    DhJoint row = table.joints[i];
    const Isometry3d step = step_of(table.convention, row);
    row.d = 0.0;
    model.joints.push_back({.name = model.variables[i].name,
                            .parent = as_whole<int>(i) - 1,
                            .origin = modified ? tail * step_of(table.convention, row) : tail,
                            .variable = i,
                            .offset = table.joints[i].offset_rad});
    if (modified) {
      add_link(as_whole<int>(i) - 1, tail.translation(), (tail * step).translation());
      tail = Isometry3d(Eigen::Translation3d(0.0, 0.0, table.joints[i].d));
    } else {
      tail = step;
      add_link(as_whole<int>(i), Vec3::Zero(), tail.translation());
    }
  }
  model.tool_frame = as_whole<int>(table.joints.size()) - 1;
  model.tool = tail * table.tool;
  add_link(model.tool_frame, tail.translation(), model.tool.translation());
  if (model.links.empty()) throw InputError("arm", "has no link of any length");
  const double rounding = 1e-12 * (chain.reach() + radius + clearance);
  if (self_collision) add_pairs(model, (2.0 * radius + clearance) * (1.0 + 1e-9) + rounding);
  return model;
}

void leave_out_touching(ArmModel& model, const Execution& execution) {
  constexpr std::uint64_t states = 1000;
  const ArmKinematics arm(model);
  std::erase_if(model.pairs,
                [&](const LinkPair& pair) { return model.links[pair[0]].frame == model.links[pair[1]].frame; });
  std::vector<std::vector<ConvexBody>> bodies(model.links.size());
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    for (const Solid& solid : model.links[link].solids) bodies[link].emplace_back(solid);
  }
  ArmPosture posture;
  const auto touch = [&](const LinkPair& pair) {
    execution.check();
    const MovingFrame& at_a = ArmKinematics::frame(posture, model.links[pair[0]].frame);
    const MovingFrame& at_b = ArmKinematics::frame(posture, model.links[pair[1]].frame);
    for (const ConvexBody& a : bodies[pair[0]]) {
      for (const ConvexBody& b : bodies[pair[1]]) {
        if (keep_apart(a, at_a, b, at_b, 0.0, 0.0) != Apart::proved) return true;
      }
    }
    return false;
  };
  std::vector<LinkPair> suspects = model.pairs;
  for (std::uint64_t state = 0; state < states && !suspects.empty(); ++state) {
    JointState q{};
    for (std::size_t i = 0; i < arm.size(); ++i) {
      const ArmVariable& variable = model.variables[i];
      q[i] = variable.low + uniform(1, state, i) * (variable.high - variable.low);
    }
    arm.place(q, posture);
    std::erase_if(suspects, [&](const LinkPair& pair) { return !touch(pair); });
  }
  auto next = suspects.begin();  // they stand in the order of all pairs
  std::erase_if(model.pairs, [&](const LinkPair& pair) {
    const bool is_suspect = next != suspects.end() && *next == pair;
    next += is_suspect ? 1 : 0;
    return is_suspect;
  });
  for (const LinkPair& pair : suspects) {
    execution.check();
    model.assumed.push_back(model.links[pair[0]].name + " and " + model.links[pair[1]].name +
                            " touch in every posture that was tried: not checked against each other");
  }
}

}  // namespace warren
