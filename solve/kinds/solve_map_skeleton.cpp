// SPDX-License-Identifier: BSD-3-Clause
// The planner voronoi on an occupancy map: along the skeleton of its free cells, as far from what is blocked as a path
// can be. min_clearance of the answer is measured on the path by the verification.
#include <array>
#include <optional>

#include "planners/grid/skeleton_planner.hpp"
#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/map_steps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/steps/solve_steps.hpp"

namespace warren {
namespace {

NamedLines lines_of(const OccupancyMap& map, const std::vector<std::pair<Cell, Cell>>& steps) {
  NamedLines lines{"medial_axis", {}};
  for (const auto& [from, to] : steps) lines.lines.add(std::array{cell_centre(map, from), cell_centre(map, to)});
  return lines;
}

/// One solve: the steps share the question and fill in the answer.
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

}  // namespace

Answer solve_on_skeleton(const SolveRequest& request) {
  SkeletonSolve solve(request, map_problem(request.scene, request.question));
  answer_within_limits(solve.answer(), [&] { solve.run(); });
  return std::move(solve.answer());
}

}  // namespace warren
