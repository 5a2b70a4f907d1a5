// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/question_of_arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "scenes/files/dh_table_io.hpp"
#include "worlds/arms/puma560.hpp"
#include "worlds/arms/solid_index.hpp"

namespace warren {
namespace {

std::vector<double> state_of(std::string_view option, const std::vector<double>& given,
                             const std::vector<double>& in_file, bool place_too) {
  const std::vector<double>& state = given.empty() ? in_file : given;
  const char* expected = place_too ? "six joint angles, or X,Y,Z for a place of the tool" : "six joint angles";
  if (state.empty()) throw UsageError(fmt::format("{}: the world has none; say {}", option, expected));
  if (state.size() == most_joints || (place_too && state.size() == 3)) return state;
  throw UsageError(fmt::format("{}: an arm takes {} (found: {} numbers)", option, expected, state.size()));
}

/// Wrists to try: the start's, then all directions of the tool in steps of an eighth of a turn. Joint 6 stays, since
/// the tool lies along its axis.
std::vector<std::array<double, 3>> wrists_to_try(const ArmProblem& problem, const SerialChain& chain) {
  const JointState& start = problem.start;
  std::vector<std::array<double, 3>> wrists{{start[3], start[4], start[5]}};
  if (!chain.moves(4)) return wrists;
  for (const int fifth : {-2, -1, 0, 1, 2}) {
    for (const int fourth : {-2, 0, 2}) {
      if (fifth == 0 && fourth != 0) continue;
      wrists.push_back({fourth * std::numbers::pi / 4.0, fifth * std::numbers::pi / 4.0, start[5]});
    }
  }
  return wrists;
}

}  // namespace

bool is_arm(const RobotSpec& robot) { return robot.kind == RobotKind::puma560 || robot.kind == RobotKind::arm; }

JointState joint_state(std::span<const double> numbers) {
  JointState q{};
  std::copy_n(numbers.begin(), std::min(numbers.size(), q.size()), q.begin());
  return q;
}

JointState ArmProblem::goal_state() const { return joint_state(goal); }

ArmVerifyOptions ArmProblem::verify_options() const {
  ArmVerifyOptions options{.radius = robot.radius, .clearance = clearance, .self_collision = robot.self_collision};
  options.start = start;
  if (any_posture()) {
    options.goal_place = goal_place();
  } else {
    options.goal = goal_state();
  }
  return options;
}

Problem ArmProblem::general() const { return {robot, {start.begin(), start.end()}, goal, clearance, Contact::blocked}; }

DhTable table_of(const RobotSpec& robot, const Execution& execution) {
  if (robot.kind == RobotKind::puma560) {
    const bool symmetric = robot.limits == name_of(PumaLimits::symmetric);
    return puma560_table(robot.tool, symmetric ? PumaLimits::symmetric : PumaLimits::classic);
  }
  DhTable table = read_dh_table(InputFile(robot.table, execution), execution);
  if (robot.tool > 0.0) table.tool.translation().z() += robot.tool;
  return table;
}

ArmProblem arm_problem(const Scene& scene, const Question& options, const Execution& execution) {
  if (options.contact == Contact::allowed) {
    throw UsageError("@contact: an arm keeps off the obstacles, so 'allowed' would change nothing");
  }
  ArmProblem problem;
  problem.robot = robot_of(scene, options);
  problem.start = joint_state(state_of("@start", options.start, scene.start, false));
  problem.goal = state_of("@goal", options.goal, scene.goal, true);
  problem.clearance = clearance_of(scene, options);
  problem.table = table_of(problem.robot, execution);
  return problem;
}

std::vector<JointState> goal_states(const ArmProblem& problem, const SerialChain& chain) {
  if (!problem.any_posture()) return {problem.goal_state()};
  if (!has_puma560_shape(chain)) {
    throw UsageError("@goal: a place of the tool takes an arm of the Puma 560's shape; this one takes joint angles");
  }
  std::vector<JointState> states;
  for (const auto& wrist : wrists_to_try(problem, chain)) {
    for (const JointState& q : puma560_inverse_place(chain, problem.goal_place(), wrist)) {
      if (std::find(states.begin(), states.end(), q) == states.end()) states.push_back(q);
    }
  }
  return states;
}

bool tip_is_blocked(const Scene& scene, const ArmProblem& problem) {
  const Spine tip(problem.goal_place(), problem.goal_place());
  const double room = problem.robot.radius + problem.clearance;
  return std::ranges::any_of(scene.spheres,
                             [&](const Sphere& s) {
                               return std::sqrt(distance_square(tip, Vec3(s.x, s.y, s.z))) <= room + s.radius;
                             }) ||
         std::ranges::any_of(scene.boxes,
                             [&](const SolidBox& box) { return std::sqrt(distance_square(tip, box)) <= room; });
}

}  // namespace warren
