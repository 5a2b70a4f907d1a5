// SPDX-License-Identifier: BSD-3-Clause
// The planner voronoi for a polygon that could turn: along the medial axis of the scene, or the skeleton of a map, with
// the disc that holds the body in any heading, so the heading of the start serves all the way; where the goal names
// another, the body turns when it is there. A body that fits only in some headings is not found a way: not_connected.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/plane/se2.hpp"
#include "pictures/draw_sweep.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "solve/kinds/map_steps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/question/question_of_pose.hpp"
#include "solve/question/solve_steps.hpp"
#include "verify/judges/verify_turning.hpp"

namespace warren {
namespace {

constexpr PlannerChoice turning_axis_planners[] = {{PlannerKind::voronoi, "--objective --search --queue"}};

bool fits_turning(const Scene&, const RobotSpec& robot) { return robot.kind == RobotKind::polygon; }

PlannerKind usual_turning_axis_planner(const Arguments&, const Scene&, const ProblemOptions&) {
  return PlannerKind::voronoi;
}

/// The same question for the disc that holds the body.
ProblemOptions question_of_disc(const PoseProblem& problem) {
  ProblemOptions options;
  options.robot = RobotSpec{.kind = RobotKind::disc, .outline = {}};
  for (const Vec2 p : problem.robot.outline) options.robot->radius = std::max(options.robot->radius, norm(p));
  options.start = {problem.start.x, problem.start.y};
  options.goal = {problem.goal[0], problem.goal[1]};
  options.clearance = problem.clearance;
  return options;
}

class AxisSolve {
 public:
  explicit AxisSolve(const SolveRequest& request)
      : request_(request), problem_(pose_problem(request.scene, request.problem, "a turning body")) {}

  Answer run() {
    const ProblemOptions disc = question_of_disc(problem_);
    const SolveRequest of_disc{request_.arguments, request_.scene,     disc,
                               request_.planner,   request_.execution, request_.drawing};
    answer_ = request_.scene.map ? solve_on_skeleton(of_disc) : solve_on_medial_axis(of_disc);
    answer_.problem = problem_.general();
    const double seconds = answer_.solve_s;
    const Outcome outcome = answer_.outcome;
    if (outcome != Outcome::stopped) answer_within_limits(answer_, [&] { finish(); });
    if (outcome != Outcome::stopped) answer_.solve_s += seconds;
    return std::move(answer_);
  }

 private:
  void finish() {
    if (answer_.outcome != Outcome::solved) return settle_blocked_ends();
    for (const Vec2 p : answer_.path) poses_.push_back({p.x, p.y, problem_.start.theta});
    turn_at_the_goal();
    verify();
    if (request_.drawing != nullptr) {
      request_.drawing->layers.push_back(sweep_of(poses_, problem_.robot.outline));
    }
  }

  /// In steps of at most a third of a turn, so that the way round is never in doubt.
  void turn_at_the_goal() {
    if (problem_.any_heading()) return;
    constexpr double most_rad = 2.0 * std::numbers::pi / 3.0;
    const double turn = turn_between(problem_.start.theta, problem_.goal[2]);
    const auto steps = static_cast<int>(std::ceil(std::abs(turn) / most_rad));
    for (int i = 1; i <= steps; ++i) {
      const double theta = i == steps ? problem_.goal[2] : problem_.start.theta + turn * i / steps;
      poses_.push_back({problem_.goal[0], problem_.goal[1], theta});
    }
  }

  /// The disc doesn't fit; the body may.
  void settle_blocked_ends() {
    settle_blocked_poses(answer_, problem_, [&](const Se2& pose) {
      return verified(std::span(&pose, 1), {.clearance = problem_.clearance}).verified;
    });
  }

  Verification verified(std::span<const Se2> path, const PoseVerifyOptions& options) const {
    return verify_se2(request_.scene, problem_.robot.outline, path, options, request_.execution);
  }

  void verify() {
    const StageTimer timer(request_.execution, "verify", answer_.seconds.verify, poses_.size());
    const PoseVerifyOptions options{.clearance = problem_.clearance,
                                    .start = problem_.start,
                                    .goal = problem_.goal_pose(),
                                    .any_heading = problem_.any_heading()};
    const Verification found = verified(poses_, options);
    if (!found.verified) fail_verification(answer_, found.first_violation);
    answer_.verified = true;
    answer_.length = found.length;
    answer_.turn_rad = found.turn_rad;
    answer_.min_clearance = found.min_clearance;
    answer_.path.clear();
    record_poses(answer_, poses_);
  }

  const SolveRequest& request_;
  PoseProblem problem_;
  std::vector<Se2> poses_;
  Answer answer_;
};

Answer solve_turning_axis(const SolveRequest& request) { return AxisSolve(request).run(); }

}  // namespace

SolveKind turning_axis_kind() {
  return {"a polygon along the medial axis",
          fits_turning,
          turning_axis_planners,
          plane_option_specs(),
          usual_turning_axis_planner,
          solve_turning_axis,
          nullptr,
          nullptr};
}

}  // namespace warren
