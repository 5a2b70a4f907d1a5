// SPDX-License-Identifier: BSD-3-Clause
// A serial chain of revolute joints from a Denavit-Hartenberg table, standard or modified: where its frames and its
// tool are at given joint angles (forward kinematics), and how far they may be from the base.
//
// standard: frame i = frame i-1 * Rz(q + offset) Tz(d) Tx(a) Rx(alpha), joint i turns about z of frame i-1;
// modified (Craig): frame i = frame i-1 * Rx(alpha) Tx(a) Rz(q + offset) Tz(d), joint i turns about z of frame i.
// Both are the one sequence [Rx Tx] Rz Tz Rx Tx Rz Tz ..., and are held as that: only the places where the origins
// stand differ. A joint costs a sine, a cosine and some 30 multiplications.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Immutable after construction; any number of threads may ask.
class SerialChain {
 public:
  /// Throws InputError for a table without joints or with more than six, numbers that are not finite, and limits that
  /// are upside down or beyond 1000 turns.
  explicit SerialChain(const DhTable& table);

  std::size_t joint_count() const { return table_.joints.size(); }
  const DhTable& table() const { return table_; }
  double low(std::size_t joint) const { return joint < joint_count() ? table_.joints[joint].low_rad : 0.0; }
  double high(std::size_t joint) const { return joint < joint_count() ? table_.joints[joint].high_rad : 0.0; }

  /// The tool in the base's frame.
  Eigen::Isometry3d tool_pose(const JointState& q) const;
  /// Frame 0 .. joint_count() in the base's.
  Eigen::Isometry3d frame(const JointState& q, std::size_t number) const;

  /// Upper bound of the distance of any frame's origin and of the tool from the base.
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

  DhTable table_;
  bool modified_ = false;
  Step base_;  // only a and alpha
  std::array<Step, most_joints> steps_;
  double whole_reach_ = 0.0;
};

/// The arm of a table. Six variables always: those that the table lacks are 0 and have no joint. Capsules have the
/// radius. self_collision: no two may touch, but neighbours and those that what is between them keeps nearer than their
/// radii and the clearance. Throws InputError as SerialChain, for an arm without any link, and for lengths that are not
/// from 0 to 1e60.
ArmModel model_of(const DhTable& table, double radius, bool self_collision, double clearance = 0.0);

/// Takes from the model's pairs those that are no use to keep apart: nothing moves one link against the other, or they
/// touch in each of 1,000 states, which `assumed` tells. A pair is a suspect until the first state where it is apart:
/// some ms in all. Throws InputError as ArmKinematics, Stopped.
void leave_out_touching(ArmModel& model, const Execution& execution = {});

}  // namespace warren
