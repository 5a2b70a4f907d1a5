// SPDX-License-Identifier: BSD-3-Clause
// Where an arm's frames are, which variables move any of it, and bounds of how far: of any tree of joints that turn or
// slide.
//
// Reach: how far can the joints behind j bring a ball of a link from the axis of j? A ball that turns about an axis
// stays in the ball whose centre is the axis' point beside its own, one that slides in a ball half the way larger; so
// from the link's frame to j, frame by frame. A convex body is held by the balls at its ends and corners. The reach of
// a joint that slides is 1. Cost: 20 to 30 ns a joint.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "worlds/arms/convex_motion.hpp"

namespace warren {

/// The frames of an arm's joints, by number.
using ArmPosture = std::array<MovingFrame, most_frames>;

/// Immutable after construction; any number of threads may ask.
class ArmKinematics {
 public:
  /// Throws InputError for a model with no variable, too many of anything, limits upside down, axes not of length 1, or
  /// numbers of joints, variables and links that are none.
  explicit ArmKinematics(ArmModel model);

  const ArmModel& model() const { return model_; }
  /// Numbers of a state that mean something.
  std::size_t size() const { return model_.variables.size(); }

  /// Turns and places of all frames; they are at rest.
  void place(const JointState& q, ArmPosture& posture) const;
  /// The tool in the world.
  Eigen::Isometry3d tool_pose(const JointState& q) const;
  /// A frame of a placed posture; of the base's number, what never moves.
  static const MovingFrame& frame(const ArmPosture& posture, int number);

  /// Upper bound of how far the tool's origin goes when a variable goes by 1 alone.
  double tool_reach(std::size_t variable) const { return tool_reach_[variable]; }
  /// Upper bound of the distance of any point of the arm from the base.
  double reach() const { return whole_reach_; }

  /// Does the variable move any core, or the tool's origin?
  bool moves(std::size_t variable) const { return variable < most_joints && moving_[variable]; }
  /// The first variable that is beyond its limits by more than rounding (1e-12), no number, or not 0 where the model
  /// has none; most_joints where there is none.
  std::size_t variable_outside_limits(const JointState& q) const;

 private:
  void add_reach(int frame, Vec3 centre, double radius, double margin, std::vector<double>& reach);

  ArmModel model_;
  std::array<bool, most_joints> moving_{};
  std::array<double, most_joints> tool_reach_{};
  double whole_reach_ = 0.0;
};

/// What the tool shall be at, in the base's frame.
struct ToolGoal {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  bool place_only = false;  ///< the tool may be turned anyhow
};

/// States within the limits that bring the tool there, to 1e-9 of the world's unit and 1e-9 rad; any two differ by more
/// than 1e-6 in some variable, nearest to the seed first (each variable by its own unit, the wrap counts); variables
/// that do not move the tool stay as the seed has them. At most `enough`, >= 1; after 100 starts, or 10 for each that
/// is asked for, none more. Deterministic. Throws Stopped.
std::vector<JointState> postures_of_tool(const ArmKinematics& arm, const ToolGoal& goal, const JointState& seed,
                                         std::size_t enough, const Execution& execution = {});

}  // namespace warren
