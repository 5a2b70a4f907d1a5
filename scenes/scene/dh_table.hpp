// SPDX-License-Identifier: BSD-3-Clause
// A Denavit-Hartenberg table of a serial chain of revolute joints, as plain data: what planners and judges of arms have
// in common. What it means is said in worlds/arms/serial_chain.hpp.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace warren {

using Vec3 = Eigen::Vector3d;  ///< a point or vector of space; units of the world

/// Joints that an arm may have.
inline constexpr std::size_t most_joints = 6;
/// Joint angles in radians; those that a shorter chain lacks are 0.
using JointState = std::array<double, most_joints>;

/// Where a joint's frame stands: at its far end (standard), or at its near one (modified, as Craig has it).
enum class DhConvention : std::uint8_t { standard, modified };

/// A row of the table: lengths in the world's unit, angles in radians. Limits are of q, without the offset.
struct DhJoint {
  double d = 0.0;           ///< along the joint's axis
  double a = 0.0;           ///< length of the link
  double alpha_rad = 0.0;   ///< twist of the link
  double low_rad = 0.0;     ///< finite
  double high_rad = 0.0;    ///< >= low_rad
  double offset_rad = 0.0;  ///< is added to q
};

/// A serial chain of revolute joints.
struct DhTable {
  DhConvention convention = DhConvention::standard;        ///< how its rows are read
  std::vector<DhJoint> joints;                             ///< 1 .. 6
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();  ///< from the last frame
};

}  // namespace warren
