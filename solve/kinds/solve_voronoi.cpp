// SPDX-License-Identifier: BSD-3-Clause
// The planner voronoi: along the medial axis, as far from all obstacles as a path can be. min_clearance of the answer
// is measured on the path by the verification.
#include <fmt/format.h>

#include "core/base/error.hpp"
#include "planners/axis/medial_axis_planner.hpp"
#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/steps/solve_steps.hpp"

namespace warren {
namespace {

MedialAxisOptions options_of(const SolveRequest& request, const WallProblem& problem, const SearchChoice& search) {
  MedialAxisOptions options;
  options.clearance = axis_clearance(problem);
  options.search = search.search;
  options.queue = search.queue;
  options.objective = request.options.axis.objective.value_or(AxisObjective::length);
  return options;
}

Solution<Vec2> plan_from_nothing(const SolveRequest& request, const WallProblem& problem,
                                 const MedialAxisOptions& options, Answer& answer, MedialAxisPlan& plan) {
  check_axis_box(request.scene);
  const PlaneObstacles obstacles = indexed_obstacles(request, answer);
  Solution<Vec2> solution;
  without_clashes(request, [&] {
    solution = plan_on_medial_axis(obstacles, problem.start, problem.goal, options, request.execution, &plan);
  });
  return solution;
}

NamedLines lines_of(const MedialAxis& axis) {
  NamedLines lines{"medial_axis", {}};
  std::vector<Vec2> points;
  for (const AxisEdge& edge : axis.edges()) {
    points.assign(1, axis.vertices()[edge.from]);
    axis.curve(edge).append_polyline(points);
    lines.lines.add(points);
  }
  return lines;
}

}  // namespace

WallProblem voronoi_problem(const Scene& scene, const Question& question) {
  return keeping_off(scene, question, "voronoi keeps off the obstacles");
}

double axis_clearance(const WallProblem& problem) {
  constexpr double planning_room = 1 + 1e-9;
  return problem.reach() * planning_room;
}

void check_axis_box(const Scene& scene) {
  const Box box = scene.bounds ? *scene.bounds : obstacle_box(scene);
  if (box.empty() || (box.width() > 0.0 && box.height() > 0.0)) return;
  throw InputError(scene.source, "voronoi needs bounds, or obstacles, that span an area",
                   fmt::format("{} x {}", box.width(), box.height()));
}

Answer solve_on_medial_axis(const SolveRequest& request) {
  const WallProblem problem = voronoi_problem(request.scene, request.question);
  const SearchChoice search = search_choice(request.options);
  const MedialAxisOptions options = options_of(request, problem, search);
  Answer answer;
  describe_plane_planner(answer, request, problem, search);
  answer.options.push_back({"objective", std::string(name_of(options.objective))});
  answer_within_limits(answer, [&] {
    MedialAxisPlan plan;
    const AxisRoadmap* known = asked_roadmap<AxisRoadmap>(request);
    take_solution(answer, known != nullptr ? plan_on_medial_axis(*known, problem.start, problem.goal, options,
                                                                 request.execution, &plan)
                                           : plan_from_nothing(request, problem, options, answer, plan));
    settle_blocked_ends(answer, request.scene, problem, request.execution, request.asked.judged());
    if (problem.start == problem.goal && !is_blocked(answer.outcome) && answer.outcome != Outcome::stopped) {
      stay(answer, problem);
    } else if (answer.outcome == Outcome::solved) {
      answer.path_figures.push_back({"axis_length", plan.axis_length});
      answer.path_figures.push_back({"axis_clearance", plan.axis_clearance});
    }
    const MedialAxis* axis = known != nullptr ? &known->axis : plan.axis ? &*plan.axis : nullptr;
    if (request.keep != nullptr && axis != nullptr) request.keep->lines.push_back(lines_of(*axis));
    verify_solved(answer, request.scene, problem, request.execution, request.asked.judged());
  });
  return answer;
}

}  // namespace warren
