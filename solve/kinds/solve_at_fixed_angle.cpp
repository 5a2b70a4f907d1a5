// SPDX-License-Identifier: BSD-3-Clause
// The planners that don't turn a polygon, in scenes: on maps, whose cells all touch, they have none. Minkowski sums of
// the obstacles with the mirrored body (worlds/plane/obstacles_at_fixed_angle), and the visibility graph among them,
// which gives the shortest path, or vertical cells around their union. The body keeps a hair's breadth off the
// obstacles, a ten-billionth of the world's size, so that rounding can't fail the verification; by so little, times the
// corners that it passes, the path may be longer than the shortest.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/base/error.hpp"
#include "core/plane/polygon.hpp"
#include "planners/visibility/visibility_path.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "worlds/plane/obstacles_at_fixed_angle.hpp"

namespace warren {
namespace {

double size_of(const Scene& scene, std::span<const Vec2> outline) {
  Box box = obstacle_box(scene);
  if (scene.bounds) box.include(*scene.bounds);
  double largest = outline_reach(outline);
  if (box.empty()) return largest;
  for (const double c : {box.min.x, box.min.y, box.max.x, box.max.y}) largest = std::max(largest, std::abs(c));
  return largest;
}

/// cells: none: the visibility graph.
Solution<Vec2> plan_for_point(const PlaneObstacles& obstacles, const PoseProblem& problem,
                              const std::optional<CellOptions>& cells, const Execution& execution, ByProducts* keep) {
  const Vec2 start = problem.start.position();
  const Vec2 goal = problem.goal_pose().position();
  if (!cells) return visibility_path(obstacles, start, goal, {}, execution);
  CellOptions options = *cells;
  options.overlaps = Overlaps::united;
  CellPlan plan;
  Solution<Vec2> solution = plan_through_cells(obstacles, start, goal, options, execution, &plan);
  if (keep != nullptr) keep->lines.push_back(doors_of(plan.cells));
  return solution;
}

/// Is there any place where the body, at the start's angle, has its room in the bounds?
bool fits_in_bounds(const Scene& scene, const PoseProblem& problem, double room) {
  if (!scene.bounds) return true;
  Box body;
  for (const Vec2 p : problem.robot.outline) body.include(placed({0.0, 0.0, problem.start.theta}, p));
  return body.width() + 2.0 * room < scene.bounds->width() && body.height() + 2.0 * room < scene.bounds->height();
}

/// The way of the reference point. `keep`, where given, receives what blocks it, and the cells. A body that does not
/// fit in the bounds at this angle starts blocked.
Solution<Vec2> plan_at_fixed_angle(const Scene& scene, const PoseProblem& problem,
                                   const std::optional<CellOptions>& cells, const Execution& execution,
                                   ByProducts* keep) {
  const std::vector<Vec2>& outline = problem.robot.outline;
  const double hair = 1e-10 * size_of(scene, outline);
  const std::size_t disc_corners = problem.clearance > 0.0 ? 32 : 4;  // of a polygon around the clearance's disc
  if (!fits_in_bounds(scene, problem, 2.0 * (problem.clearance + hair))) {
    Solution<Vec2> blocked;
    blocked.outcome = Outcome::start_blocked;
    return blocked;
  }
  double index_s = 0.0;
  PlaneObstacles obstacles;
  {
    const StageTimer timer(execution, "index", index_s);
    obstacles = translation_obstacles(scene, outline, problem.start.theta, problem.clearance + hair, disc_corners);
  }
  Solution<Vec2> solution = plan_for_point(obstacles, problem, cells, execution, keep);
  if (keep != nullptr) keep->lines.push_back({"blocked", obstacles.polygons, true});
  solution.seconds.index += index_s;
  return solution;
}

void check_angles(const PoseProblem& problem, PlannerKind planner) {
  constexpr double same_rad = 1e-9;
  if (problem.any_heading() || std::abs(turn_between(problem.start.theta, problem.goal[2])) <= same_rad) return;
  throw UsageError(
      fmt::format("@planner: {} does not turn the body; start and goal have different angles", name_of(planner)));
}

void find_and_verify(const SolveRequest& request, const PoseProblem& problem, const std::optional<CellOptions>& cells,
                     Answer& answer) {
  const Solution<Vec2> solution = plan_at_fixed_angle(request.scene, problem, cells, request.execution, request.keep);
  if (cells) answer.cells = CellCount{solution.roadmap.milestones, solution.roadmap.edges};
  take_account(answer, solution);
  settle_blocked_poses(answer, request.scene, problem, request.execution, [&](const Se2& pose) {
    return turning_stands_free(request.scene, problem, pose, request.execution);
  });
  if (answer.outcome != Outcome::solved) return;
  Path<Se2> poses;
  for (const Vec2 p : solution.path) poses.push_back({p.x, p.y, problem.start.theta});
  judge_turning(request.scene, problem, poses, request.execution, answer);
}

constexpr AskedWords fixed_words = restriction_words | AskedWords{AskedWord::goal};
constexpr PlannerChoice fixed_angle_planners[] = {
    {PlannerKind::visibility, {Option::bound}, fixed_words},
    {PlannerKind::cells, {Option::doors, Option::search, Option::queue, Option::bound}, fixed_words}};

bool fits_fixed_angle(const Scene& scene, const RobotSpec& robot) {
  return robot.kind == RobotKind::polygon && !scene.map;
}

Answer solve_fixed_angle(const SolveRequest& request) {
  const PoseProblem problem = pose_problem(request.scene, request.question, turning_body);
  check_angles(problem, request.planner);
  const SearchChoice search = search_choice(request.options);
  Answer answer;
  answer.problem = problem.general();
  answer.planner = name_of(request.planner);
  answer.search = name_of(search.search);
  std::optional<CellOptions> cells;
  if (request.planner == PlannerKind::cells) {
    cells = cell_options(request.options, search);
    answer.options.push_back(doors_option(*cells));
  }
  answer_within_limits(answer, [&] { find_and_verify(request, problem, cells, answer); });
  return answer;
}

}  // namespace

SolveKind fixed_angle_kind() {
  return {"a polygon at a fixed angle", fits_fixed_angle, fixed_angle_planners, usually<PlannerKind::visibility>,
          solve_fixed_angle};
}

}  // namespace warren
