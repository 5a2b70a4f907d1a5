// SPDX-License-Identifier: BSD-3-Clause
// prm, lazy-prm, rrt and rrt-connect for a point or disc on an occupancy map: joins worlds/grid_world with the planners
// that sample it. Motions are certified against the closed squares of blocked cells, wherever between them they lead.
#include <fmt/format.h>

#include <optional>

#include "core/base/error.hpp"
#include "pictures/draw_sweep.hpp"
#include "planners/roadmap/lazy_prm.hpp"
#include "planners/roadmap/prm.hpp"
#include "planners/shorten/shortcut.hpp"
#include "planners/trees/rrt.hpp"
#include "planners/trees/rrt_connect.hpp"
#include "planners/trees/through_way_points.hpp"
#include "solve/kinds/map_steps.hpp"
#include "solve/question/solve_steps.hpp"
#include "solve/question/tree_choice.hpp"
#include "worlds/plane/grid_world.hpp"

namespace warren {
namespace {

/// One solve: the steps share the question and fill in the answer.
class SampledMapSolve {
 public:
  SampledMapSolve(const SolveRequest& request, const WallProblem& problem)
      : request_(request), map_(*request.scene.map), problem_(problem) {
    is_roadmap_planner(request.planner) ? describe_roadmap() : describe_trees();
  }

  void run() {
    index();
    bound_growth();
    take_solution(answer_, is_roadmap_planner(request_.planner) ? plan_roadmap() : plan_trees());
    answer_.outcome = settled_on_map(answer_.outcome, map_, problem_, request_.execution);
    if (answer_.outcome == Outcome::solved && request_.arguments.has("--optimise")) optimise();
    verify_solved_on_map(answer_, map_, problem_, false, request_.execution);
    if (request_.drawing != nullptr) request_.drawing->roadmap = in_the_plane(roadmaps_, request_.execution);
  }
  Answer& answer() { return answer_; }

 private:
  void describe_roadmap();
  void describe_trees();
  void index();
  void bound_growth();
  Solution<Vec2> plan_roadmap();
  Solution<Vec2> plan_trees();
  std::vector<std::vector<Vec2>> stops() const;
  Roadmap<Vec2>* kept() { return request_.drawing != nullptr ? &roadmaps_.emplace_back() : nullptr; }
  void optimise();

  const SolveRequest& request_;
  const OccupancyMap& map_;
  WallProblem problem_;
  RoadmapOptions roadmap_options_;  // of prm and lazy-prm
  RrtOptions tree_options_;         // of the others
  std::vector<Vec2> via_;
  std::optional<GridWorld> world_;
  std::vector<Roadmap<Vec2>> roadmaps_;  // for the picture
  Answer answer_;
};

void SampledMapSolve::describe_roadmap() {
  const PlannerOptions options = planner_options(request_.arguments, request_.scene, problem_);
  roadmap_options_ = options.roadmap;
  describe_roadmap_planner(answer_, problem_, options);
  const bool free_choice = !sampler_asked(request_.arguments) && !roadmap_options_.samples;
  if (free_choice && is_narrow(map_.blocked)) roadmap_options_.sampler = SamplerKind::cell_centres;
  answer_.sampler = name_of(roadmap_options_.sampler);
  answer_.pipeline.clear();  // there is one
}

void SampledMapSolve::describe_trees() {
  tree_options_ = tree_options(request_.arguments);
  if (!tree_options_.sampler) tree_options_.sampler = SamplerKind::uniform;
  for (const auto& point : way_points(request_.arguments)) {
    if (point.size() != 2) throw UsageError("--via: a point or disc takes X,Y");
    via_.push_back({point[0], point[1]});
  }
  answer_.problem = problem_.general();
  answer_.planner = name_of(request_.planner);
  answer_.sampler = sampler_name(tree_options_);
  answer_.seed = tree_options_.seed;
  answer_.options = given_tree_options(request_.arguments);
}

void SampledMapSolve::index() {
  const StageTimer timer(request_.execution, "index", answer_.seconds.index, map_.blocked.size());
  const auto asks = [&](SamplerKind sampler) { return answer_.sampler == name_of(sampler); };
  const MapMilestones milestones = asks(SamplerKind::corridor)       ? MapMilestones::corridors
                                   : asks(SamplerKind::cell_centres) ? MapMilestones::cell_centres
                                                                     : MapMilestones::anywhere;
  if (map_.water.empty()) {
    world_.emplace(map_, problem_.reach(), request_.execution, milestones);
    return;
  }
  OccupancyMap map = map_;
  map.blocked = closed_cells(map_, problem_.start);
  world_.emplace(map, problem_.reach(), request_.execution, milestones);
}

/// What grows until start and goal connect, a roadmap for one round and trees for a few nodes, where they never can.
void SampledMapSolve::bound_growth() {
  const bool is_roadmap = is_roadmap_planner(request_.planner);
  const bool grows = is_roadmap ? !roadmap_options_.samples && !takes_all_places(roadmap_options_.sampler)
                                : !request_.arguments.has("--nodes");
  if (!grows) return;
  const StageTimer timer(request_.execution, "proof", answer_.seconds.search);
  const OccupancyMap& map = world_->map();
  if (!provably_apart(map, map.blocked, problem_, request_.execution)) return;
  if (is_roadmap) {
    roadmap_options_.samples = first_samples(*world_, roadmap_options_, request_.execution);
  } else {
    tree_options_.nodes = nodes_where_apart;
  }
}

Solution<Vec2> SampledMapSolve::plan_roadmap() {
  const auto planner = request_.planner == PlannerKind::prm ? prm<GridWorld> : lazy_prm<GridWorld>;
  return planner(*world_, problem_.start, problem_.goal, roadmap_options_, request_.execution, kept());
}

/// Way-points and goal, one state each.
std::vector<std::vector<Vec2>> SampledMapSolve::stops() const {
  std::vector<std::vector<Vec2>> stops;
  auto query = world_->make_query();
  for (const Vec2 p : via_) {
    if (!world_->is_free(p, query)) {
      throw UsageError(fmt::format("--via: the body does not fit at way-point {}", stops.size() + 1));
    }
    stops.push_back({p});
  }
  stops.push_back({problem_.goal});
  return stops;
}

Solution<Vec2> SampledMapSolve::plan_trees() {
  const auto planner = request_.planner == PlannerKind::rrt ? rrt<GridWorld> : rrt_connect<GridWorld>;
  const auto plan = [&](const Vec2& start, std::span<const Vec2> goals, std::size_t) {
    return planner(*world_, start, goals, tree_options_, request_.execution, kept());
  };
  return plan_through<Vec2>(problem_.start, stops(), plan);
}

void SampledMapSolve::optimise() {
  const StageTimer timer(request_.execution, "optimise", answer_.seconds.optimise, answer_.path.size());
  answer_.raw_length = path_length(answer_.path, GridWorld::distance);
  answer_.path = shortcut_path(*world_, std::move(answer_.path), GridWorld::distance, {.seed = answer_.seed},
                               request_.execution, answer_.counters);
}

}  // namespace

Answer solve_sampled_on_map(const SolveRequest& request) {
  SampledMapSolve solve(request, map_problem(request.scene, request.problem));
  answer_within_limits(solve.answer(), [&] { solve.run(); });
  return std::move(solve.answer());
}

}  // namespace warren
