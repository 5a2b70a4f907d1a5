// SPDX-License-Identifier: BSD-3-Clause
// What the kinds share whose states are poses (x, y, theta), turning polygons and cars: the scene that they are planned
// in, the question, its options, how the planners are asked, and how their paths are judged. A goal X,Y without a
// heading is met in any: trees have it as 16 goals, evenly turned, or where the body fits at none of these as those
// between at which it does; roadmaps take the one with the most room.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/plane/se2.hpp"
#include "solve/answer/answer.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/question/question.hpp"
#include "verify/judges/verify_turning.hpp"

namespace warren {

/// The scene as it is planned in, with a map's borders as walls; none: as it is. Bodies that are planned among walls
/// see a map so; the others look at the cells. Throws Stopped.
std::optional<Scene> planned_copy(const Scene& scene, const Question& question, PlannerKind planner,
                                  const Execution& execution);

struct PoseProblem {
  RobotSpec robot;
  Se2 start;
  std::vector<double> goal;  ///< 2 or 3 numbers
  double clearance = 0.0;

  bool any_heading() const { return goal.size() == 2; }
  Se2 goal_pose() const { return {goal[0], goal[1], any_heading() ? 0.0 : goal[2]}; }
  bool is_at_goal() const {
    return start.position() == goal_pose().position() && (any_heading() || start.theta == goal[2]);
  }
  Problem general() const { return {robot, {start.x, start.y, start.theta}, goal, clearance, Contact::blocked}; }
};

/// Throws UsageError where start or goal are missing or have the wrong size, and for contact that is allowed.
PoseProblem pose_problem(const Scene& scene, const Question& options);

/// The poses that will do for a state of 2 or 3 numbers: of 2 those of 16 headings, evenly turned.
std::vector<Se2> poses_of(const std::vector<double>& state);
/// Those of the goal, and where none of several is free the middle of each interval of headings at which an outline
/// fits there as an end, but for obstacles around all of it: where all of these are blocked, every heading is.
std::vector<Se2> poses_to_meet(const Scene& scene, const PoseProblem& problem, const Execution& execution,
                               const std::function<bool(const Se2&)>& is_free);

/// The radius of the disc around its reference point that the body holds in any heading; none: the body need not be
/// where its reference point is.
std::optional<double> held_radius(const RobotSpec& robot);
/// How far the body reaches from its reference point.
double extent_of(const RobotSpec& robot);
/// What an end has beyond its clearance (solve/kinds/solve_steps.hpp).
inline double end_margin(const Scene& scene, const PoseProblem& problem, const Execution& execution) {
  return end_margin(scene, problem.robot, problem.clearance, extent_of(problem.robot), execution);
}

/// What the judge of a turning body or a car is asked for the problem.
PoseVerifyOptions verify_options(const PoseProblem& problem);
/// The judge's word on a path, and the path as the answer gives it. Throws as take_verdict().
void take_poses(Answer& answer, const Verification& verdict, std::span<const Se2> path);

/// The judge of a turning polygon or a car, as solves ask it. Refers to all of it.
struct PoseJudge {
  const Scene& scene;
  const PoseProblem& problem;
  const Execution& execution;
  const ObstacleIndex* index = nullptr;  ///< of the scene, where there is one

  Verification judged(std::span<const Se2> poses, const PoseVerifyOptions& options) const;
  bool stands_free(const Se2& pose) const;  ///< as an end
  /// What is said of the ends where the outcome calls one blocked.
  Outcome settled(Outcome outcome) const;
};

/// SolveKind::verify of turning polygons and cars.
Verdict recheck_poses(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                      const Execution& execution);

}  // namespace warren
