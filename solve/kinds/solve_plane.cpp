// SPDX-License-Identifier: BSD-3-Clause
// A point or disc among polygons and walls: joins worlds/polygon_world with the planners that sample it.
#include <optional>

#include "core/base/error.hpp"
#include "planners/roadmap/lazy_prm.hpp"
#include "planners/roadmap/prm.hpp"
#include "planners/shorten/taut_path.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/question/kind_of_problem.hpp"
#include "solve/question/solve_steps.hpp"
#include "worlds/plane/polygon_world.hpp"

namespace warren {
namespace {

constexpr std::string_view plane_roadmap_options =
    "--sampler --samples --neighbours --radius --search --queue --lazy --pipeline --optimise";
constexpr PlannerChoice plane_planners[] = {{PlannerKind::prm, plane_roadmap_options},
                                            {PlannerKind::lazy_prm, plane_roadmap_options},
                                            {PlannerKind::visibility, "--full --lazy --sampled-edges --search --queue"},
                                            {PlannerKind::cells, "--doors --search --queue"},
                                            {PlannerKind::voronoi, "--objective --search --queue"}};

bool fits_plane(const Scene&, const RobotSpec& robot) {
  return robot.kind == RobotKind::point || robot.kind == RobotKind::disc;
}

/// A point may touch what it goes around, unless the contrary is asked for; who keeps a distance needs room.
PlannerKind usual_plane_planner(const Arguments&, const Scene& scene, const ProblemOptions& problem) {
  const double reach = clearance_of(scene, problem) + robot_of(scene, problem).radius;
  return reach > 0.0 || problem.contact == Contact::blocked ? PlannerKind::lazy_prm : PlannerKind::visibility;
}

/// prm and lazy-prm in a polygon world.
class SampledSolve {
 public:
  SampledSolve(const SolveRequest& request, const WallProblem& problem, const PlannerOptions& options)
      : request_(request), problem_(problem), options_(options) {
    describe_roadmap_planner(answer_, problem, options);
  }
  void run() {
    const Execution& execution = request_.execution;
    index();
    const auto planner = options_.planner == PlannerKind::prm ? prm<PolygonWorld> : lazy_prm<PolygonWorld>;
    take_solution(answer_, planner(*world_, problem_.start, problem_.goal, options_.roadmap, execution,
                                   request_.drawing != nullptr ? &request_.drawing->roadmap : nullptr));
    settle_blocked_ends(answer_, request_.scene, problem_, execution);
    if (options_.optimise && answer_.outcome == Outcome::solved) optimise();
    verify_solved(answer_, request_.scene, problem_, execution);
  }
  Answer& answer() { return answer_; }

 private:
  void index() {
    const StageTimer timer(request_.execution, "index", answer_.seconds.index, request_.scene.polygons.size());
    world_.emplace(request_.scene, problem_.reach(), request_.execution);
  }
  void optimise() {
    const StageTimer timer(request_.execution, "optimise", answer_.seconds.optimise, answer_.path.size());
    answer_.raw_length = path_length(answer_.path, PolygonWorld::distance);
    answer_.path = taut_path(world_->sides(), answer_.path, world_->planning_clearance(), request_.execution);
  }

  const SolveRequest& request_;
  const WallProblem& problem_;
  const PlannerOptions& options_;
  std::optional<PolygonWorld> world_;
  Answer answer_;
};

Answer solve_sampled(const SolveRequest& request) {
  if (request.problem.contact == Contact::allowed) {
    throw UsageError("--contact: prm and lazy-prm keep off the walls, so 'allowed' would change nothing");
  }
  const WallProblem problem = wall_problem(request.scene, request.problem);
  const PlannerOptions options = planner_options(request.arguments, request.scene, problem);
  SampledSolve solve(request, problem, options);
  answer_within_limits(solve.answer(), [&] { solve.run(); });
  return std::move(solve.answer());
}

Answer solve_plane(const SolveRequest& request) {
  switch (request.planner) {
    case PlannerKind::visibility:
      return solve_by_visibility(request);
    case PlannerKind::cells:
      return solve_by_cells(request);
    case PlannerKind::voronoi:
      return solve_on_medial_axis(request);
    default:
      return solve_sampled(request);
  }
}

Verdict recheck_plane(const Scene& scene, const ProblemOptions& options, const RecordedAnswer& answer,
                      const Execution& execution) {
  check_polygons(scene, execution);
  return verify_plane_answer(scene, wall_problem(scene, options), answer, execution);
}

}  // namespace

SolveKind plane_kind() {
  return {"a point or disc among polygons",
          fits_plane,
          plane_planners,
          plane_option_specs(),
          usual_plane_planner,
          solve_plane,
          nullptr,
          recheck_plane};
}

}  // namespace warren
