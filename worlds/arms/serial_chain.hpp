// SPDX-License-Identifier: BSD-3-Clause
// A serial chain of revolute joints from a Denavit-Hartenberg table, standard or modified: where its frames and its
// tool are at given joint angles (forward kinematics), and how far they may be from the base.
//
// standard: frame i = frame i-1 * Rz(q + offset) Tz(d) Tx(a) Rx(alpha), joint i turns about z of frame i-1;
// modified (Craig): frame i = frame i-1 * Rx(alpha) Tx(a) Rz(q + offset) Tz(d), joint i turns about z of frame i.
// Both are the one sequence [Rx Tx] Rz Tz Rx Tx Rz Tz ..., and are held as that: only the places where the origins
// stand differ. A joint costs a sine, a cosine and some 30 multiplications.
//
// And of one such arm, the Unimation Puma 560, its table and its inverse kinematics (puma560.cpp).
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

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

/// classic: +-160, -45..225, -225..45, -110..170, +-100, +-266 degrees, as the toolboxes long had them.
/// symmetric: +-160, +-110, +-135, +-266, +-100, +-266 degrees (Wang, Chen, IEEE Trans. Robotics Autom. 7(4), 1991), as
/// they have them now.
enum class PumaLimits : std::uint8_t { classic, symmetric };
constexpr std::string_view name_of(PumaLimits limits) {
  return limits == PumaLimits::classic ? "classic" : "symmetric";
}

/// The standard table; the tool stands `tool` metres along the last z axis.
DhTable puma560_table(double tool = 0.0, PumaLimits limits = PumaLimits::classic);

/// All joint angles within the limits that bring the tool's tip to `place`, with the wrist's three angles as given: the
/// four branches of shoulder and elbow and their full turns. For an arm of puma560_table's shape (any lengths d3, d4,
/// a2, a3, any limits, a tool along the last z axis). In a fixed order; empty: out of reach. Throws InputError for
/// chains of another shape.
std::vector<JointState> puma560_inverse_place(const SerialChain& chain, const Vec3& place,
                                              const std::array<double, 3>& wrist);

/// Is this a chain of that shape?
bool has_puma560_shape(const SerialChain& chain);

struct ToolPostures {
  std::vector<JointState> states;  ///< within the limits, joint 6 as asked for, since the tool lies along its axis
  bool none_is_left = false;       ///< proved, where there are none: the place is out of reach
};

/// Pieces are halved until there are `enough` states, none is left, or they are a ten-thousandth of a radian small or
/// 200,000; each takes some microseconds. In a fixed order. Throws InputError as puma560_inverse_place, Stopped.
ToolPostures tool_postures(const SerialChain& chain, const Vec3& place, double sixth, std::size_t enough,
                           const Execution& execution);

}  // namespace warren
