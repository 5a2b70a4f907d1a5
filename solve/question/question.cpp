// SPDX-License-Identifier: BSD-3-Clause
#include "solve/question/question.hpp"

#include <fmt/format.h>

#include <array>

#include "core/base/error.hpp"
#include "core/plane/se2.hpp"
#include "scenes/text/robot_text.hpp"
#include "tools/screen/output_conflicts.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

constexpr std::array<std::string_view, 2> contact_words{"blocked", "allowed"};
constexpr double clearance_in_mazes = 0.1;

constexpr OptionSpec problem_specs[] = {
    {"--robot", "\"BODY\"",
     "the moving body: \"point\", \"disc RADIUS\" or \"polygon X Y X Y ...\" (default: the file's, else point)"},
    {"--start", "X,Y[,THETA]", "where the path begins (default: the file's)"},
    {"--goal", "X,Y[,THETA]", "where the path ends (default: the file's)"},
    {"--clearance", "R",
     "room kept around the body all along the path (default: the file's, else 0.1 in mazes, else 0)"},
    {"--contact", "WORD",
     "with clearance 0: may the path touch an obstacle? (default: allowed for visibility and cells, else blocked)",
     "blocked allowed"},
};

Vec2 plane_state(std::string_view option, const std::vector<double>& given, const std::vector<double>& in_file) {
  const std::vector<double>& state = given.empty() ? in_file : given;
  if (state.empty()) throw UsageError(fmt::format("{0}: the world has none; say {0} X,Y", option));
  const bool heading_too = given.empty() && state.size() == 3;
  if (state.size() != 2 && !heading_too) {
    throw UsageError(fmt::format("{}: a point or disc takes X,Y (found: {} numbers)", option, state.size()));
  }
  return {state[0], state[1]};
}

std::string outline_text(std::span<const Vec2> outline) {
  std::string text = "polygon";
  for (const Vec2 corner : outline) text += fmt::format(" {} {}", corner.x, corner.y);
  return text;
}

/// The steering only where it is not the usual one.
std::string car_text(const RobotSpec& robot) {
  const std::string body = robot.outline.empty() ? fmt::format("radius {}", robot.radius) : outline_text(robot.outline);
  const std::string turning = fmt::format("car {} turning {}", body, robot.turning_radius);
  return robot.steering == SteeringKind::dubins ? turning
                                                : fmt::format("{} steering {}", turning, name_of(robot.steering));
}

RobotSpec robot_option(std::string_view text) {
  try {
    return robot_value("--robot", text);
  } catch (const InputError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

std::span<const OptionSpec> problem_option_specs() { return problem_specs; }

RobotSpec robot_value(const std::string& where, std::string_view text) {
  scene_text::Fields fields(text, {where, 0});
  return read_robot(fields, {});
}

std::string robot_text(const RobotSpec& robot) {
  switch (robot.kind) {
    case RobotKind::point:
      return "point";
    case RobotKind::disc:
      return fmt::format("disc {}", robot.radius);
    case RobotKind::car:
      return car_text(robot);
    case RobotKind::puma560:
      return fmt::format("puma560 radius {} tool {}{}", robot.radius, robot.tool, arm_words(robot));
    case RobotKind::arm:
      return fmt::format("arm {} radius {} tool {}{}", robot.table, robot.radius, robot.tool, arm_words(robot));
    case RobotKind::polygon:
      break;
  }
  return outline_text(robot.outline);
}

RobotSpec robot_of(const Scene& scene, const ProblemOptions& options) {
  return options.robot ? *options.robot : scene.robot.value_or(RobotSpec{});
}

double clearance_of(const Scene& scene, const ProblemOptions& options) {
  if (options.clearance) return *options.clearance;
  if (scene.clearance) return *scene.clearance;
  return scene.maze ? clearance_in_mazes : 0.0;
}

ProblemOptions problem_options(const Arguments& arguments) {
  ProblemOptions options;
  if (const auto text = arguments.value("--robot")) options.robot = robot_option(*text);
  if (options.robot) check_not_written(arguments, options.robot->table);
  if (const auto text = arguments.value("--start")) options.start = state_value("--start", *text);
  if (const auto text = arguments.value("--goal")) options.goal = state_value("--goal", *text);
  if (const auto text = arguments.value("--clearance")) {
    options.clearance = number_value("--clearance", *text, 0.0, largest_coordinate);
  }
  if (const auto text = arguments.value("--contact")) {
    options.contact = static_cast<Contact>(choice_value("--contact", *text, contact_words));
  }
  return options;
}

WallProblem wall_problem(const Scene& scene, const ProblemOptions& options, Contact usual) {
  WallProblem problem;
  problem.robot = robot_of(scene, options);
  if (problem.robot.kind != RobotKind::point && problem.robot.kind != RobotKind::disc) {
    throw UsageError(fmt::format("{}: expected a point or disc", options.robot ? "--robot" : scene.source));
  }
  problem.start = plane_state("--start", options.start, scene.start);
  problem.goal = plane_state("--goal", options.goal, scene.goal);
  problem.clearance = clearance_of(scene, options);
  problem.contact = options.contact.value_or(problem.reach() > 0.0 ? Contact::blocked : usual);
  if (problem.contact == Contact::allowed && problem.reach() > 0.0) {
    throw UsageError(
        fmt::format("--contact: a body that keeps {} from every wall never touches one; 'allowed' needs "
                    "--clearance 0 and a point",
                    problem.reach()));
  }
  return problem;
}

std::vector<double> state_or_heading(std::string_view option, const std::vector<double>& given,
                                     const std::vector<double>& in_file) {
  const std::vector<double>& state = given.empty() ? in_file : given;
  if (state.empty()) throw UsageError(fmt::format("{0}: the world has none; say {0} X,Y or X,Y,THETA", option));
  if (state.size() == 2 || state.size() == 3) return state;
  throw UsageError(fmt::format("{}: expected X,Y or X,Y,THETA (found: {} numbers)", option, state.size()));
}

void check_heading(std::string_view option, const std::vector<double>& state) {
  if (state.size() != 3 || std::abs(state[2]) <= largest_heading) return;
  throw UsageError(fmt::format("{}: a heading is at most {} rad (found: {})", option, largest_heading, state[2]));
}

}  // namespace warren
