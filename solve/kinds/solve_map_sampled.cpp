// SPDX-License-Identifier: BSD-3-Clause
// prm, lazy-prm, rrt and rrt-connect for a point or disc on an occupancy map: joins worlds/plane/grid_world with the
// planners that sample it. Motions are certified against the closed squares of blocked cells, wherever between them
// they lead.
#include <fmt/format.h>

#include <optional>

#include "core/base/error.hpp"
#include "planners/shorten/shortcut.hpp"
#include "solve/kinds/map_steps.hpp"
#include "solve/question/tree_choice.hpp"
#include "solve/steps/sampled_roadmap.hpp"
#include "solve/steps/sampled_solve.hpp"
#include "solve/steps/solve_steps.hpp"
#include "worlds/plane/grid_world.hpp"

namespace warren {
namespace {

class BodyOnMap : public UsualBody {
 public:
  using World = GridWorld;
  static constexpr std::optional<SamplerKind> tree_sampler = SamplerKind::uniform;

  explicit BodyOnMap(const SolveRequest& request)
      : map_(*request.scene.map),
        execution_(request.execution),
        problem_(map_problem(request.scene, request.question)) {}

  Problem problem() const { return problem_.general(); }
  Vec2 start() const { return problem_.start; }
  std::vector<Vec2> goals(const World&) const { return {problem_.goal}; }
  static std::vector<Vec2> stop_at(const std::vector<double>& point) {
    if (point.size() != 2) throw UsageError("@via: a point or disc takes X,Y");
    return {{point[0], point[1]}};
  }
  SamplerKind choose_sampler(const SolveOptions& options, const RoadmapOptions& roadmap) const {
    const bool free_choice = !options.sampler && !roadmap.samples;
    return free_choice && is_narrow(map_.blocked) ? SamplerKind::cell_centres : roadmap.sampler;
  }
  void index(std::optional<World>& world, SamplerKind sampler) const;
  bool provably_apart(const World& world, const std::vector<Vec2>&) const {
    return warren::provably_apart(world.map(), world.map().blocked, problem_, execution_);
  }
  bool start_stands_free() const { return stands_free_on_map(map_, problem_, problem_.start, execution_); }
  bool goal_stands_free(Vec2 goal) const {
    return starts_on_water(map_, problem_.start) || stands_free_on_map(map_, problem_, goal, execution_);
  }
  static double length(const World&, Vec2 a, Vec2 b) { return World::distance(a, b); }
  Path<Vec2> shortened(const World& world, Path<Vec2> path, Answer& answer) const {
    return shortcut_path(world, std::move(path), World::distance, {.seed = answer.seed}, execution_, answer.counters);
  }
  void judge(const World&, Path<Vec2> path, Answer& answer) const {
    answer.path = std::move(path);
    verify_solved_on_map(answer, map_, problem_, false, execution_);
  }

 private:
  const OccupancyMap& map_;
  const Execution& execution_;
  WallProblem problem_;
};

void BodyOnMap::index(std::optional<World>& world, SamplerKind sampler) const {
  const MapMilestones milestones = sampler == SamplerKind::corridor       ? MapMilestones::corridors
                                   : sampler == SamplerKind::cell_centres ? MapMilestones::cell_centres
                                                                          : MapMilestones::anywhere;
  if (map_.water.empty()) {
    world.emplace(map_, problem_.reach(), execution_, milestones);
    return;
  }
  OccupancyMap map = map_;
  map.blocked = closed_cells(map_, problem_.start);
  world.emplace(map, problem_.reach(), execution_, milestones);
}

}  // namespace

Answer solve_sampled_on_map(const SolveRequest& request) { return SampledSolve(request, BodyOnMap(request)).run(); }

BuiltArrays build_on_map(const SolveRequest& request) { return build_sampled<BodyOnMap>(request); }

std::unique_ptr<RoadmapSession> open_on_map(const SolveRequest& request, const RoadmapArrays& arrays,
                                            const ConnectionRule& rule) {
  return open_sampled<BodyOnMap>(request, arrays, rule);
}

}  // namespace warren
