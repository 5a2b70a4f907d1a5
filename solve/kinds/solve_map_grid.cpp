// SPDX-License-Identifier: BSD-3-Clause
// The planner grid on an occupancy map: over its cells. What it does not find it may prove infeasible.
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "planners/grid/grid_search.hpp"
#include "planners/shorten/shortcut.hpp"
#include "solve/kinds/map_steps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/question/grid_choice.hpp"
#include "solve/steps/solve_steps.hpp"
#include "spatial/maps/distance_field.hpp"
#include "verify/judges/verify_map.hpp"
#include "worlds/plane/grid_world.hpp"

namespace warren {
namespace {

/// One solve: the steps share the question and fill in the answer.
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
    answer_.path = shortcut_path(world, std::move(answer_.path), GridWorld::distance, {.seed = answer_.seed},
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

}  // namespace

Answer solve_by_cells_of_map(const SolveRequest& request) {
  CellSolve solve(request, map_problem(request.scene, request.question));
  answer_within_limits(solve.answer(), [&] { solve.run(); });
  return std::move(solve.answer());
}

}  // namespace warren
