// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/map_steps.hpp"

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "planners/grid/grid_search.hpp"
#include "scenes/files/moving_ai_io.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "spatial/maps/distance_field.hpp"
#include "verify/judges/verify_map.hpp"

namespace warren {

WallProblem map_problem(const Scene& scene, const Question& options) {
  if (options.contact == Contact::allowed) {
    throw UsageError("@contact: a blocked cell is a closed square, which no path on a map touches");
  }
  return wall_problem(scene, options);
}

Bitmap closed_cells(const OccupancyMap& map, Vec2 start) {
  const auto cell = cell_at(map, start);
  return cell ? blocked_from(map, *cell) : map.blocked;
}

bool stands_free_on_map(const OccupancyMap& map, const WallProblem& problem, Vec2 p, const Execution& execution) {
  const double room = problem.reach() + end_margin(problem.reach(), map.cell);
  return verify_on_map(map, std::span(&p, 1), {.clearance = room}, execution).verified;
}

bool starts_on_water(const OccupancyMap& map, Vec2 start) {
  const auto cell = cell_at(map, start);
  return cell && !map.water.empty() && map.water.test(cell->x, cell->y);
}

Outcome settled_on_map(Outcome outcome, const OccupancyMap& map, const WallProblem& problem,
                       const Execution& execution) {
  return settled_ends(
      outcome, [&] { return stands_free_on_map(map, problem, problem.start, execution); },
      [&] { return starts_on_water(map, problem.start) || stands_free_on_map(map, problem, problem.goal, execution); });
}

bool provably_apart(const OccupancyMap& map, const Bitmap& closed, const WallProblem& problem,
                    const Execution& execution) {
  const auto start = cell_at(map, problem.start);
  const auto goal = cell_at(map, problem.goal);
  if (!start || !goal) return false;
  if (problem.reach() == 0.0) return !cells_connect(closed, *start, *goal, false, execution);
  constexpr double half_diagonal = 0.7071067811865476 + 1e-9;
  const double radius = problem.reach() / map.cell - half_diagonal;
  return !cells_connect(blocked_for_disc(closed, radius, execution), *start, *goal, true, execution);
}

bool provably_apart(const OccupancyMap& map, const RobotSpec& robot, const Se2& start, const Se2& goal,
                    const Execution& execution) {
  if (robot.outline.empty()) {
    const WallProblem disc{.robot = robot, .start = start.position(), .goal = goal.position()};
    return provably_apart(map, map.blocked, disc, execution);
  }
  const auto from = cell_at(map, placed(start, robot.outline.front()));
  const auto to = cell_at(map, placed(goal, robot.outline.front()));
  return from && to && !cells_connect(map.blocked, *from, *to, false, execution);
}

bool is_joined(const OccupancyMap& map, double reach, Vec2 p, Cell cell, const Execution& execution) {
  const Vec2 leg[] = {p, cell_centre(map, cell)};
  return verify_on_map(map, leg, {.clearance = reach}, execution).verified;
}

std::vector<Cell> cells_joined_to(const OccupancyMap& map, const Bitmap& wide, double reach, Vec2 p, Cell own,
                                  const Execution& execution) {
  if (reach == 0.0 || (!wide.test(own.x, own.y) && is_joined(map, reach, p, own, execution))) return {own};
  constexpr std::int64_t around = 2;
  constexpr std::size_t most = 3;  // each may cost a search
  std::vector<std::pair<double, Cell>> free;
  for (std::int64_t y = std::int64_t{own.y} - around; y <= std::int64_t{own.y} + around; ++y) {
    for (std::int64_t x = std::int64_t{own.x} - around; x <= std::int64_t{own.x} + around; ++x) {
      if (x < 0 || y < 0 || x >= map.width() || y >= map.height() || wide.holds(x, y)) continue;
      const Cell cell{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
      if (is_joined(map, reach, p, cell, execution)) free.emplace_back(distance(p, cell_centre(map, cell)), cell);
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

Path<Vec2> path_over_cells(const OccupancyMap& map, Vec2 start, std::span<const Cell> cells, Vec2 goal) {
  Path<Vec2> path{start};
  const auto step = [&](std::size_t i) {
    return std::pair{std::int64_t{cells[i].x} - cells[i - 1].x, std::int64_t{cells[i].y} - cells[i - 1].y};
  };
  const auto append = [&](Vec2 p) {
    if (!(p == path.back())) path.push_back(p);
  };
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool is_inside = i > 0 && i + 1 < cells.size();
    if (!is_inside || step(i) != step(i + 1)) append(cell_centre(map, cells[i]));
  }
  append(goal);
  return path;
}

Verification verify_map_path(const OccupancyMap& map, const WallProblem& problem, std::span<const Vec2> path,
                             const Execution& execution) {
  const VerifyOptions options{
      .radius = problem.robot.radius, .clearance = problem.clearance, .start = problem.start, .goal = problem.goal};
  return verify_on_map(map, path, options, execution);
}

void verify_solved_on_map(Answer& answer, const OccupancyMap& map, const WallProblem& problem, bool over_cells,
                          const Execution& execution) {
  if (answer.outcome != Outcome::solved) return;
  const StageTimer timer(execution, "verify", answer.seconds.verify, answer.path.size());
  const Verification verification = verify_map_path(map, problem, answer.path, execution);
  if (!verification.verified) {
    const Violation violation = verification.first_violation.value_or(Violation{});
    const bool at_an_end = violation.leg == 0 || violation.leg + 2 == answer.path.size();
    // What only rounding keeps off a cell that it touches is blocked.
    answer.outcome = settled_on_map(Outcome::start_blocked, map, problem, execution);
    const bool may_miss = over_cells && problem.reach() > 0.0 && at_an_end;
    if (answer.outcome == Outcome::not_connected && !may_miss) fail_verification(answer, violation);
    answer.path.clear();
    return;
  }
  take_verdict(answer, verification);
}

}  // namespace warren
