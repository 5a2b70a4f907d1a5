// SPDX-License-Identifier: BSD-3-Clause
// A Denavit-Hartenberg table as an arm of capsules, for the tests of the judge: the table's words one by one, shared
// with nothing.
#pragma once

#include <cmath>

#include "scenes/scene/arm_model.hpp"

namespace warren::test {

/// The steps from frame i - 1 to frame i: those before the joint turns, and those behind it.
inline std::array<Eigen::Isometry3d, 2> steps_around(const DhJoint& joint, DhConvention convention) {
  const Eigen::Isometry3d twist =
      Eigen::Translation3d(joint.a, 0.0, 0.0) * Eigen::Isometry3d(Eigen::AngleAxisd(joint.alpha_rad, Vec3::UnitX()));
  const Eigen::Isometry3d along(Eigen::Translation3d(0.0, 0.0, joint.d));
  if (convention == DhConvention::standard) return {Eigen::Isometry3d::Identity(), along * twist};
  return {twist, along};
}

inline Solid capsule_between(const Vec3& a, const Vec3& b, double radius) {
  Solid solid{.kind = SolidKind::capsule, .half = {radius, 0.0, 0.5 * (b - a).norm()}};
  solid.pose.translation() = 0.5 * (a + b);
  solid.pose.linear() = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), b - a).toRotationMatrix();
  return solid;
}

inline ArmModel chain_model(const DhTable& table, double radius, bool self_collision = false) {
  ArmModel model;
  Eigen::Isometry3d behind = Eigen::Isometry3d::Identity();  // the last frame, in the last joint's
  std::vector<double> lengths;
  const auto add_link = [&](const Vec3& end, int frame, const Vec3& start) {
    const double length = (end - start).norm();
    if (length <= 1e-9) return;
    lengths.push_back(length);
    model.links.push_back({"link " + std::to_string(model.links.size()), frame, {capsule_between(start, end, radius)}});
  };
  for (std::size_t i = 0; i < table.joints.size(); ++i) {
    const DhJoint& row = table.joints[i];
    const int number = static_cast<int>(i);
    model.variables.push_back({.name = std::to_string(i + 1), .low = row.low_rad, .high = row.high_rad});
    const auto [before, after] = steps_around(row, table.convention);
    const Eigen::Isometry3d origin = behind * before;
    model.joints.push_back({.name = std::to_string(i + 1),
                            .parent = number - 1,
                            .origin = origin,
                            .variable = i,
                            .offset = row.offset_rad});
    if (table.convention == DhConvention::standard) {
      add_link(after.translation(), number, Vec3::Zero());
    } else {
      add_link((origin * after).translation(), number - 1, behind.translation());
    }
    behind = after;
  }
  model.tool_frame = static_cast<int>(table.joints.size()) - 1;
  model.tool = behind * table.tool;
  add_link(model.tool.translation(), model.tool_frame, behind.translation());
  for (std::size_t a = 0; self_collision && a < model.links.size(); ++a) {
    double between = 0.0;
    for (std::size_t b = a + 1; b < model.links.size(); between += lengths[b++]) {
      if (between > 2.0 * radius * (1.0 + 1e-6)) {
        model.pairs.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
      }
    }
  }
  return model;
}

}  // namespace warren::test
