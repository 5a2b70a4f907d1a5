// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/question_words.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec question_specs[] = {
    {"--robot", "\"BODY\"",
     "the moving body: \"point\", \"disc RADIUS\", \"polygon X Y X Y ...\" (or \"[[X, Y], ...]\"), \"car polygon X Y "
     "... turning RHO\", \"puma560 radius R\", \"arm FILE radius R\" or \"urdf FILE\". X and Y of a corner count from "
     "the place that --start names; RHO is the radius of the tightest turn (default: the file's, else point)"},
    {"--start", "X,Y[,THETA]",
     "where to start: X,Y; for a body that turns X,Y,THETA (radians, or 90deg); for an arm one number a "
     "joint (default: the file's)"},
    {"--goal", "X,Y[,THETA]",
     "where to arrive, as --start. Without THETA a body that turns may arrive at any heading; of an arm X,Y,Z is a "
     "place "
     "of its tool (default: the file's)"},
    {"--goal-pose", "X,Y,Z,QX,QY,QZ,QW",
     "of an arm: a pose of its tool, its place and its turn as a quaternion (default: the file's)"},
    {"--clearance", "R",
     "room to keep around the body along the whole path (default: the file's, else 0.1 in mazes, else 0)"},
    {"--contact", "WORD",
     "with clearance 0: may the path touch obstacles? allowed: it may run along a wall or around a corner, never "
     "through. blocked: it keeps off, however little (default: allowed for visibility and cells, else blocked)",
     choices_of<Contact>},
};

RobotSpec robot_option(std::string_view option, std::string_view text) {
  try {
    return robot_value(std::string{option}, text);
  } catch (const InputError& error) {
    throw UsageError(error.what());
  }
}

Eigen::Isometry3d pose_value(std::string_view option, std::string_view text) {
  const std::vector<double> n = state_value(option, text);
  const Eigen::Quaterniond turn =
      n.size() == 7 ? Eigen::Quaterniond(n[6], n[3], n[4], n[5]) : Eigen::Quaterniond(0, 0, 0, 0);
  if (!(turn.norm() > 0.0)) {
    throw UsageError(
        fmt::format("{}: expected X,Y,Z,QX,QY,QZ,QW with a quaternion that is not 0 (found: '{}')", option, text));
  }
  return Eigen::Translation3d(n[0], n[1], n[2]) * turn.normalized();
}

}  // namespace

std::span<const OptionSpec> question_option_specs() { return question_specs; }

Question question_words(const Arguments& arguments) {
  Question question;
  question.robot = given_value(arguments, "--robot", robot_option);
  if (const auto text = arguments.value("--start")) question.start = state_value("--start", *text);
  if (const auto text = arguments.value("--goal")) question.goal = state_value("--goal", *text);
  if (const auto text = arguments.value("--goal-pose")) question.goal_pose = pose_value("--goal-pose", *text);
  if (question.goal_pose && !question.goal.empty()) throw UsageError("--goal-pose: there is a --goal, too; say one");
  question.clearance = given_value(arguments, "--clearance", number_value, 0.0, largest_coordinate);
  question.contact = given_choice<Contact>(arguments, "--contact");
  return question;
}

namespace {

constexpr OptionSpec maze_specs[] = {
    {"--algorithm", "NAME", "how the mazes are made (default: backtracker)", choices_of<MazeAlgorithm>},
    {"--loops", "F", "share of the inner walls that is taken out, which makes loops, 0 to 1 (default: 0)"},
};

}  // namespace

std::span<const OptionSpec> maze_option_specs() { return maze_specs; }

MazeOptions maze_words(const Arguments& arguments, MazeOptions usual) {
  usual.loops = given_value(arguments, "--loops", number_value, 0.0, 1.0).value_or(usual.loops);
  usual.algorithm = given_choice<MazeAlgorithm>(arguments, "--algorithm").value_or(usual.algorithm);
  return usual;
}

}  // namespace warren::tools
