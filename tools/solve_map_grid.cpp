// SPDX-License-Identifier: BSD-3-Clause
// The planner grid on an occupancy map: over its cells. What it does not find it may prove infeasible.
#include <optional>

#include "core/error.hpp"
#include "planners/grid_search.hpp"
#include "planners/shortcut.hpp"
#include "spatial/distance_field.hpp"
#include "tools/answer_json.hpp"
#include "tools/grid_options.hpp"
#include "tools/map_planners.hpp"
#include "tools/verified_answer.hpp"
#include "worlds/grid_world.hpp"

namespace warren {
namespace {

/// One solve: the steps share the question and fill in the answer.
class CellSolve {
 public:
  CellSolve(const SolveRequest& request, const WallProblem& problem)
      : request_(request), map_(*request.scene.map), problem_(problem) {
    grid_.diagonal = diagonal_option(request.arguments);
    grid_.method = method_option(request.arguments,
                                 grid_.diagonal == Diagonal::sqrt2 ? GridMethod::jump_points : GridMethod::astar);
    if (grid_.method == GridMethod::jump_points && grid_.diagonal != Diagonal::sqrt2) {
      throw UsageError("--search: jump points need --diagonal sqrt2");
    }
    answer_.problem = problem.general();
    answer_.planner = name_of(PlannerKind::grid);
    answer_.seed = seed_of(request.arguments);
    if (request.arguments.has("--optimise")) answer_.options.emplace_back("optimise", "true");
    if (request.arguments.has("--diagonal")) {
      answer_.options.emplace_back("diagonal", json_string(name_of(grid_.diagonal)));
    }
  }

  void run() {
    const auto start = cell_at(map_, problem_.start);
    const auto goal = cell_at(map_, problem_.goal);
    answer_.outcome = blocked_end(start, goal);
    if (answer_.outcome != Outcome::not_connected) return;
    index();
    search(*start, *goal);
    if (answer_.outcome != Outcome::solved) return prove(*start, *goal);
    if (request_.arguments.has("--optimise")) optimise();
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

  void search(Cell start, Cell goal) {
    const StageTimer timer(request_.execution, "search", answer_.seconds.search);
    const bool asked = request_.arguments.has("--search") || grid_.diagonal == Diagonal::none;
    if (!asked && !has_diagonal_steps(blocked())) grid_.method = GridMethod::bfs;  // mazes: as short, and faster
    answer_.search = name_of(grid_.method);
    GridPath path = GridSearch(blocked()).find(start, goal, grid_, request_.execution);
    answer_.counters.expanded = path.expanded;
    if (path.status != SearchStatus::found) return;
    answer_.outcome = Outcome::solved;
    answer_.cost = path.cost;
    answer_.figures.emplace_back("cells", std::to_string(path.cells.size()));
    answer_.path = path_over_cells(map_, problem_.start, path.cells, problem_.goal);
  }

  /// A point between closed cells goes where cells with a common side are free. A disc's middle is nowhere where the
  /// middle of the cell is nearer than the radius less half a diagonal; all other cells are given it, corners too.
  void prove(Cell start, Cell goal) {
    const StageTimer timer(request_.execution, "proof", answer_.seconds.search);
    const double radius = problem_.reach() / map_.cell;
    constexpr double half_diagonal = 0.7071067811865476 + 1e-9;
    const bool joined = problem_.reach() == 0.0
                            ? cells_connect(closed_, start, goal, false, request_.execution)
                            : cells_connect(blocked_for_disc(closed_, radius - half_diagonal, request_.execution),
                                            start, goal, true, request_.execution);
    if (!joined) answer_.outcome = Outcome::infeasible;
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
  CellSolve solve(request, map_problem(request.scene, request.problem));
  answer_within_limits(solve.answer(), [&] { solve.run(); });
  return std::move(solve.answer());
}

}  // namespace warren
