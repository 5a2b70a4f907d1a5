// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/turning_judge.hpp"

#include <cmath>
#include <span>
#include <vector>

#include "solve/kinds/solve_steps.hpp"
#include "verify/judges/verify_turning.hpp"

namespace warren {
namespace {

PoseVerifyOptions verify_options(const PoseProblem& problem) {
  return {.clearance = problem.clearance,
          .start = problem.start,
          .goal = problem.goal_pose(),
          .any_heading = problem.any_heading()};
}

Path<Se2> without_half_turns(const Path<Se2>& path) {
  constexpr double most_rad = 3.0;
  Path<Se2> cut;
  for (const Se2& pose : path) {
    if (!cut.empty() && std::abs(turn_between(cut.back().theta, pose.theta)) > most_rad) {
      cut.push_back(interpolate(Se2(cut.back()), pose, 0.5));
    }
    cut.push_back(pose);
  }
  return cut;
}

}  // namespace

bool turning_stands_free(const Scene& scene, const PoseProblem& problem, const Se2& pose, const Execution& execution,
                         const ObstacleIndex* judged) {
  const PoseVerifyOptions options{.clearance = problem.clearance + end_margin(scene, problem, execution)};
  return verify_se2(scene, problem.robot.outline, std::span(&pose, 1), options, execution, judged).verified;
}

void judge_turning(const Scene& scene, const PoseProblem& problem, const Path<Se2>& path, const Execution& execution,
                   Answer& answer, const ObstacleIndex* judged) {
  const Path<Se2> poses = without_half_turns(path);
  const StageTimer timer(execution, "verify", answer.seconds.verify, poses.size());
  const Verification found =
      verify_se2(scene, problem.robot.outline, poses, verify_options(problem), execution, judged);
  if (!found.verified) fail_verification(answer, found.first_violation);
  answer.verified = true;
  answer.length = found.length;
  answer.turn_rad = found.turn_rad;
  answer.min_clearance = found.min_clearance;
  answer.path.clear();
  record_poses(answer, poses);
}

Verdict recheck_turning(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                        const Execution& execution) {
  const PoseProblem problem = pose_problem(scene, question, turning_body);
  const std::vector<Se2> path = recorded_poses(answer, turning_body);
  return {verify_se2(scene, problem.robot.outline, path, verify_options(problem), execution), problem.general()};
}

}  // namespace warren
