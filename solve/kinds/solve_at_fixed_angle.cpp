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
#include <utility>

#include "core/base/error.hpp"
#include "planners/visibility/visibility_path.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "worlds/plane/obstacles_at_fixed_angle.hpp"

namespace warren {
namespace {

struct FixedAngleProblem {
  std::span<const Vec2> outline;
  Se2 start;
  Vec2 goal;
  double clearance = 0.0;            ///< a disc of this radius is replaced by a polygon of 32 corners around it
  std::optional<CellOptions> cells;  ///< none: the visibility graph
};

double size_of(const Scene& scene, std::span<const Vec2> outline) {
  Box box = obstacle_box(scene);
  if (scene.bounds) box.include(*scene.bounds);
  double largest = 0.0;
  for (const Vec2 p : outline) largest = std::max(largest, norm(p));
  if (box.empty()) return largest;
  for (const double c : {box.min.x, box.min.y, box.max.x, box.max.y}) largest = std::max(largest, std::abs(c));
  return largest;
}

Solution<Vec2> plan_for_point(const PlaneObstacles& obstacles, const FixedAngleProblem& problem,
                              const Execution& execution, ByProducts* keep) {
  const Vec2 start = problem.start.position();
  if (!problem.cells) return visibility_path(obstacles, start, problem.goal, {}, execution);
  CellOptions options = *problem.cells;
  options.overlaps = Overlaps::united;
  CellPlan plan;
  Solution<Vec2> solution = plan_through_cells(obstacles, start, problem.goal, options, execution, &plan);
  if (keep != nullptr) keep->lines.push_back(doors_of(plan.cells));
  return solution;
}

/// Is there any place where the body, at the start's angle, has its room in the bounds?
bool fits_in_bounds(const Scene& scene, const FixedAngleProblem& problem, double room) {
  if (!scene.bounds) return true;
  Box body;
  for (const Vec2 p : problem.outline) body.include(placed({0.0, 0.0, problem.start.theta}, p));
  return body.width() + 2.0 * room < scene.bounds->width() && body.height() + 2.0 * room < scene.bounds->height();
}

/// All poses of the path have the start's angle. `keep`, where given, receives what blocks the reference point, and the
/// cells. A body that does not fit in the bounds at this angle starts blocked.
Solution<Se2> plan_at_fixed_angle(const Scene& scene, const FixedAngleProblem& problem, const Execution& execution,
                                  ByProducts* keep) {
  const double hair = 1e-10 * size_of(scene, problem.outline);
  const std::size_t disc_corners = problem.clearance > 0.0 ? 32 : 4;
  Solution<Se2> solution;
  if (!fits_in_bounds(scene, problem, 2.0 * (problem.clearance + hair))) {
    solution.outcome = Outcome::start_blocked;
    return solution;
  }
  PlaneObstacles obstacles;
  {
    const StageTimer timer(execution, "index", solution.seconds.index);
    obstacles =
        translation_obstacles(scene, problem.outline, problem.start.theta, problem.clearance + hair, disc_corners);
  }
  Solution<Vec2> plane = plan_for_point(obstacles, problem, execution, keep);
  if (keep != nullptr) keep->lines.push_back({"blocked", obstacles.polygons, true});
  solution.outcome = plane.outcome;
  solution.stop_reason = plane.stop_reason;
  solution.roadmap = plane.roadmap;
  solution.separation = plane.separation;
  solution.counters = plane.counters;
  plane.seconds.index += solution.seconds.index;
  solution.seconds = plane.seconds;
  for (const Vec2 p : plane.path) solution.path.push_back({p.x, p.y, problem.start.theta});
  return solution;
}

/// One solve: the steps share the question and fill in the answer.
class FixedAngleSolve {
 public:
  explicit FixedAngleSolve(const SolveRequest& request)
      : request_(request), problem_(pose_problem(request.scene, request.question, turning_body)) {
    answer_.problem = problem_.general();
    answer_.planner = name_of(request.planner);
    check_angles();
    const SearchChoice search = search_choice(request.options);
    answer_.search = name_of(search.search);
    if (request.planner != PlannerKind::cells) return;
    cells_ = cell_options(request.options, search);
    answer_.options.push_back(doors_option(*cells_));
  }

  Answer run() {
    answer_within_limits(answer_, [this] { find_and_verify(); });
    return std::move(answer_);
  }

 private:
  void check_angles() const {
    constexpr double same_rad = 1e-9;
    if (problem_.any_heading() || std::abs(turn_between(problem_.start.theta, problem_.goal[2])) <= same_rad) return;
    throw UsageError(fmt::format("@planner: {} does not turn the body; start and goal have different angles",
                                 name_of(request_.planner)));
  }

  void find_and_verify() {
    const FixedAngleProblem problem{
        problem_.robot.outline, problem_.start, {problem_.goal[0], problem_.goal[1]}, problem_.clearance, cells_};
    const Solution<Se2> solution = plan_at_fixed_angle(request_.scene, problem, request_.execution, request_.keep);
    if (cells_) answer_.cells = CellCount{solution.roadmap.milestones, solution.roadmap.edges};
    take_account(answer_, solution);
    settle_blocked_poses(answer_, request_.scene, problem_, request_.execution, [this](const Se2& pose) {
      return turning_stands_free(request_.scene, problem_, pose, request_.execution);
    });
    if (answer_.outcome != Outcome::solved) return;
    judge_turning(request_.scene, problem_, solution.path, request_.execution, answer_);
  }

  const SolveRequest& request_;
  PoseProblem problem_;
  std::optional<CellOptions> cells_;  // of cells
  Answer answer_;
};

constexpr AskedWords fixed_words = restriction_words | AskedWords{AskedWord::goal};
constexpr PlannerChoice fixed_angle_planners[] = {
    {PlannerKind::visibility, {Option::bound}, fixed_words},
    {PlannerKind::cells, {Option::doors, Option::search, Option::queue, Option::bound}, fixed_words}};

bool fits_fixed_angle(const Scene& scene, const RobotSpec& robot) {
  return robot.kind == RobotKind::polygon && !scene.map;
}

Answer solve_fixed_angle(const SolveRequest& request) { return FixedAngleSolve(request).run(); }

}  // namespace

SolveKind fixed_angle_kind() {
  return {"a polygon at a fixed angle",
          fits_fixed_angle,
          fixed_angle_planners,
          usually<PlannerKind::visibility>,
          solve_fixed_angle,
          nullptr,
          nullptr};
}

}  // namespace warren
