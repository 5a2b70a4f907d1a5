// SPDX-License-Identifier: BSD-3-Clause
// An arm as its judge sees it: bodies in frames, where the frames are and how they move, and the most that any point
// can. Built once a path, read by all threads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "verify/judges/solid_gap.hpp"

namespace warren {

/// A solid of a link, a ball around all of a link, or an obstacle.
struct JudgedBody {
  SolidCore core;
  SolidFrame frame;            ///< in its joint's
  int joint = base_frame;      ///< that moves it, or base_frame
  std::size_t owner = 0;       ///< number of the link, or of the obstacle
  std::size_t first_part = 0;  ///< of the bodies that a ball is around
  std::size_t parts = 0;       ///< 0: a solid itself
};

/// A joint's frame at a moment of a leg, in the base, and how it moves: a point x of it by drift + spin.cross(x), times
/// what of the leg goes by.
struct JudgedFrame {
  SolidFrame frame;
  Vec3 spin = Vec3::Zero();
  Vec3 drift = Vec3::Zero();
};

/// Bounds for all points of a link's cores, on a leg, against the frame of a joint behind it.
struct Sway {
  double reach = 0.0;  ///< how far from that frame's origin
  double speed = 0.0;  ///< their way a leg
  double bend = 0.0;   ///< the second derivative
};

class JudgedArm {
 public:
  /// Throws InputError for models that contradict arm_model.hpp. Refers to the model.
  JudgedArm(const ArmModel& model, const Execution& execution);

  /// All bodies: of each link its ball, at balls()[link], then its solids.
  const std::vector<JudgedBody>& bodies() const { return bodies_; }
  const std::vector<std::size_t>& balls() const { return balls_; }
  /// The last joint that moves both frames, or base_frame.
  int joint_behind(int a, int b) const;
  /// Base first, then the joints; the state is `from` + share * way.
  void frames_at(const JointState& from, const JointState& way, double share, std::vector<JudgedFrame>& frames) const;
  /// Those of link l against joint j's frame at [l * (joints + 1) + j + 1], where j is behind it. turns: how far each
  /// joint goes; values: the largest size of each one's value.
  std::vector<Sway> sways(std::span<const double> turns, std::span<const double> values) const;
  double value_of(std::size_t joint, const JointState& q) const;
  SolidFrame tool_at(const JointState& q) const;

 private:
  void add_link(std::size_t link);

  const ArmModel& model_;
  std::vector<JudgedBody> bodies_;
  std::vector<std::size_t> balls_;
  std::vector<double> reach_;  // of each link's cores from its frame's origin
};

/// A frame's numbers, if they are those of a rigid one; throws InputError, naming it.
SolidFrame rigid_frame(const Eigen::Isometry3d& pose, const std::string& name);
/// The same of a solid and its sizes.
SolidCore checked_core(const Solid& solid, SolidFrame& frame, const std::string& name);

}  // namespace warren
