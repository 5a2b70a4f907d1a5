// SPDX-License-Identifier: BSD-3-Clause
// The question that is asked of an arm: which arm, from which joint angles to which, or to which place of its tool.
#pragma once

#include <span>
#include <vector>

#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"
#include "verify/judges/verify_arm.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {

struct ArmProblem {
  RobotSpec robot;
  DhTable table;
  JointState start{};
  std::vector<double> goal;  ///< 6 joint angles, or the 3 coordinates of the tool's place
  double clearance = 0.0;

  bool any_posture() const { return goal.size() == 3; }
  JointState goal_state() const;  ///< of 6 angles
  Vec3 goal_place() const { return {goal[0], goal[1], goal[2]}; }
  ArmVerifyOptions verify_options() const;
  Problem general() const;
};

bool is_arm(const RobotSpec& robot);

/// Reads a table from its file; the Puma's is built in. Throws InputError, ReadError, UsageError.
DhTable table_of(const RobotSpec& robot, const Execution& execution);

/// Throws UsageError where start or goal are missing or have the wrong size.
ArmProblem arm_problem(const Scene& scene, const Question& options, const Execution& execution);

/// The states with the tool at the goal's place, all branches within the limits, for the start's wrist first and then
/// for wrists turned by eighths; the goal's one state where it has six angles. Throws UsageError for a place and an arm
/// whose inverse kinematics nobody knows here.
std::vector<JointState> goal_states(const ArmProblem& problem, const SerialChain& chain);

/// Is the goal's place so near an obstacle that no link could end there, whatever the posture?
bool tip_is_blocked(const Scene& scene, const ArmProblem& problem);

/// The first six of the numbers, zeros for those that lack.
JointState joint_state(std::span<const double> numbers);

}  // namespace warren
