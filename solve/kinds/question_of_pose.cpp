// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/question_of_pose.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <numbers>

#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "worlds/poses/free_headings.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

/// For messages.
std::string_view words_of(const RobotSpec& robot) { return robot.kind == RobotKind::car ? "a car" : "a turning body"; }

std::vector<double> state_of(std::string_view option, const std::vector<double>& given,
                             const std::vector<double>& in_file, std::size_t fewest, std::string_view body) {
  const std::vector<double>& state = given.empty() ? in_file : given;
  if (state.empty()) throw UsageError(fmt::format("{0}: the world has none; say {0} X,Y,THETA", option));
  if (state.size() >= fewest && state.size() <= 3) return state;
  throw UsageError(fmt::format("{}: {} takes X,Y,THETA{} (found: {} numbers)", option, body,
                               fewest == 2 ? ", or X,Y for any heading" : "", state.size()));
}

}  // namespace

std::optional<Scene> planned_copy(const Scene& scene, const Question& question, PlannerKind planner,
                                  const Execution& execution) {
  if (!scene.map || scene.walls.size() > 0 || planner == PlannerKind::voronoi) return std::nullopt;
  const RobotSpec robot = robot_of(scene, question);
  const bool looks_at_cells = planner == PlannerKind::grid && robot.kind != RobotKind::car;
  if (is_round(robot) || looks_at_cells) return std::nullopt;
  std::optional<Scene> copy(scene);
  add_map_walls(*copy, execution);
  return copy;
}

PoseProblem pose_problem(const Scene& scene, const Question& options) {
  if (options.contact == Contact::allowed) {
    throw UsageError(
        "@contact: the planners of turning bodies keep off the obstacles, so 'allowed' would change nothing");
  }
  PoseProblem problem;
  problem.robot = robot_of(scene, options);
  const std::string_view body = words_of(problem.robot);
  const std::vector<double> start = state_of("@start", options.start, scene.start, 3, body);
  check_heading("@start", start);
  problem.start = {start[0], start[1], start[2]};
  problem.goal = state_of("@goal", options.goal, scene.goal, 2, body);
  check_heading("@goal", problem.goal);
  problem.clearance = clearance_of(scene, options);
  return problem;
}

std::vector<Se2> poses_of(const std::vector<double>& state) {
  constexpr int headings = 16;
  if (state.size() == 3) return {{state[0], state[1], state[2]}};
  std::vector<Se2> poses;
  for (int i = 0; i < headings; ++i) {
    poses.push_back({state[0], state[1], wrapped_angle(2.0 * std::numbers::pi * i / headings)});
  }
  return poses;
}

std::vector<Se2> poses_to_meet(const Scene& scene, const PoseProblem& problem, const Execution& execution,
                               const std::function<bool(const Se2&)>& is_free) {
  std::vector<Se2> poses = poses_of(problem.goal);
  if (!problem.any_heading() || std::ranges::any_of(poses, is_free) || problem.robot.outline.empty()) return poses;
  const Vec2 place = problem.goal_pose().position();
  const double room = problem.clearance + end_margin(scene, problem, execution);
  for (const HeadingInterval& fits : free_headings(scene, problem.robot.outline, place, room, execution)) {
    poses.push_back({place.x, place.y, fits.middle()});
  }
  return poses;
}

std::optional<double> held_radius(const RobotSpec& robot) {
  if (robot.outline.empty()) return robot.radius;
  if (!contains(robot.outline, {0.0, 0.0})) return std::nullopt;
  double inside = std::numeric_limits<double>::infinity();
  for_each_side(robot.outline, [&](Vec2 a, Vec2 b) { inside = std::min(inside, distance(Vec2{}, Segment{a, b})); });
  constexpr double rounding = 1e-12;
  return inside * (1.0 - rounding);
}

double extent_of(const RobotSpec& robot) { return std::max(robot.radius, outline_reach(robot.outline)); }

PoseVerifyOptions verify_options(const PoseProblem& problem) {
  return {.clearance = problem.clearance,
          .start = problem.start,
          .goal = problem.goal_pose(),
          .any_heading = problem.any_heading()};
}

Verification PoseJudge::judged(std::span<const Se2> poses, const PoseVerifyOptions& options) const {
  if (problem.robot.kind == RobotKind::car) return verify_car(scene, problem.robot, poses, options, execution, index);
  return verify_se2(scene, problem.robot.outline, poses, options, execution, index);
}

bool PoseJudge::stands_free(const Se2& pose) const {
  const double margin = end_margin(scene, problem, execution);
  return judged(std::span(&pose, 1), {.clearance = problem.clearance + margin}).verified;
}

Outcome PoseJudge::settled(Outcome outcome) const {
  const auto is_free = [this](const Se2& pose) { return stands_free(pose); };
  return settled_ends(
      outcome, [&] { return is_free(problem.start); },
      [&] { return std::ranges::any_of(poses_to_meet(scene, problem, execution, is_free), is_free); });
}

Verdict recheck_poses(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                      const Execution& execution) {
  const PoseProblem problem = pose_problem(scene, question);
  check_state_width(answer, 3, words_of(problem.robot));
  const PoseJudge judge{scene, problem, execution};
  return {judge.judged(poses_of(answer.states), verify_options(problem)), problem.general()};
}

void take_poses(Answer& answer, const Verification& verdict, std::span<const Se2> path) {
  take_verdict(answer, verdict);
  answer.turn_rad = verdict.turn_rad;
  answer.states.width = 3;
  answer.path.clear();
  for (const Se2& pose : path) {
    answer.path.push_back(pose.position());
    answer.states.add(std::array{pose.x, pose.y, pose.theta});
  }
}

}  // namespace warren
