// SPDX-License-Identifier: BSD-3-Clause
// What the kinds share whose states are poses (x, y, theta), turning polygons and cars: the question, its options, and
// how the planners are asked. A goal X,Y without a heading is met in any: trees have it as 16 goals, evenly turned;
// roadmaps take the one of these that has the most room.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/plane/se2.hpp"
#include "planners/trees/rrt.hpp"
#include "planners/trees/rrt_connect.hpp"
#include "planners/trees/through_way_points.hpp"
#include "solve/question/answer.hpp"
#include "solve/question/kind_of_problem.hpp"
#include "solve/question/question.hpp"
#include "solve/question/read_answer_io.hpp"
#include "solve/question/settled_ends.hpp"

namespace warren {

struct PoseProblem {
  RobotSpec robot;
  Se2 start;
  std::vector<double> goal;  ///< 2 or 3 numbers
  double clearance = 0.0;

  bool any_heading() const { return goal.size() == 2; }
  Se2 goal_pose() const { return {goal[0], goal[1], any_heading() ? 0.0 : goal[2]}; }
  Problem general() const { return {robot, {start.x, start.y, start.theta}, goal, clearance, Contact::blocked}; }
};

/// `body`: "a turning body", for messages. Throws UsageError where start or goal are missing or have the wrong size,
/// and for contact that is allowed.
PoseProblem pose_problem(const Scene& scene, const ProblemOptions& options, std::string_view body);

/// The poses that will do for a state of 2 or 3 numbers.
std::vector<Se2> poses_of(const std::vector<double>& state);
/// The path of an answer whose states have three numbers; throws InputError for others.
std::vector<Se2> recorded_poses(const RecordedAnswer& answer, std::string_view body);

/// The options of prm and lazy-prm, and what the answer says of them. Throws UsageError.
RoadmapOptions pose_roadmap_options(const SolveRequest& request, Answer& answer);
/// The options of the trees, and what the answer says of them.
struct PoseTreeOptions {
  RrtOptions trees;
  std::vector<std::vector<double>> via;  ///< 2 or 3 numbers each
};
PoseTreeOptions pose_tree_options(const SolveRequest& request, Answer& answer);

/// Outcome, sizes, counters and times of a solution.
void take_pose_solution(Answer& answer, const Solution<Se2>& solution);
/// The path, as the answer gives it.
void record_poses(Answer& answer, std::span<const Se2> path);

/// The pose with the most room.
template <class W>
Se2 roomiest(const W& world, const std::vector<Se2>& poses) {
  auto query = world.make_query();
  std::vector<double> room;
  for (const Se2& pose : poses) room.push_back(world.clearance(pose, largest_coordinate, query));
  return poses[static_cast<std::size_t>(std::max_element(room.begin(), room.end()) - room.begin())];
}

/// Way-points and goal as the poses that will do. Throws UsageError for a way-point where the body doesn't fit.
template <class W>
std::vector<std::vector<Se2>> pose_stops(const W& world, const std::vector<std::vector<double>>& via,
                                         const std::vector<double>& goal) {
  std::vector<std::vector<Se2>> stops;
  for (const auto& point : via) {
    check_heading("--via", point);
    stops.push_back(detail::free_states(world, std::span<const Se2>(poses_of(point))));
    if (!stops.back().empty()) continue;
    throw UsageError(fmt::format("--via: the body does not fit at way-point {}", stops.size()));
  }
  stops.push_back(poses_of(goal));
  return stops;
}

/// rrt or rrt_connect through the way-points; `keep`, where given, receives the trees of each leg.
template <class W>
Solution<Se2> plan_pose_trees(const W& world, PlannerKind kind, const PoseProblem& problem,
                              const PoseTreeOptions& options, const Execution& execution,
                              std::vector<Roadmap<Se2>>* keep) {
  const auto planner = kind == PlannerKind::rrt ? rrt<W> : rrt_connect<W>;
  const auto plan = [&](const Se2& start, std::span<const Se2> goals, std::size_t) {
    Roadmap<Se2>* kept = keep != nullptr ? &keep->emplace_back() : nullptr;
    return planner(world, start, goals, options.trees, execution, kept);
  };
  return plan_through<Se2>(problem.start, pose_stops(world, options.via, problem.goal), plan);
}

/// Planning keeps a little more room than it must, so a body that fits exactly is no blocked one: nobody proved that.
/// stands_free(pose): by the verification.
template <class StandsFree>
void settle_blocked_poses(Answer& answer, const PoseProblem& problem, const StandsFree& stands_free) {
  answer.outcome = settled_ends(
      answer.outcome, [&] { return stands_free(problem.start); },
      [&] {
        const std::vector<Se2> goals = poses_of(problem.goal);
        return std::any_of(goals.begin(), goals.end(), stands_free);
      });
}

inline constexpr std::string_view pose_roadmap_option_names =
    "--sampler --samples --neighbours --radius --search --queue --optimise";
inline constexpr std::string_view pose_lazy_option_names =
    "--sampler --samples --neighbours --radius --search --queue --lazy --optimise";

}  // namespace warren
