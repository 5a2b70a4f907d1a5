// SPDX-License-Identifier: BSD-3-Clause
// Joins Se2World with the planners that take it: a polygon that turns among walls, polygons and bounds, or on a map.
#include <cmath>
#include <optional>
#include <utility>

#include "solve/kinds/pose_body.hpp"
#include "solve/kinds/turning_judge.hpp"
#include "solve/steps/kind_of_problem.hpp"
#include "solve/steps/sampled_roadmap.hpp"
#include "solve/steps/sampled_solve.hpp"
#include "worlds/poses/se2_world.hpp"

namespace warren {
namespace {

class TurningPolygon : public PoseBody {
 public:
  using World = Se2World;

  explicit TurningPolygon(const SolveRequest& request)
      : PoseBody(request, pose_problem(request.scene, request.question, turning_body)) {}

  void index(std::optional<World>& world, SamplerKind) const {
    world.emplace(scene(), question().robot.outline, Se2Options{.clearance = question().clearance}, execution());
  }
  bool start_stands_free() const { return goal_stands_free(question().start); }
  bool goal_stands_free(const Se2& pose) const {
    return turning_stands_free(scene(), question(), pose, execution(), judged());
  }
  static double length(const World&, const Se2& a, const Se2& b) { return distance(a.position(), b.position()); }
  Path<Se2> shortened(const World& world, Path<Se2> path, Answer& answer) const {
    const auto plane_length = [&](const Se2& a, const Se2& b) { return length(world, a, b); };
    return shortcut(world, std::move(path), plane_length, answer);
  }
  void judge(const World&, const Path<Se2>& path, Answer& answer) const {
    judge_turning(scene(), question(), path, execution(), answer, judged());
  }
};

constexpr PlannerChoice turning_planners[] = {{PlannerKind::rrt_connect, rrt_connect_options},
                                              {PlannerKind::rrt, rrt_options},
                                              {PlannerKind::prm, prm_takes},
                                              {PlannerKind::lazy_prm, lazy_prm_takes}};

bool fits_turning(const Scene&, const RobotSpec& robot) { return robot.kind == RobotKind::polygon; }

PlannerKind usual_turning_planner(const SolveOptions&, const Scene&, const Question&) {
  return PlannerKind::rrt_connect;
}

Answer solve_turning(const SolveRequest& request) { return SampledSolve(request, TurningPolygon(request)).run(); }

}  // namespace

SolveKind turning_kind() {
  return {"a polygon that turns",
          fits_turning,
          turning_planners,
          usual_turning_planner,
          solve_turning,
          nullptr,
          recheck_turning,
          build_sampled<TurningPolygon>,
          open_sampled<TurningPolygon>};
}

}  // namespace warren
