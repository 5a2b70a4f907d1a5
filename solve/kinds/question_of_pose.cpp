// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/question_of_pose.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "solve/kinds/solve_steps.hpp"
#include "solve/question/planner_choice.hpp"
#include "worlds/poses/free_headings.hpp"

namespace warren {
namespace {

std::vector<double> state_of(std::string_view option, const std::vector<double>& given,
                             const std::vector<double>& in_file, std::size_t fewest, std::string_view body) {
  const std::vector<double>& state = given.empty() ? in_file : given;
  if (state.empty()) throw UsageError(fmt::format("{0}: the world has none; say {0} X,Y,THETA", option));
  if (state.size() >= fewest && state.size() <= 3) return state;
  throw UsageError(fmt::format("{}: {} takes X,Y,THETA{} (found: {} numbers)", option, body,
                               fewest == 2 ? ", or X,Y for any heading" : "", state.size()));
}

}  // namespace

PoseProblem pose_problem(const Scene& scene, const Question& options, std::string_view body) {
  if (options.contact == Contact::allowed) {
    throw UsageError(
        "@contact: the planners of turning bodies keep off the obstacles, so 'allowed' would change nothing");
  }
  PoseProblem problem;
  problem.robot = robot_of(scene, options);
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

std::vector<Se2> poses_of_intervals(const Scene& scene, const PoseProblem& problem, Vec2 place,
                                    const Execution& execution) {
  std::vector<Se2> poses;
  if (problem.robot.outline.empty()) return poses;
  const double room = problem.clearance + end_margin(scene, problem, execution);
  for (const HeadingInterval& fits : free_headings(scene, problem.robot.outline, place, room, execution)) {
    poses.push_back({place.x, place.y, fits.middle()});
  }
  return poses;
}

double extent_of(const RobotSpec& robot) {
  double extent = robot.radius;
  for (const Vec2 corner : robot.outline) extent = std::max(extent, norm(corner));
  return extent;
}

double end_margin(const Scene& scene, const PoseProblem& problem, const Execution& execution) {
  return end_margin(scene, problem.robot, problem.clearance, extent_of(problem.robot), execution);
}

std::vector<Se2> recorded_poses(const RecordedAnswer& answer, std::string_view body) {
  check_state_width(answer, 3, body);
  std::vector<Se2> path;
  for (std::size_t i = 0; i < answer.states.size(); ++i) {
    const auto state = answer.states[i];
    path.push_back({state[0], state[1], state[2]});
  }
  return path;
}

void check_pose_sampler(std::optional<SamplerKind> sampler) {
  if (!sampler || !takes_all_places(*sampler)) return;
  throw UsageError(fmt::format(
      "@sampler: {} is for points and discs in mazes and on maps; a turning body takes the others", name_of(*sampler)));
}

void record_poses(Answer& answer, std::span<const Se2> path) {
  answer.states.width = 3;
  for (const Se2& pose : path) {
    answer.path.push_back(pose.position());
    answer.states.add(std::array{pose.x, pose.y, pose.theta});
  }
}

}  // namespace warren
