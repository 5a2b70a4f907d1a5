// SPDX-License-Identifier: BSD-3-Clause
#include "tools/problem.hpp"

#include <fmt/format.h>

#include <array>

#include "core/error.hpp"
#include "tools/option_values.hpp"

namespace warren {
namespace {

constexpr std::array<std::string_view, 2> contact_words{"blocked", "allowed"};
constexpr double clearance_in_mazes = 0.1;

constexpr OptionSpec specs[] = {
    {"--robot", "\"BODY\"", "the moving body: \"point\" or \"disc RADIUS\" (default: the file's, else point)"},
    {"--start", "X,Y", "where the path begins (default: the file's)"},
    {"--goal", "X,Y", "where the path ends (default: the file's)"},
    {"--clearance", "R",
     "room kept around the body all along the path (default: the file's, else 0.1 in mazes, else 0)"},
    {"--contact", "WORD", "with clearance 0: may the path touch a wall? (default: blocked)", "blocked allowed"},
};

[[noreturn]] void refuse_body(std::string_view where, std::string_view kind) {
  throw UsageError(fmt::format(
      "{}: a body of kind '{}' needs a planner that this version does not have; it takes point and disc", where, kind));
}

std::string_view kind_name(RobotKind kind) {
  constexpr std::string_view names[] = {"point", "disc", "polygon", "car", "puma560"};
  return names[static_cast<std::size_t>(kind)];
}

Vec2 plane_state(std::string_view option, const std::vector<double>& given, const std::vector<double>& in_file) {
  const std::vector<double>& state = given.empty() ? in_file : given;
  if (state.empty()) throw UsageError(fmt::format("{0}: the world has none; say {0} X,Y", option));
  if (state.size() != 2) {
    throw UsageError(fmt::format("{}: a point or disc takes X,Y (found: {} numbers)", option, state.size()));
  }
  return {state[0], state[1]};
}

void check_scene(const Scene& scene) {
  constexpr std::string_view text = "{}: {} need a planner that this version does not have; it takes walls";
  if (!scene.polygons.empty()) throw UsageError(fmt::format(text, scene.source, "polygons"));
  if (!scene.spheres.empty()) throw UsageError(fmt::format(text, scene.source, "spheres"));
}

double resolved_clearance(const Scene& scene, const ProblemOptions& options) {
  if (options.clearance) return *options.clearance;
  if (scene.clearance) return *scene.clearance;
  return scene.maze ? clearance_in_mazes : 0.0;
}

}  // namespace

std::span<const OptionSpec> problem_option_specs() { return specs; }

RobotSpec robot_value(std::string_view where, std::string_view text) {
  if (text == "point") return {};
  const std::string_view kind = text.substr(0, text.find(' '));
  for (const RobotKind other : {RobotKind::polygon, RobotKind::car, RobotKind::puma560}) {
    if (kind == kind_name(other)) refuse_body(where, kind);
  }
  if (kind != "disc" || kind.size() == text.size()) {
    throw UsageError(fmt::format("{}: expected point, or disc RADIUS (found: '{}')", where, text));
  }
  RobotSpec robot;
  robot.kind = RobotKind::disc;
  robot.radius = number_value(where, text.substr(kind.size() + 1), 0.0, largest_coordinate);
  return robot;
}

std::string robot_text(const RobotSpec& robot) {
  return robot.kind == RobotKind::disc ? fmt::format("disc {}", robot.radius) : std::string{kind_name(robot.kind)};
}

ProblemOptions problem_options(const Arguments& arguments) {
  ProblemOptions options;
  if (const auto text = arguments.value("--robot")) options.robot = robot_value("--robot", *text);
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

WallProblem wall_problem(const Scene& scene, const ProblemOptions& options) {
  check_scene(scene);
  WallProblem problem;
  if (options.robot) {
    problem.robot = *options.robot;
  } else if (scene.robot) {
    problem.robot = *scene.robot;
  }
  if (problem.robot.kind != RobotKind::point && problem.robot.kind != RobotKind::disc) {
    refuse_body(scene.source, kind_name(problem.robot.kind));
  }
  problem.start = plane_state("--start", options.start, scene.start);
  problem.goal = plane_state("--goal", options.goal, scene.goal);
  problem.clearance = resolved_clearance(scene, options);
  problem.contact = options.contact.value_or(Contact::blocked);
  if (problem.contact == Contact::allowed && problem.reach() > 0.0) {
    throw UsageError(
        fmt::format("--contact: a body that keeps {} from every wall never touches one; 'allowed' needs "
                    "--clearance 0 and a point",
                    problem.reach()));
  }
  return problem;
}

}  // namespace warren
