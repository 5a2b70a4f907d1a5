// SPDX-License-Identifier: BSD-3-Clause
// A point or disc on an occupancy map: the grid planner over its cells. The other planners take a map too, by its
// border walls (tools/solve_walls).
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "core/error.hpp"
#include "planners/grid_search.hpp"
#include "planners/shortcut.hpp"
#include "spatial/distance_field.hpp"
#include "tools/answer_json.hpp"
#include "tools/grid_options.hpp"
#include "tools/option_values.hpp"
#include "tools/solve_kind.hpp"
#include "tools/verified_answer.hpp"
#include "worlds/grid_world.hpp"
#include "worlds/moving_ai_io.hpp"
#include "worlds/verify_map.hpp"

namespace warren {
namespace {

constexpr PlannerChoice planners[] = {{PlannerKind::grid, "--search --diagonal --optimise"}};

bool fits_occupancy(const Scene& scene, const RobotSpec& robot) {
  return scene.map && (robot.kind == RobotKind::point || robot.kind == RobotKind::disc);
}

PlannerKind usual_planner(const Arguments&, const Scene&, const ProblemOptions&) { return PlannerKind::grid; }

WallProblem problem_of(const Scene& scene, const ProblemOptions& options) {
  if (options.contact == Contact::allowed) {
    throw UsageError("--contact: a blocked cell is a closed square, which no path on a map touches");
  }
  return wall_problem(scene, options);
}

Verification verified(const OccupancyMap& map, const WallProblem& problem, std::span<const Vec2> path,
                      const Execution& execution) {
  return verify_on_map(map, path, {.clearance = problem.reach(), .start = problem.start, .goal = problem.goal},
                       execution);
}

/// One solve: the steps share the question and fill in the answer.
class OccupancySolve {
 public:
  OccupancySolve(const SolveRequest& request, const WallProblem& problem)
      : request_(request), map_(*request.scene.map), problem_(problem) {
    grid_.diagonal = diagonal_option(request.arguments);
    grid_.method = method_option(request.arguments,
                                 grid_.diagonal == Diagonal::sqrt2 ? GridMethod::jump_points : GridMethod::astar);
    if (grid_.method == GridMethod::jump_points && grid_.diagonal != Diagonal::sqrt2) {
      throw UsageError("--search: jump points need --diagonal sqrt2");
    }
    answer_.problem = problem.general();
    answer_.planner = name_of(PlannerKind::grid);
    if (const auto text = request.arguments.value("--seed")) {
      answer_.seed = count_value("--seed", *text, 0, std::numeric_limits<std::uint64_t>::max());
    }
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
    index(*start);
    search(*start, *goal);
    if (answer_.outcome != Outcome::solved) return prove(*start, *goal);
    if (request_.arguments.has("--optimise")) optimise(*start);
    verify();
  }
  Answer& answer() { return answer_; }

 private:
  bool stands_free(Vec2 p) const {
    return verify_on_map(map_, std::span(&p, 1), {.clearance = problem_.reach()}, request_.execution).verified;
  }
  Outcome blocked_end(const std::optional<Cell>& start, const std::optional<Cell>& goal) const {
    if (!start || !stands_free(problem_.start)) return Outcome::start_blocked;
    const bool on_water = !map_.water.empty() && map_.water.test(start->x, start->y);
    if (!goal || (!on_water && !stands_free(problem_.goal))) return Outcome::goal_blocked;
    return Outcome::not_connected;
  }

  void index(Cell start) {
    const StageTimer timer(request_.execution, "index", answer_.seconds.index, map_.blocked.size());
    closed_ = blocked_from(map_, start);
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
    answer_.path = whole_path(path.cells);
  }

  /// From the start over the cells where the path turns to the goal.
  std::vector<Vec2> whole_path(const std::vector<Cell>& cells) const {
    std::vector<Vec2> path{problem_.start};
    const auto step = [&](std::size_t i) {
      return std::pair{std::int64_t{cells[i].x} - cells[i - 1].x, std::int64_t{cells[i].y} - cells[i - 1].y};
    };
    const auto append = [&](Vec2 p) {
      if (!(p == path.back())) path.push_back(p);
    };
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool is_inside = i > 0 && i + 1 < cells.size();
      if (!is_inside || step(i) != step(i + 1)) append(cell_centre(map_, cells[i]));
    }
    append(problem_.goal);
    return path;
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
  void optimise(Cell start) {
    const StageTimer timer(request_.execution, "optimise", answer_.seconds.optimise, answer_.path.size());
    OccupancyMap map = map_;
    map.blocked = blocked_from(map_, start);
    const GridWorld world(map, problem_.reach(), request_.execution);
    answer_.raw_length = path_length(answer_.path, GridWorld::distance);
    answer_.path = shortcut_path(world, std::move(answer_.path), GridWorld::distance, {.seed = answer_.seed},
                                 request_.execution, answer_.counters);
  }

  void verify() {
    const StageTimer timer(request_.execution, "verify", answer_.seconds.verify, answer_.path.size());
    const Verification verification = verified(map_, problem_, answer_.path, request_.execution);
    if (!verification.verified) {
      // Cells are free at their middles; a disc may not get from a start beside the middle to it.
      const std::size_t leg = verification.first_violation.value_or(Violation{}).leg;
      if (problem_.reach() == 0.0 || (leg != 0 && leg + 2 != answer_.path.size())) {
        throw std::logic_error(fmt::format("the path of grid fails its verification at leg {}", leg));
      }
      answer_.outcome = Outcome::not_connected;
      answer_.path.clear();
      return;
    }
    answer_.verified = true;
    answer_.length = verification.length;
    answer_.min_clearance = verification.min_clearance - problem_.robot.radius;
  }

  const SolveRequest& request_;
  const OccupancyMap& map_;
  WallProblem problem_;
  GridSearchOptions grid_;
  Bitmap closed_;   // to a point
  Bitmap blocked_;  // to a disc's middle; empty: the robot is a point
  Answer answer_;
};

Answer solve(const SolveRequest& request) {
  OccupancySolve solve(request, problem_of(request.scene, request.problem));
  answer_within_limits(solve.answer(), [&] { solve.run(); });
  return std::move(solve.answer());
}

Verdict verify(const Scene& scene, const ProblemOptions& options, const RecordedAnswer& answer,
               const Execution& execution) {
  check_state_width(answer, 2, "a point or disc");
  const WallProblem problem = problem_of(scene, options);
  Verdict verdict{verified(*scene.map, problem, answer.path, execution), problem.general()};
  verdict.verification.min_clearance -= problem.robot.radius;
  return verdict;
}

}  // namespace

SolveKind occupancy_kind() {
  return {"a point or disc on an occupancy map",
          fits_occupancy,
          planners,
          grid_option_specs(),
          usual_planner,
          solve,
          nullptr,
          verify};
}

}  // namespace warren
