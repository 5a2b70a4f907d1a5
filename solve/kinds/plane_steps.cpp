// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/plane_steps.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "planners/vertical_cells/cell_decomposition.hpp"
#include "scenes/scene/plane_obstacles.hpp"

namespace warren {
namespace {

std::string obstacle_text(const Scene& scene, std::size_t number) {
  if (number == ObstacleClash::bounds) return "the bounds";
  if (number >= scene.polygons.size()) return fmt::format("wall {}", number - scene.polygons.size());
  const std::size_t line = scene.polygons[number].line;
  return line > 0 ? fmt::format("the polygon of line {}", line) : fmt::format("polygon {}", number);
}

/// Of the planner visibility, where it plans for what keeps a distance.
void refuse_points_options(const SolveOptions& options) {
  const bool other_search = options.search && *options.search != SearchMethod::astar;
  const std::string_view option = options.visibility.full            ? "full"
                                  : options.visibility.sampled_edges ? "sampled_edges"
                                  : options.visibility.lazy          ? "lazy"
                                  : options.queue                    ? "queue"
                                  : other_search                     ? "search"
                                                                     : "";
  if (option.empty()) return;
  throw UsageError(fmt::format(
      "@{}: visibility would ignore it for a disc or a clearance, whose tangents it draws as A* needs them", option));
}

}  // namespace

WallProblem touching_problem(const SolveRequest& request) {
  const std::string_view planner = name_of(request.planner);
  if (request.scene.map) {
    throw UsageError(fmt::format(
        "@planner: paths of {} may touch what is blocked, but a map's blocked cells are closed; take grid, prm or "
        "lazy-prm",
        planner));
  }
  const WallProblem problem = wall_problem(request.scene, request.question, Contact::allowed);
  if (problem.reach() > 0.0) {
    if (request.planner == PlannerKind::visibility) return refuse_points_options(request.options), problem;
    throw UsageError(
        fmt::format("@planner: {} plans for a point, which may touch obstacles; a disc or a clearance of {} needs "
                    "visibility, prm, lazy-prm or voronoi, or @clearance 0 and @robot point",
                    planner, problem.reach()));
  }
  if (problem.contact == Contact::blocked) {
    throw UsageError(
        fmt::format("@contact: paths of {} may touch obstacles; prm, lazy-prm and voronoi keep off them", planner));
  }
  return problem;
}

std::size_t corner_count(const Scene& scene) {
  constexpr std::size_t weight_of_point = 25;  // a wall without length is seen from everywhere
  std::size_t corners = 2 * scene.walls.size();
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Segment wall = scene.walls.segment(i);
    if (wall.a == wall.b) corners += weight_of_point;
  }
  for (const ScenePolygon& polygon : scene.polygons) corners += polygon.corners.size();
  return corners;
}

bool stand_on_seams(const SolveRequest& request, const WallProblem& problem, Answer& answer) {
  const bool goal_blocked = stands_on_seam(request.scene, problem.goal);
  const bool start_blocked = stands_on_seam(request.scene, problem.start);
  if (goal_blocked) answer.outcome = Outcome::goal_blocked;
  if (start_blocked) answer.outcome = Outcome::start_blocked;
  return start_blocked || goal_blocked;
}

void describe_plane_planner(Answer& answer, const SolveRequest& request, const WallProblem& problem,
                            const SearchChoice& search) {
  answer.problem = problem.general();
  answer.planner = name_of(request.planner);
  answer.search = name_of(search.search);
  answer.seed = search.seed;
  if (request.options.queue) answer.options.push_back({"queue", std::string(name_of(*request.options.queue))});
}

void stay(Answer& answer, const WallProblem& problem) {
  answer.outcome = Outcome::solved;
  answer.path = {problem.start, problem.goal};
  answer.path_figures.clear();
}

PlaneObstacles indexed_obstacles(const SolveRequest& request, Answer& answer) {
  const StageTimer timer(request.execution, "index", answer.seconds.index, request.scene.polygons.size());
  return plane_obstacles(request.scene, request.execution);
}

void without_clashes(const SolveRequest& request, const std::function<void()>& plan) {
  try {
    plan();
  } catch (const ObstacleClash& clash) {
    const Scene& scene = request.scene;
    const bool polygon = clash.obstacle() < scene.polygons.size();
    throw InputError(
        polygon ? place_of_polygon(scene, clash.obstacle()) : scene.source,
        fmt::format("{} takes obstacles that lie apart or touch, but {} and {} cross or overlap; prm, lazy-prm and "
                    "visibility take them",
                    name_of(request.planner), obstacle_text(scene, clash.obstacle()),
                    obstacle_text(scene, clash.other())));
  }
}

}  // namespace warren
