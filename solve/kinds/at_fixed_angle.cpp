// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/at_fixed_angle.hpp"

#include <algorithm>
#include <cmath>

#include "planners/visibility/visibility_path.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "worlds/plane/obstacles_at_fixed_angle.hpp"

namespace warren {
namespace {

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
                              const Execution& execution, Drawing* drawing) {
  const Vec2 start = problem.start.position();
  if (!problem.cells) return visibility_path(obstacles, start, problem.goal, {}, execution);
  CellOptions options = *problem.cells;
  options.overlaps = Overlaps::united;
  CellPlan plan;
  Solution<Vec2> solution = plan_through_cells(obstacles, start, problem.goal, options, execution, &plan);
  if (drawing != nullptr) drawing->layers.push_back(doors_of(plan.cells));
  return solution;
}

/// Is there any place where the body, at the start's angle, has its room in the bounds?
bool fits_in_bounds(const Scene& scene, const FixedAngleProblem& problem, double room) {
  if (!scene.bounds) return true;
  Box body;
  for (const Vec2 p : problem.outline) body.include(placed({0.0, 0.0, problem.start.theta}, p));
  return body.width() + 2.0 * room < scene.bounds->width() && body.height() + 2.0 * room < scene.bounds->height();
}

}  // namespace

Solution<Se2> plan_at_fixed_angle(const Scene& scene, const FixedAngleProblem& problem, const Execution& execution,
                                  Drawing* drawing) {
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
  Solution<Vec2> plane = plan_for_point(obstacles, problem, execution, drawing);
  if (drawing != nullptr) drawing->layers.push_back({"blocked", colors::layer, widths::edge, obstacles.polygons, true});
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

}  // namespace warren
