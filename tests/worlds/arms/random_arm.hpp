// SPDX-License-Identifier: BSD-3-Clause
// Small arms for the tests: trees of joints of every kind with solids of every kind, and where their frames are, by 4 x
// 4 matrices multiplied out.
#pragma once

#include <array>
#include <string>

#include "core/base/rng.hpp"
#include "tests/worlds/arms/arm_oracle.hpp"
#include "worlds/arms/arm_kinematics.hpp"

namespace warren::random_arm {

/// Random numbers in [-1, 1].
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  double number() { return 2.0 * uniform(seed_, next_++, 0) - 1.0; }
  std::size_t below(std::size_t n) { return random_bits(seed_, next_++, 1) % n; }
  Vec3 vector() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }
  Eigen::Isometry3d pose(double size) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    Eigen::Quaterniond q(number(), number(), number(), number());
    pose.linear() = q.normalized().toRotationMatrix();
    pose.translation() = size * vector();
    return pose;
  }
  Solid solid(SolidKind kind, double size) {
    Solid made;
    made.kind = kind;
    made.pose = pose(0.3 * size);
    made.half = 0.5 * size * vector().cwiseAbs();
    for (int i = 0; i < 6 && kind == SolidKind::hull; ++i) made.corners.push_back(0.5 * size * vector());
    return made;
  }

 private:
  std::uint64_t seed_;
  std::uint64_t next_ = 0;
};

inline constexpr std::array<SolidKind, 5> kinds{SolidKind::sphere, SolidKind::box, SolidKind::cylinder,
                                                SolidKind::capsule, SolidKind::hull};

/// tree: joints have any parent, some mimic, some slide; else it is a chain of turning joints.
inline ArmModel arm(std::uint64_t seed, std::size_t variables, bool tree) {
  Draw draw(seed);
  ArmModel model;
  model.name = "random";
  for (std::size_t i = 0; i < variables; ++i) {
    ArmVariable variable;
    variable.name = "variable " + std::to_string(i);
    variable.slides = tree && draw.below(4) == 0;
    variable.continuous = !variable.slides && draw.below(4) == 0;
    variable.low = variable.continuous ? -std::numbers::pi : variable.slides ? -0.1 : -2.5;
    variable.high = variable.continuous ? std::numbers::pi : variable.slides ? 0.3 : 2.0;
    model.variables.push_back(variable);
  }
  const std::size_t mimics = tree ? draw.below(3) : 0;
  for (std::size_t i = 0; i < variables + mimics; ++i) {
    ArmJoint joint;
    joint.name = "joint " + std::to_string(i);
    joint.parent = static_cast<int>(i) - 1;
    if (tree && draw.below(3) == 0) joint.parent = static_cast<int>(draw.below(i + 1)) - 1;
    joint.origin = draw.pose(0.3);
    joint.axis = draw.vector().normalized();
    joint.variable = i < variables ? i : draw.below(variables);
    joint.slides = model.variables[joint.variable].slides;
    if (i >= variables) joint.multiplier = draw.number();
    if (i >= variables) joint.offset = 0.3 * draw.number();
    model.joints.push_back(joint);
    ArmLink link;
    link.name = "link " + std::to_string(i);
    link.frame = static_cast<int>(i);
    link.solids = {draw.solid(kinds[draw.below(5)], 0.3), draw.solid(kinds[draw.below(5)], 0.2)};
    model.links.push_back(link);
  }
  model.tool_frame = static_cast<int>(model.joints.size()) - 1;
  model.tool = draw.pose(0.2);
  return model;
}

inline JointState state(const ArmModel& model, std::uint64_t seed, std::uint64_t index) {
  JointState q{};
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    const ArmVariable& variable = model.variables[i];
    q[i] = variable.low + uniform(seed, index, i) * (variable.high - variable.low);
  }
  return q;
}

/// Of a joint, or of the base.
inline Eigen::Matrix4d frame(const ArmModel& model, const JointState& q, int number) {
  if (number == base_frame) return Eigen::Matrix4d::Identity();
  const ArmJoint& joint = model.joints[static_cast<std::size_t>(number)];
  const double value = joint.multiplier * q[joint.variable] + joint.offset;
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  if (joint.slides) {
    motion.translate(value * joint.axis);
  } else {
    motion.rotate(Eigen::AngleAxisd(value, joint.axis));
  }
  return frame(model, q, joint.parent) * joint.origin.matrix() * motion.matrix();
}

}  // namespace warren::random_arm
