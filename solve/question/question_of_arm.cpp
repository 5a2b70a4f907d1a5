// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/question_of_arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "worlds/arms/arm_world.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {
namespace {

std::vector<double> state_of(std::string_view option, const std::vector<double>& given,
                             const std::vector<double>& in_file, std::size_t width, bool place_too) {
  const std::vector<double>& state = given.empty() ? in_file : given;
  const std::string angles =
      width == most_chain_joints ? "six joint angles" : fmt::format("{} joint value{}", width, width == 1 ? "" : "s");
  const std::string expected = place_too ? angles + ", or X,Y,Z for a place of the tool" : angles;
  if (state.empty()) throw UsageError(fmt::format("{}: the world has none; say {}", option, expected));
  if (state.size() == width || (place_too && state.size() == 3)) return state;
  throw UsageError(fmt::format("{}: an arm takes {} (found: {} numbers)", option, expected, state.size()));
}

/// Of a joint that is no variable; nothing: it neither moves nor is held.
std::optional<double> place_of_joint(const ArmProblem& problem, std::span<const double> state, std::string_view name) {
  for (const auto* joints : {&problem.model.joints, &problem.model.idle_followers}) {
    const auto found = std::ranges::find(*joints, name, &ArmJoint::name);
    if (found != joints->end()) return found->multiplier * state[found->variable] + found->offset;
  }
  for (const auto& [standing, value] : problem.model.standing) {
    if (standing == name) return value;
  }
  if (!problem.robot.files) return std::nullopt;
  for (const auto& [held, value] : problem.robot.files->held) {  // which the robot may lack
    if (held == name) return value;
  }
  return std::nullopt;
}

constexpr double farthest_turn = 100.0;
constexpr double rounded_joints = 1e-5;  // files write pi as 3.14159

/// Names that are no variables are of joints that follow one, or stand still, and a state has them where they are.
/// Throws UsageError where one is not, and where a variable is missing; of a start of MoveIt it tells.
std::vector<double> state_named(ArmProblem& problem, const Scene& scene, const NamedState& named, bool is_goal) {
  const ArmModel& model = problem.model;
  const std::string end = fmt::format("{}: the {}", scene.source, is_goal ? "goal" : "start");
  std::vector<double> state;
  for (const ArmVariable& variable : model.variables) {
    const auto found = std::ranges::find(named.names, variable.name);
    if (found == named.names.end()) {
      throw UsageError(fmt::format("{} says nothing of joint '{}', which moves", end, variable.name));
    }
    state.push_back(named.values[as_whole<std::size_t>(found - named.names.begin())]);
  }
  for (std::size_t i = 0; i < named.names.size(); ++i) {
    const std::string& name = named.names[i];
    if (std::ranges::count(model.variables, name, &ArmVariable::name) > 0) continue;
    const auto stays = place_of_joint(problem, state, name);
    if (!stays) {
      throw UsageError(
          fmt::format("{} names joint '{}', which neither moves nor is held; take it out, or `hold` it", end, name));
    }
    if (std::abs(*stays - named.values[i]) <= rounded_joints) continue;
    const std::string differs =
        fmt::format("{} has joint '{}' at {:.9g}, but it is at {:.9g} there", end, name, named.values[i], *stays);
    const bool is_moveits = scene.arm && std::ranges::count(scene.arm->held, std::pair(name, named.values[i])) > 0;
    if (is_goal || !is_moveits) throw UsageError(differs);
    problem.told.push_back(differs);
  }
  return state;
}

/// Of an arm of three joints three numbers are their state, unless the file is one that names joints or a tool: there
/// they may be the tool's place, as a goal by position of MoveIt.
void refuse_unclear(const ArmProblem& problem, const Scene& scene) {
  const bool has_names = scene.named_start || (problem.robot.files && !problem.robot.files->tool.empty());
  if (scene.goal.size() != 3 || problem.width() != 3 || !has_names) return;
  throw UsageError(fmt::format(
      "{}: the goal's three numbers may be a place of the tool or the state of three joints; say the joints "
      "by their names (`goal joints NAME VALUE ...`, `joint_constraints`), or @goal A,B,C for these",
      scene.source));
}

/// What is asked for, else what the file says: states by names, a pose, numbers.
void take_goal(ArmProblem& problem, const Scene& scene, const Question& options) {
  const bool is_asked = options.goal_pose || !options.goal.empty();
  problem.goal_pose = options.goal_pose;
  if (!is_asked && scene.goal_pose) problem.goal_pose = scene.goal_pose;
  if (!is_asked && !scene.named_goals.empty()) {
    problem.goal_pose.reset();
    problem.goal = state_named(problem, scene, scene.named_goals.front(), true);
    for (std::size_t i = 1; i < scene.named_goals.size(); ++i) {
      problem.other_goals.push_back(state_named(problem, scene, scene.named_goals[i], true));
    }
  } else if (!problem.goal_pose) {
    if (!is_asked) refuse_unclear(problem, scene);
    problem.goal = state_of("@goal", options.goal, scene.goal, problem.width(), true);
  }
}

/// Refuses far turns of joints without end, which are rounded more the farther they are from 0, and moves those of an
/// arm of files that are a little beyond a limit onto it.
void settle_joints(ArmProblem& problem, std::string_view where, std::string_view end, std::span<double> state) {
  for (std::size_t j = 0; j < state.size(); ++j) {
    const ArmVariable& variable = problem.model.variables[j];
    if (variable.continuous && !(std::abs(state[j]) <= farthest_turn)) {
      throw UsageError(
          fmt::format("{}: joint '{}', which has no end, takes -{} to {}; say it without full turns (found: {})", where,
                      variable.name, farthest_turn, farthest_turn, state[j]));
    }
    if (variable.continuous || problem.table) continue;
    const double within = std::clamp(state[j], variable.low, variable.high);
    if (state[j] == within || !(std::abs(state[j] - within) <= rounded_joints)) continue;
    problem.told.push_back(
        fmt::format("{}: {} is moved from {:.9g} onto its limit, {:.9g}", end, variable.name, state[j], within));
    state[j] = within;
  }
}

/// Wrists to try: the start's, then all directions of the tool in steps of an eighth of a turn. Joint 6 stays, since
/// the tool lies along its axis.
std::vector<std::array<double, 3>> wrists_to_try(const ArmProblem& problem, const SerialChain& chain) {
  const JointState& start = problem.start;
  std::vector<std::array<double, 3>> wrists{{start[3], start[4], start[5]}};
  if (chain.table().tool.translation().z() == 0.0) return wrists;
  for (const int fifth : {-2, -1, 0, 1, 2}) {
    for (const int fourth : {-2, 0, 2}) {
      if (fifth == 0 && fourth != 0) continue;
      wrists.push_back({fourth * std::numbers::pi / 4.0, fifth * std::numbers::pi / 4.0, start[5]});
    }
  }
  return wrists;
}

}  // namespace

