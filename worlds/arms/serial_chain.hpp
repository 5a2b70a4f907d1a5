// SPDX-License-Identifier: BSD-3-Clause
// A serial chain of revolute joints from a Denavit-Hartenberg table, standard or modified: where its origins, axes and
// tool are at given joint angles (forward kinematics), and how far any joint can swing any of its points.
//
// standard: frame i = frame i-1 * Rz(q + offset) Tz(d) Tx(a) Rx(alpha), joint i turns about z of frame i-1;
// modified (Craig): frame i = frame i-1 * Rx(alpha) Tx(a) Rz(q + offset) Tz(d), joint i turns about z of frame i.
// Both are the one sequence [Rx Tx] Rz Tz Rx Tx Rz Tz ..., and are held as that: only the places where the origins
// stand differ. A joint costs a sine, a cosine and some 30 multiplications; joints that move no point cost nothing.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "scenes/scene/scene.hpp"

namespace warren {

/// Points of a chain: 0 is the base, i the origin of frame i, joint_count() + 1 the tool's.
inline constexpr std::size_t most_points = most_joints + 2;

/// Where a chain is: what motions of it are judged by.
struct ChainPosture {
  std::array<Vec3, most_points> points;
  std::array<Vec3, most_joints> axes;     ///< unit vectors
  std::array<Vec3, most_joints> on_axes;  ///< a point of each axis
};

/// Immutable after construction; any number of threads may ask.
class SerialChain {
 public:
  /// Throws InputError for a table without joints or with more than six, numbers that are not finite, and limits that
  /// are upside down or beyond 1000 turns.
  explicit SerialChain(const DhTable& table);

  std::size_t joint_count() const { return table_.joints.size(); }
  std::size_t point_count() const { return joint_count() + 2; }
  const DhTable& table() const { return table_; }
  double low(std::size_t joint) const { return joint < joint_count() ? table_.joints[joint].low_rad : 0.0; }
  double high(std::size_t joint) const { return joint < joint_count() ? table_.joints[joint].high_rad : 0.0; }
  /// The first joint that is beyond its limits by more than rounding (1e-12); most_joints where there is none.
  std::size_t joint_outside_limits(const JointState& q) const;

  /// The tool in the base's frame.
  Eigen::Isometry3d tool_pose(const JointState& q) const;
  /// Frame 0 .. joint_count() in the base's.
  Eigen::Isometry3d frame(const JointState& q, std::size_t number) const;

  /// All points; axes of joints that move none are not told rightly.
  void place(const JointState& q, ChainPosture& posture) const;

  /// Upper bound of the distance of a point from a joint's axis, whatever the angles; 0: the joint does not move it.
  double reach(std::size_t joint, std::size_t point) const { return reach_[joint][point]; }
  /// Does the joint move any point?
  bool moves(std::size_t joint) const { return joint < moving_.size() && moving_[joint]; }
  /// Upper bound of the distance of any point from the base.
  double reach() const { return whole_reach_; }

 private:
  /// Rz(q + offset) Tz(d) Tx(a) Rx(alpha)
  struct Step {
    double offset = 0.0;
    double d = 0.0;
    double a = 0.0;
    double cos_alpha = 1.0;
    double sin_alpha = 0.0;
  };
  void find_reaches();
  double reach_of(std::size_t joint, std::size_t point) const;

  DhTable table_;
  bool modified_ = false;
  Step base_;  // only a and alpha
  std::array<Step, most_joints> steps_;
  std::array<std::array<double, most_points>, most_joints> reach_{};
  std::array<bool, most_joints> moving_{};
  double whole_reach_ = 0.0;
};

}  // namespace warren
