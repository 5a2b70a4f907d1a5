// SPDX-License-Identifier: BSD-3-Clause
// A point or disc among polygons and walls: joins worlds/plane/polygon_world with the planners that sample it.
#include <optional>

#include "core/base/error.hpp"
#include "planners/shorten/taut_path.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/steps/kind_of_problem.hpp"
#include "solve/steps/sampled_roadmap.hpp"
#include "solve/steps/sampled_solve.hpp"
#include "solve/steps/solve_steps.hpp"
#include "worlds/plane/polygon_world.hpp"

namespace warren {
namespace {

constexpr OptionSet plane_roadmap_options =
    prm_takes | OptionSet{Option::lazy, Option::pipeline, Option::heuristic, Option::neighbour_index};
constexpr PlannerChoice plane_planners[] = {
    {PlannerKind::prm, plane_roadmap_options},
    {PlannerKind::lazy_prm, plane_roadmap_options},
    {PlannerKind::visibility,
     OptionSet{Option::full, Option::lazy, Option::sampled_edges, Option::search, Option::queue}},
    {PlannerKind::cells, OptionSet{Option::doors, Option::search, Option::queue}},
    {PlannerKind::voronoi, OptionSet{Option::objective, Option::search, Option::queue}}};

bool fits_plane(const Scene&, const RobotSpec& robot) {
  return robot.kind == RobotKind::point || robot.kind == RobotKind::disc;
}

/// A point may touch what it goes around, unless the contrary is asked for; who keeps a distance needs room.
PlannerKind usual_plane_planner(const SolveOptions&, const Scene& scene, const Question& question) {
  const double reach = clearance_of(scene, question) + robot_of(scene, question).radius;
  return reach > 0.0 || question.contact == Contact::blocked ? PlannerKind::lazy_prm : PlannerKind::visibility;
}

/// For prm and lazy-prm.
class PointAmongPolygons : public UsualBody {
 public:
  using World = PolygonWorld;
  static constexpr bool has_trees = false;
  static constexpr bool names_pipeline = true;
  static constexpr bool judged_by_index = true;

  explicit PointAmongPolygons(const SolveRequest& request)
      : scene_(request.scene),
        execution_(request.execution),
        judged_(request.asked.judged()),
        problem_(keeping_off(request.scene, request.question, "prm and lazy-prm keep off the walls")) {}

  Problem problem() const { return problem_.general(); }
  Vec2 start() const { return problem_.start; }
  std::vector<Vec2> goals(const World&) const { return {problem_.goal}; }
  std::vector<Vec2> stop_at(const std::vector<double>&) const { return {}; }
  static SamplerKind choose_sampler(const SolveOptions&, const RoadmapOptions& roadmap) { return roadmap.sampler; }
  void index(std::optional<World>& world, SamplerKind) const { world.emplace(scene_, problem_.reach(), execution_); }
  static bool provably_apart(const World&, const std::vector<Vec2>&) { return false; }
  bool start_stands_free() const { return stands_free(scene_, problem_, problem_.start, execution_, judged_); }
  bool goal_stands_free(Vec2 goal) const { return stands_free(scene_, problem_, goal, execution_, judged_); }
  static double length(const World&, Vec2 a, Vec2 b) { return World::distance(a, b); }
  Path<Vec2> shortened(const World& world, const Path<Vec2>& path, Answer&) const {
    return taut_path(world.sides(), path, world.planning_clearance(), execution_);
  }
  void judge(const World&, Path<Vec2> path, Answer& answer) const {
    answer.path = std::move(path);
    verify_solved(answer, scene_, problem_, execution_, judged_);
  }

 private:
  const Scene& scene_;
  const Execution& execution_;
  const ObstacleIndex* judged_;
  WallProblem problem_;
};

Answer solve_plane(const SolveRequest& request) {
  switch (request.planner) {
    case PlannerKind::visibility:
      return solve_by_visibility(request);
    case PlannerKind::cells:
      return solve_by_cells(request);
    case PlannerKind::voronoi:
      return solve_on_medial_axis(request);
    default:
      return SampledSolve(request, PointAmongPolygons(request)).run();
  }
}

BuiltArrays build_on_plane(const SolveRequest& request) {
  return is_roadmap_planner(request.planner) ? build_sampled<PointAmongPolygons>(request) : build_geometric(request);
}

std::unique_ptr<RoadmapSession> open_on_plane(const SolveRequest& request, const RoadmapArrays& arrays,
                                              const ConnectionRule& rule) {
  const auto open = is_roadmap_planner(request.planner) ? open_sampled<PointAmongPolygons> : open_geometric;
  return open(request, arrays, rule);
}

Verdict recheck_plane(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                      const Execution& execution) {
  check_polygons(scene, execution);
  return verify_plane_answer(scene, wall_problem(scene, question), answer, execution);
}

}  // namespace

SolveKind plane_kind() {
  return {"a point or disc among polygons",
          fits_plane,
          plane_planners,
          usual_plane_planner,
          solve_plane,
          nullptr,
          recheck_plane,
          build_on_plane,
          open_on_plane};
}

}  // namespace warren
