// SPDX-License-Identifier: BSD-3-Clause
// Where an arm's frames are, how they move, and bounds of how far they may: of any tree of joints that turn or slide.
//
// Reach: how far can the joints behind j bring a ball of a link from the axis of j? A ball that turns about an axis
// stays in the ball whose centre is the axis' point beside its own, one that slides in a ball half the way larger; so
// from the link's frame to j, frame by frame. A convex body is held by the balls at its ends and corners.
// Acceleration: while every variable goes evenly, c'' = sum over pairs of joints of rate_k rate_j a_k x (a_j x (c -
// p_j)), k before j or j itself; no term is larger than rate_k rate_j reach_j(c). What slides is changed by turns
// before it alone: its reach is 1. Cost: 20 to 30 ns a joint.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scenes/scene/arm_model.hpp"
#include "worlds/arms/convex_motion.hpp"

namespace warren {

/// The frames of an arm's joints, by number.
using ArmPosture = std::array<MovingFrame, most_frames>;

/// A set of joints, a bit each.
using JointSet = std::uint32_t;
/// All of them.
inline constexpr JointSet all_joints = ~JointSet{0};

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
  /// Their velocities and spins, where the variables go `way` a unit of time, by joints of a set alone. Bends are left.
  void move(const JointState& way, ArmPosture& posture, JointSet joints = all_joints) const;
  /// The tool in the base's frame.
  Eigen::Isometry3d tool_pose(const JointState& q) const;
  /// A frame of a placed posture; of the base's number, what never moves.
  static const MovingFrame& frame(const ArmPosture& posture, int number);

  /// The joints that move what is fixed in a frame.
  JointSet joints_above(int frame) const;
  /// The joints that move what is fixed in frame a, or in b, against the other.
  JointSet joints_between(int a, int b) const { return joints_above(a) ^ joints_above(b); }
  /// Of the cores of a link's solids (their centres and axes, where they have a margin): upper bound of the distance
  /// from a joint's axis, whatever the other joints do within the limits; 1 of a joint that slides; 0: it moves not.
  double reach(std::size_t joint, std::size_t link) const { return reach_[joint][link]; }
  /// Upper bound of the acceleration of any point of these cores, where the variables go `way` a unit of time, by
  /// joints of a set alone: a MovingFrame's bend.
  double bend(std::size_t link, const JointState& way, JointSet joints = all_joints) const;
  /// Upper bound of the way of any point of these cores, when the variables go `way`.
  double travel(std::size_t link, const JointState& way) const;

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
  struct Ball;
  double rate_of(std::size_t joint, const JointState& way) const;
  void find_reach(std::size_t link, const Ball& ball, double margin);
  double add_reach(int frame, Ball ball, std::vector<double>& reach) const;

  ArmModel model_;
  std::array<JointSet, most_frames> above_{};           // of each frame: the joints that move it, its own too
  std::array<std::vector<double>, most_frames> reach_;  // of each link
  std::array<bool, most_joints> moving_{};
  std::array<double, most_joints> tool_reach_{};
  double whole_reach_ = 0.0;
};

}  // namespace warren
