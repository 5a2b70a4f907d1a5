// SPDX-License-Identifier: BSD-3-Clause
// The question that is asked of an arm: which arm, from which joint angles to which, or to which place of its tool.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scenes/scene/arm_model.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"
#include "verify/judges/verify_arm.hpp"

namespace warren {

/// The numbers, zeros behind them; at most most_joints.
JointState joint_state(std::span<const double> numbers);

struct ArmProblem {
  RobotSpec robot;
  std::optional<DhTable> table;  ///< of puma560 and arm
  ArmModel model;
  JointState start{};
  std::vector<double> goal;  ///< a number a variable, or the 3 coordinates of the tool's place; empty: see below
  std::vector<std::vector<double>> other_goals;  ///< that do as well
  std::optional<Eigen::Isometry3d> goal_pose{};  ///< of the tool, instead
  double clearance = 0.0;
  std::vector<std::string> told{};  ///< ends that were moved onto a limit, a line a joint

  std::size_t width() const { return model.variables.size(); }  ///< numbers of a state
  bool any_posture() const { return goal.size() != width(); }
  JointState goal_state() const { return joint_state(goal); }  ///< of one number a variable
  Vec3 goal_place() const { return {goal[0], goal[1], goal[2]}; }
  ArmVerifyOptions verify_options() const;
  Problem general() const;
};

inline bool is_arm(const RobotSpec& robot) {
  return robot.kind == RobotKind::puma560 || robot.kind == RobotKind::arm || robot.kind == RobotKind::urdf;
}

/// Reads a table from its file; the Puma's is built in. Throws InputError, ReadError, UsageError.
DhTable table_of(const RobotSpec& robot, const Execution& execution);

/// What the arm's files say: reads them, unless that was done. The clearance counts where links of a table's arm may
/// not touch. Throws InputError, ReadError, UsageError, Stopped.
ArmModel arm_model_of(const RobotSpec& robot, double clearance, const Execution& execution);

/// Upper bound of the distance of any point of the arm from its base.
double reach_of(const ArmProblem& problem);

/// Where several goals would do, the one that the path ends at changes places with the first. Which it is, from 0.
std::size_t take_reached_goal(ArmProblem& problem, const JointState& end);

/// Throws UsageError where start or goal are missing or have the wrong size. Ends that are beyond a limit of an arm of
/// files by at most 1e-5 are moved onto it, and told.
ArmProblem arm_problem(const Scene& scene, const Question& options, const Execution& execution);

/// States with the tool at the goal's place or pose. Of an arm of the Puma 560's shape all branches within the limits,
/// for the start's wrist first and then for wrists turned by eighths; of others what numerical inverse kinematics
/// finds. The goal's one state where it has one.
std::vector<JointState> goal_states(const ArmProblem& problem, const Execution& execution);

}  // namespace warren
