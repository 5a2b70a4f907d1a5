// SPDX-License-Identifier: BSD-3-Clause
// The planner voronoi: along the medial axis, as far from all obstacles as a path can be. min_clearance of the answer
// is measured on the path by the verification.
#include <fmt/format.h>

#include "core/base/error.hpp"
#include "planners/axis/medial_axis_planner.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/question/solve_steps.hpp"
#include "solve/question/write_answer_io.hpp"

namespace warren {
namespace {

MedialAxisOptions options_of(const SolveRequest& request, const WallProblem& problem, const SearchChoice& search) {
  constexpr double planning_room = 1 + 1e-9;  // so that rounding can't fail the verification
  MedialAxisOptions options;
  options.clearance = problem.reach() * planning_room;
  options.search = search.search;
  options.queue = search.queue;
  options.objective = axis_objective(request.arguments);
  return options;
}

void draw(const MedialAxis& axis, Drawing& drawing) {
  PictureLayer layer{"medial_axis", colors::layer, widths::search_tree, {}};
  std::vector<Vec2> points;
  for (const AxisEdge& edge : axis.edges()) {
    points.assign(1, axis.vertices()[edge.from]);
    axis.curve(edge).append_polyline(points);
    layer.lines.add(points);
  }
  drawing.layers.push_back(std::move(layer));
}

/// A box without area has no middle: said with the file's name.
void check_box(const Scene& scene) {
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene);
  if (box.empty() || (box.width() > 0.0 && box.height() > 0.0)) return;
  throw InputError(scene.source, "voronoi needs bounds, or obstacles, that span an area",
                   fmt::format("{} x {}", box.width(), box.height()));
}

}  // namespace

Answer solve_on_medial_axis(const SolveRequest& request) {
  if (request.problem.contact == Contact::allowed) {
    throw UsageError("--contact: voronoi keeps off the obstacles, so 'allowed' would change nothing");
  }
  const WallProblem problem = wall_problem(request.scene, request.problem);
  const SearchChoice search = search_choice(request.arguments);
  const MedialAxisOptions options = options_of(request, problem, search);
  Answer answer;
  describe_plane_planner(answer, request, problem, search);
  answer.options.emplace_back("objective", json_string(name_of(options.objective)));
  answer_within_limits(answer, [&] {
    check_box(request.scene);
    const PlaneObstacles obstacles = indexed_obstacles(request, answer);
    MedialAxisPlan plan;
    take_solution(answer, plan_without_clashes(request, [&] {
                    return plan_on_medial_axis(obstacles, problem.start, problem.goal, options, request.execution,
                                               &plan);
                  }));
    settle_blocked_ends(answer, request.scene, problem, request.execution);
    if (answer.outcome == Outcome::solved) {
      answer.path_figures.emplace_back("axis_length", json_number(plan.axis_length));
      answer.path_figures.emplace_back("axis_clearance", json_number(plan.axis_clearance));
    }
    if (request.drawing != nullptr && plan.axis) draw(*plan.axis, *request.drawing);
    verify_solved(answer, request.scene, problem, request.execution);
  });
  return answer;
}

}  // namespace warren
