// SPDX-License-Identifier: BSD-3-Clause
// A point or disc on an occupancy map: which planners there are. Polygons on maps turn among the map's border walls
// (solve/kinds/solve_turning).
#include <vector>

#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/map_steps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/question/grid_choice.hpp"
#include "solve/question/tree_choice.hpp"

namespace warren {
namespace {

constexpr OptionSet occupancy_roadmap_options = prm_takes | OptionSet{Option::heuristic, Option::neighbour_index};
constexpr OptionSet lazy_options = lazy_prm_takes | OptionSet{Option::heuristic, Option::neighbour_index};
constexpr PlannerChoice occupancy_planners[] = {
    {PlannerKind::grid, OptionSet{Option::search, Option::diagonal, Option::optimise}},
    {PlannerKind::prm, occupancy_roadmap_options},
    {PlannerKind::lazy_prm, lazy_options},
    {PlannerKind::rrt, rrt_options},
    {PlannerKind::rrt_connect, rrt_connect_options},
    {PlannerKind::voronoi, OptionSet{Option::objective, Option::search, Option::queue}}};

bool fits_occupancy(const Scene& scene, const RobotSpec& robot) {
  return scene.map && (robot.kind == RobotKind::point || robot.kind == RobotKind::disc);
}

PlannerKind usual_occupancy_planner(const SolveOptions&, const Scene&, const Question&) { return PlannerKind::grid; }

Answer solve_occupancy(const SolveRequest& request) {
  switch (request.planner) {
    case PlannerKind::grid:
      return solve_by_cells_of_map(request);
    case PlannerKind::voronoi:
      return solve_on_skeleton(request);
    default:
      return solve_sampled_on_map(request);
  }
}

BuiltArrays build_occupancy(const SolveRequest& request) {
  return is_roadmap_planner(request.planner) ? build_on_map(request) : build_geometric(request);
}

std::unique_ptr<RoadmapSession> open_occupancy(const SolveRequest& request, const RoadmapArrays& arrays,
                                               const ConnectionRule& rule) {
  const auto open = is_roadmap_planner(request.planner) ? open_on_map : open_geometric;
  return open(request, arrays, rule);
}

Verdict recheck_occupancy(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                          const Execution& execution) {
  check_state_width(answer, 2, "a point or disc");
  const WallProblem problem = map_problem(scene, question);
  return {verify_map_path(*scene.map, problem, answer.path, execution), problem.general()};
}

}  // namespace

SolveKind occupancy_kind() {
  return {"a point or disc on an occupancy map",
          fits_occupancy,
          occupancy_planners,
          usual_occupancy_planner,
          solve_occupancy,
          nullptr,
          recheck_occupancy,
          build_occupancy,
          open_occupancy};
}

}  // namespace warren