JointState joint_state(std::span<const double> numbers) {
  JointState q{};
  std::copy_n(numbers.begin(), std::min(numbers.size(), q.size()), q.begin());
  return q;
}

ArmVerifyOptions ArmProblem::verify_options() const {
  ArmVerifyOptions options{.clearance = clearance};
  options.start = start;
  if (goal_pose) {
    options.goal_pose = goal_pose;
  } else if (any_posture()) {
    options.goal_place = goal_place();
  } else {
    options.goal = goal_state();
  }
  return options;
}

Problem ArmProblem::general() const {
  Problem problem{robot, {}, goal, clearance, Contact::blocked};
  problem.start.assign(start.begin(), start.begin() + as_whole<std::ptrdiff_t>(width()));
  problem.goal_pose = goal_pose;
  problem.rule.others = other_goals;
  problem.told = told;
  return problem;
}

DhTable table_of(const RobotSpec& robot, const Execution& execution) {
  if (robot.kind == RobotKind::puma560) {
    const bool symmetric = robot.limits == name_of(PumaLimits::symmetric);
    return puma560_table(robot.tool, symmetric ? PumaLimits::symmetric : PumaLimits::classic);
  }
  DhTable table = read_dh_table(InputFile(robot.table, execution), execution);
  if (robot.tool > 0.0) table.tool.translation().z() += robot.tool;
  return table;
}

