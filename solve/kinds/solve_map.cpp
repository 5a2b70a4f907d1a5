// SPDX-License-Identifier: BSD-3-Clause
// A point or disc on an occupancy map: grid over its cells, voronoi along the skeleton of those that are free, and the
// planners that sample. Polygons on maps turn among the map's border walls (solve/kinds/solve_turning).

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "planners/grid/grid_search.hpp"
#include "planners/grid/skeleton_planner.hpp"
#include "planners/shorten/shortcut.hpp"
#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/map_steps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/sampled_roadmap.hpp"
#include "solve/kinds/sampled_solve.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/question/planner_choice.hpp"
#include "spatial/maps/distance_field.hpp"
#include "verify/judges/verify_map.hpp"
#include "worlds/plane/grid_world.hpp"

namespace warren {
namespace {

/// One solve by grid: the steps share the question and fill in the answer. What is not found may be proved infeasible.
class CellSolve {
 public:
  CellSolve(const SolveRequest& request, const WallProblem& problem)
      : request_(request), map_(*request.scene.map), problem_(problem) {
    grid_.diagonal = request.options.grid.diagonal.value_or(Diagonal::sqrt2);
    grid_.method =
        grid_method(request.options, grid_.diagonal == Diagonal::sqrt2 ? GridMethod::jump_points : GridMethod::astar);
    if (grid_.method == GridMethod::jump_points && grid_.diagonal != Diagonal::sqrt2) {
      throw UsageError("@search: jump points need @diagonal sqrt2");
    }
    answer_.problem = problem.general();
    answer_.planner = name_of(PlannerKind::grid);
    answer_.seed = request.options.seed;
    if (request.options.optimise) answer_.options.push_back({"optimise", true});
    if (request.options.grid.diagonal) {
      answer_.options.push_back({"diagonal", std::string(name_of(grid_.diagonal))});
    }
  }

  void run() {
    const auto start = cell_at(map_, problem_.start);
    const auto goal = cell_at(map_, problem_.goal);
    answer_.outcome = blocked_end(start, goal);
    if (answer_.outcome != Outcome::not_connected) return;
    index();
    choose_method();
    if (problem_.start == problem_.goal) {
      stay(answer_, problem_);
      count(1, 0.0);
    } else {
      search(cells_joined_to(problem_.start, *start), cells_joined_to(problem_.goal, *goal));
      if (answer_.outcome != Outcome::solved) return prove();
    }
    if (request_.options.optimise) optimise();
    verify_solved_on_map(answer_, map_, problem_, true, request_.execution);
  }
  Answer& answer() { return answer_; }

 private:
  bool stands_free(Vec2 p) const { return stands_free_on_map(map_, problem_, p, request_.execution); }
  Outcome blocked_end(const std::optional<Cell>& start, const std::optional<Cell>& goal) const {
    if (!start || !stands_free(problem_.start)) return Outcome::start_blocked;
    const bool on_water = !map_.water.empty() && map_.water.test(start->x, start->y);
    if (!goal || (!on_water && !stands_free(problem_.goal))) return Outcome::goal_blocked;
    return Outcome::not_connected;
  }

  void index() {
    const StageTimer timer(request_.execution, "index", answer_.seconds.index, map_.blocked.size());
    closed_ = closed_cells(map_, problem_.start);
    if (problem_.reach() > 0.0) {
      blocked_ = blocked_for_disc(closed_, problem_.reach() / map_.cell, request_.execution);
    }
  }
  const Bitmap& blocked() const { return blocked_.empty() ? closed_ : blocked_; }

  /// Does the robot get from a point to the middle of a cell in a straight line?
  bool is_joined(Vec2 p, Cell cell) const {
    const Vec2 leg[] = {p, cell_centre(map_, cell)};
    return verify_on_map(map_, leg, {.clearance = problem_.reach()}, request_.execution).verified;
  }

