// SPDX-License-Identifier: BSD-3-Clause
// The planner voronoi for a polygon that could turn: along the medial axis of the scene, or the skeleton of a map, with
// the disc that holds the body in any heading, so the heading of the start serves all the way; where the goal names
// another, the body turns when it is there. A body that fits only in some headings is not found a way: not_connected.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/error.hpp"
#include "core/se2.hpp"
#include "tools/map_planners.hpp"
#include "tools/plane_planners.hpp"
#include "tools/sweep_drawing.hpp"
#include "tools/verified_answer.hpp"
#include "worlds/plane_obstacles.hpp"
#include "worlds/verify_se2.hpp"

namespace warren {
namespace {

constexpr PlannerChoice planners[] = {{PlannerKind::voronoi, "--objective --search --queue"}};

bool fits_turning(const Scene& scene, const RobotSpec& robot) {
  return robot.kind == RobotKind::polygon && scene.spheres.empty();
}

PlannerKind usual_planner(const Arguments&, const Scene&, const ProblemOptions&) { return PlannerKind::voronoi; }

/// The question, and the same for the disc that holds the body.
struct AxisProblem {
  RobotSpec robot;
  Se2 start;
  std::vector<double> goal;
  double clearance;
  ProblemOptions of_disc;

  AxisProblem(const Scene& scene, const ProblemOptions& options)
      : robot(robot_of(scene, options)), clearance(clearance_of(scene, options)) {
    const std::vector<double> from = state_or_heading("--start", options.start, scene.start);
    start = {from[0], from[1], from.size() == 3 ? from[2] : 0.0};
    goal = state_or_heading("--goal", options.goal, scene.goal);
    of_disc.robot = RobotSpec{.kind = RobotKind::disc, .outline = {}};
    for (const Vec2 p : robot.outline) of_disc.robot->radius = std::max(of_disc.robot->radius, norm(p));
    of_disc.start = {start.x, start.y};
    of_disc.goal = {goal[0], goal[1]};
    of_disc.clearance = clearance;
    of_disc.contact = options.contact;
  }
  Problem general() const { return {robot, {start.x, start.y, start.theta}, goal, clearance, Contact::blocked}; }
  Se2VerifyOptions verify_options() const {
    const bool any_heading = goal.size() == 2;
    return {.clearance = clearance,
            .start = start,
            .goal = Se2{goal[0], goal[1], any_heading ? 0.0 : goal[2]},
            .any_heading = any_heading};
  }
};

class AxisSolve {
 public:
  explicit AxisSolve(const SolveRequest& request) : request_(request), problem_(request.scene, request.problem) {}

  Answer run() {
    const SolveRequest of_disc{request_.arguments, request_.scene,     problem_.of_disc,
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
    if (problem_.goal.size() == 2) return;
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
    const bool start = answer_.outcome == Outcome::start_blocked;
    if (!start && answer_.outcome != Outcome::goal_blocked) return;
    const bool goal_turned = !start && problem_.goal.size() == 3;
    const Se2 pose =
        start ? problem_.start
              : Se2{problem_.goal[0], problem_.goal[1], goal_turned ? problem_.goal[2] : problem_.start.theta};
    const bool any_heading = !start && !goal_turned;
    if (any_heading || verified(std::span(&pose, 1), {.clearance = problem_.clearance}).verified) {
      answer_.outcome = Outcome::not_connected;
    }
  }

  Se2Verification verified(std::span<const Se2> path, const Se2VerifyOptions& options) const {
    return verify_se2(request_.scene, problem_.robot.outline, path, options, request_.execution);
  }

  void verify() {
    const StageTimer timer(request_.execution, "verify", answer_.seconds.verify, poses_.size());
    const Se2Verification found = verified(poses_, problem_.verify_options());
    if (!found.verified) {
      const Violation violation = found.first_violation.value_or(Violation{});
      throw std::logic_error(fmt::format("the path of {} fails its verification at leg {}: {} is {} away",
                                         answer_.planner, violation.leg, violation.obstacle, violation.distance));
    }
    answer_.length = found.length;
    answer_.turn_rad = found.turn_rad;
    answer_.min_clearance = found.min_clearance;
    answer_.states = {.width = 3, .numbers = {}};
    answer_.path.clear();
    for (const Se2& pose : poses_) {
      answer_.path.push_back(pose.position());
      answer_.states.add(std::array{pose.x, pose.y, pose.theta});
    }
  }

  const SolveRequest& request_;
  AxisProblem problem_;
  std::vector<Se2> poses_;
  Answer answer_;
};

Answer solve(const SolveRequest& request) { return AxisSolve(request).run(); }

}  // namespace

SolveKind turning_axis_kind() {
  return {"a polygon along the medial axis",
          fits_turning,
          planners,
          plane_option_specs(),
          usual_planner,
          solve,
          nullptr,
          nullptr};
}

}  // namespace warren