ArmModel arm_model_of(const RobotSpec& robot, double clearance, const Execution& execution) {
  if (robot.kind != RobotKind::urdf) {
    const DhTable table = table_of(robot, execution);
    try {
      return model_of(table, robot.radius, robot.self_collision, clearance);
    } catch (const InputError& error) {
      if (robot.table.empty()) throw;
      throw InputError(fmt::format("{}: {}", robot.table, error.where()), error.wrong(), error.value());
    }
  }
  if (robot.files->read) return *robot.files->read;
  ArmModel model = read_urdf(*robot.files, execution);
  leave_out_touching(model, execution);
  return model;
}

ArmProblem arm_problem(const Scene& scene, const Question& options, const Execution& execution) {
  if (options.contact == Contact::allowed) {
    throw UsageError("@contact: an arm keeps off the obstacles, so 'allowed' would change nothing");
  }
  ArmProblem problem;
  problem.robot = robot_of(scene, options);
  if (problem.robot.kind != RobotKind::urdf) problem.table = table_of(problem.robot, execution);
  problem.clearance = clearance_of(scene, options);
  problem.model = arm_model_of(problem.robot, problem.clearance, execution);
  if (problem.robot.files) problem.robot.files->read = problem.model;
  const bool is_named = scene.named_start && options.start.empty();
  const std::vector<double> said = is_named ? state_named(problem, scene, *scene.named_start, false) : scene.start;
  std::vector<double> start = state_of("@start", options.start, said, problem.width(), false);
  take_goal(problem, scene, options);
  settle_joints(problem, options.start.empty() ? scene.source + ": the start" : "@start", "start", start);
  const std::string of_goal = options.goal.empty() ? scene.source + ": the goal" : "@goal";
  if (!problem.any_posture()) settle_joints(problem, of_goal, "goal", problem.goal);
  for (std::vector<double>& goal : problem.other_goals) settle_joints(problem, of_goal, "goal", goal);
  problem.start = joint_state(start);
  return problem;
}

double reach_of(const ArmProblem& problem) {
  return problem.table ? SerialChain(*problem.table).reach() : ArmKinematics(problem.model).reach();
}

std::size_t take_reached_goal(ArmProblem& problem, const JointState& end) {
  std::size_t number = 0;
  for (std::size_t i = 0; i < problem.other_goals.size(); ++i) {
    if (joint_state(problem.other_goals[i]) == end && problem.goal_state() != end) number = i + 1;
  }
  if (number > 0) std::swap(problem.goal, problem.other_goals[number - 1]);
  return number;
}

std::vector<JointState> goal_states(const ArmProblem& problem, const Execution& execution) {
  constexpr std::size_t enough = 16;
  const auto found = [&](const ToolGoal& goal) {
    return postures_of_tool(ArmKinematics(problem.model), goal, problem.start, enough, execution);
  };
  if (problem.goal_pose) return found({*problem.goal_pose});
  if (!problem.any_posture()) {
    std::vector<JointState> states{problem.goal_state()};
    for (const std::vector<double>& other : problem.other_goals) states.push_back(joint_state(other));
    return states;
  }
  std::optional<SerialChain> chain;
  if (problem.table) chain.emplace(*problem.table);
  if (!chain || !has_puma560_shape(*chain)) {
    return found({Eigen::Isometry3d(Eigen::Translation3d(problem.goal_place())), true});
  }
  std::vector<JointState> states;
  for (const auto& wrist : wrists_to_try(problem, *chain)) {
    for (const JointState& q : puma560_inverse_place(*chain, problem.goal_place(), wrist)) {
      execution.check();
      if (std::ranges::find(states, q) == states.end()) states.push_back(q);
    }
  }
  return states;
}

}  // namespace warren