  /// The cells by whose middles a path may begin or end at p, the nearest first, one of those that steps join nearby: a
  /// point's own; a disc may fit where it stands and not at the middle of its cell, but at one of those around it.
  std::vector<Cell> cells_joined_to(Vec2 p, Cell own) const {
    if (problem_.reach() == 0.0 || (!blocked().test(own.x, own.y) && is_joined(p, own))) return {own};
    constexpr std::int64_t around = 2;
    constexpr std::size_t most = 3;  // each may cost a search
    std::vector<std::pair<double, Cell>> free;
    for (std::int64_t y = std::int64_t{own.y} - around; y <= std::int64_t{own.y} + around; ++y) {
      for (std::int64_t x = std::int64_t{own.x} - around; x <= std::int64_t{own.x} + around; ++x) {
        if (x < 0 || y < 0 || x >= map_.width() || y >= map_.height() || blocked().holds(x, y)) continue;
        const Cell cell{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
        if (is_joined(p, cell)) free.emplace_back(distance(p, cell_centre(map_, cell)), cell);
      }
    }
    std::stable_sort(free.begin(), free.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Cell> cells;
    const auto beside = [](Cell a, Cell b) {
      return (a.x == b.x || a.y == b.y) && a.x - b.x + 1 < 3 && a.y - b.y + 1 < 3;
    };
    for (const auto& candidate : free) {
      const Cell cell = candidate.second;
      const bool is_known = std::any_of(cells.begin(), cells.end(), [&](Cell known) { return beside(known, cell); });
      if (!is_known && cells.size() < most) cells.push_back(cell);
    }
    return cells;
  }

  void choose_method() {
    const StageTimer timer(request_.execution, "search", answer_.seconds.search);
    const bool asked = request_.options.search || grid_.diagonal == Diagonal::none;
    if (!asked && !has_diagonal_steps(blocked())) grid_.method = GridMethod::bfs;  // mazes: as short, and faster
    answer_.search = name_of(grid_.method);
  }

  void search(const std::vector<Cell>& starts, const std::vector<Cell>& goals) {
    const StageTimer timer(request_.execution, "search", answer_.seconds.search);
    GridSearch cells(blocked());
    for (const Cell start : starts) {
      for (const Cell goal : goals) {
        const GridPath path = cells.find(start, goal, grid_, request_.execution);
        answer_.counters.expanded += path.expanded;
        if (path.status == SearchStatus::found) return take(path);
      }
    }
  }

  void count(std::uint64_t cells, double cost) {
    answer_.cost = cost;
    answer_.path_figures.push_back({"cells", cells});
  }

  void take(const GridPath& path) {
    answer_.outcome = Outcome::solved;
    count(path.cells.size(), path.cost);
    answer_.path = path_over_cells(map_, problem_.start, path.cells, problem_.goal);
  }

  void prove() {
    const StageTimer timer(request_.execution, "proof", answer_.seconds.search);
    if (provably_apart(map_, closed_, problem_, request_.execution)) answer_.outcome = Outcome::infeasible;
  }

  /// Off the grid: motions between any two points, certified against the closed cells.
  void optimise() {
    const StageTimer timer(request_.execution, "optimise", answer_.seconds.optimise, answer_.path.size());
    OccupancyMap map = map_;
    map.blocked = closed_;
    const GridWorld world(map, problem_.reach(), request_.execution);
    answer_.raw_length = path_length(answer_.path, GridWorld::distance);
    answer_.path = shorter_path(WorldView(world), std::move(answer_.path), GridWorld::distance, {.seed = answer_.seed},
                                request_.execution, answer_.counters);
  }

  const SolveRequest& request_;
  const OccupancyMap& map_;
  WallProblem problem_;
  GridSearchOptions grid_;
  Bitmap closed_;   // to a point
  Bitmap blocked_;  // to a disc's middle; empty: the robot is a point
  Answer answer_;
};

Answer solve_over_cells(const SolveRequest& request) {
  CellSolve solve(request, map_problem(request.scene, request.question));
  answer_within_limits(solve.answer(), [&] { solve.run(); });
  return std::move(solve.answer());
}

/// For prm, lazy-prm, rrt and rrt-connect. Motions are certified against the closed squares of blocked cells, wherever
/// between them they lead.
class BodyOnMap : public UsualBody {
 public:
  using World = GridWorld;
  static void suit(RrtOptions& options) {
    if (!options.sampler) options.sampler = SamplerKind::uniform;
  }

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
  void index(std::optional<World>& world, SamplerKind sampler) const {
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
  bool provably_apart(const World& world, const std::vector<Vec2>&) const {
    return warren::provably_apart(world.map(), world.map().blocked, problem_, execution_);
  }
  bool start_stands_free() const { return stands_free_on_map(map_, problem_, problem_.start, execution_); }
  bool goal_stands_free(Vec2 goal) const {
    return starts_on_water(map_, problem_.start) || stands_free_on_map(map_, problem_, goal, execution_);
  }
  static double length(const World&, Vec2 a, Vec2 b) { return World::distance(a, b); }
  Path<Vec2> shortened(const World& world, Path<Vec2> path, Answer& answer) const {
    return shorter_path(WorldView(world), std::move(path), World::distance, {.seed = answer.seed}, execution_,
                        answer.counters);
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

NamedLines lines_of(const OccupancyMap& map, const std::vector<std::pair<Cell, Cell>>& steps) {
  NamedLines lines{"medial_axis", {}};
  for (const auto& [from, to] : steps) lines.lines.add(std::array{cell_centre(map, from), cell_centre(map, to)});
  return lines;
}

/// One solve by voronoi, as far from what is blocked as a path can be. min_clearance of the answer is measured on the
/// path by the verification.
class SkeletonSolve {
 public:
  SkeletonSolve(const SolveRequest& request, const WallProblem& problem)
      : request_(request), map_(*request.scene.map), problem_(problem) {
    const SearchChoice search = search_choice(request.options);
    options_.radius = problem.reach() / map_.cell;
    options_.objective = request.options.axis.objective.value_or(AxisObjective::length);
    options_.search = search.search;
    options_.queue = search.queue;
    describe_plane_planner(answer_, request, problem, search);
    answer_.options.push_back({"objective", std::string(name_of(options_.objective))});
  }

  void run() {
    const auto start = cell_at(map_, problem_.start);
    const auto goal = cell_at(map_, problem_.goal);
    answer_.outcome = settled_on_map(Outcome::start_blocked, map_, problem_, request_.execution);
    if (!goal && answer_.outcome != Outcome::start_blocked) answer_.outcome = Outcome::goal_blocked;
    if (is_blocked(answer_.outcome)) return;  // what lies outside of the map is
    std::vector<std::pair<Cell, Cell>> steps;
    auto* kept_steps = request_.keep != nullptr ? &steps : nullptr;
    const SkeletonRoadmap* known = asked_roadmap<SkeletonRoadmap>(request_);
    take(known != nullptr ? plan_on_skeleton(*known, *start, *goal, options_, request_.execution, kept_steps)
                          : plan_on_skeleton(closed_cells(map_, problem_.start), *start, *goal, options_,
                                             request_.execution, kept_steps));
    // The skeleton was asked about the middles of the cells.
    if (is_blocked(answer_.outcome)) answer_.outcome = Outcome::not_connected;
    if (problem_.start == problem_.goal) stay(answer_, problem_);
    if (request_.keep != nullptr) request_.keep->lines.push_back(lines_of(map_, steps));
    verify_solved_on_map(answer_, map_, problem_, true, request_.execution);
  }
  Answer& answer() { return answer_; }

 private:
  void take(const SkeletonPath& plan) {
    Solution<Vec2> solution;
    solution.outcome = plan.outcome;
    solution.separation = plan.separation;
    solution.roadmap = plan.roadmap;
    solution.counters.expanded = plan.expanded;
    solution.separation.nearest_gap *= map_.cell;
    for (std::array<double, 2>* place : {&solution.separation.near_start, &solution.separation.near_goal}) {
      const Vec2 in_world = world_point(map_, {(*place)[0], (*place)[1]});
      *place = {in_world.x, in_world.y};
    }
    solution.seconds = plan.seconds;
    if (plan.outcome == Outcome::solved) {
      solution.path = path_over_cells(map_, problem_.start, plan.cells, problem_.goal);
      answer_.path_figures.push_back({"cells", std::uint64_t{plan.cells.size()}});
      answer_.path_figures.push_back({"axis_clearance", plan.clearance * map_.cell});
    }
    take_solution(answer_, std::move(solution));
  }

  const SolveRequest& request_;
  const OccupancyMap& map_;
  WallProblem problem_;
  SkeletonOptions options_;
  Answer answer_;
};

constexpr PlannerChoice occupancy_planners[] = {
    {PlannerKind::grid, OptionSet{Option::search, Option::diagonal, Option::optimise}},
    {PlannerKind::prm, prm_takes | point_takes},
    {PlannerKind::lazy_prm, lazy_prm_takes | point_takes},
    {PlannerKind::rrt, rrt_options},
    {PlannerKind::rrt_connect, rrt_connect_options},
    {PlannerKind::rrt_star, rrt_star_options},
    {PlannerKind::informed_rrt_star, rrt_star_options},
    {PlannerKind::anytime, anytime_options},
    {PlannerKind::voronoi, OptionSet{Option::objective, Option::search, Option::queue, Option::bound}}};

bool fits_occupancy(const Scene& scene, const RobotSpec& robot) {
  return scene.map && (robot.kind == RobotKind::point || robot.kind == RobotKind::disc);
}

Answer solve_occupancy(const SolveRequest& request) {
  switch (request.planner) {
    case PlannerKind::grid:
      return solve_over_cells(request);
    case PlannerKind::voronoi:
      return solve_on_skeleton(request);
    default:
      return solve_sampled<BodyOnMap>(request);
  }
}

BuiltArrays build_occupancy(const SolveRequest& request) {
  return is_roadmap_planner(request.planner) ? build_sampled<BodyOnMap>(request) : build_geometric(request);
}

std::unique_ptr<RoadmapSession> open_occupancy(const SolveRequest& request, const RoadmapArrays& arrays,
                                               const ConnectionRule& rule) {
  const auto open = is_roadmap_planner(request.planner) ? open_sampled<BodyOnMap> : open_geometric;
  return open(request, arrays, rule);
}

Verdict recheck_occupancy(const Scene& scene, const Question& question, const RecordedAnswer& answer,
                          const Execution& execution) {
  check_state_width(answer, 2, "a point or disc");
  const WallProblem problem = map_problem(scene, question);
  return {verify_map_path(*scene.map, problem, answer.path, execution), problem.general()};
}

}  // namespace

Answer solve_on_skeleton(const SolveRequest& request) {
  SkeletonSolve solve(request, map_problem(request.scene, request.question));
  answer_within_limits(solve.answer(), [&] { solve.run(); });
  return std::move(solve.answer());
}

SolveKind occupancy_kind() {
  return {"a point or disc on an occupancy map",
          fits_occupancy,
          occupancy_planners,
          usually<PlannerKind::grid>,
          solve_occupancy,
          nullptr,
          recheck_occupancy,
          build_occupancy,
          open_occupancy};
}

}  // namespace warren
