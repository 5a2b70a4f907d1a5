// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/plane_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "planners/grid/grid_search.hpp"
#include "planners/vertical_cells/cell_decomposition.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "spatial/maps/distance_field.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
namespace {

std::string obstacle_text(const Scene& scene, std::size_t number) {
  if (number == ObstacleClash::bounds) return "the bounds";
  if (number >= scene.polygons.size()) return fmt::format("wall {}", number - scene.polygons.size());
  const std::size_t line = scene.polygons[number].line;
  return line > 0 ? fmt::format("the polygon of line {}", line) : fmt::format("polygon {}", number);
}

/// Of the planner visibility, where it plans for what keeps a distance.
void refuse_points_options(const SolveOptions& options) {
  const bool other_search = options.search && *options.search != SearchMethod::astar;
  const std::string_view option = options.visibility.full            ? "full"
                                  : options.visibility.sampled_edges ? "sampled_edges"
                                  : options.visibility.lazy          ? "lazy"
                                  : options.queue                    ? "queue"
                                  : other_search                     ? "search"
                                                                     : "";
  if (option.empty()) return;
  throw UsageError(fmt::format(
      "@{}: visibility would ignore it for a disc or a clearance, whose tangents it draws as A* needs them", option));
}

}  // namespace

WallProblem touching_problem(const SolveRequest& request) {
  const std::string_view planner = name_of(request.planner);
  if (request.scene.map) {
    throw UsageError(fmt::format(
        "@planner: paths of {} may touch what is blocked, but a map's blocked cells are closed; take grid, prm or "
        "lazy-prm",
        planner));
  }
  const WallProblem problem = wall_problem(request.scene, request.question, Contact::allowed);
  if (problem.reach() > 0.0) {
    if (request.planner == PlannerKind::visibility) return refuse_points_options(request.options), problem;
    throw UsageError(
        fmt::format("@planner: {} plans for a point, which may touch obstacles; a disc or a clearance of {} needs "
                    "visibility, prm, lazy-prm or voronoi, or @clearance 0 and @robot point",
                    planner, problem.reach()));
  }
  if (problem.contact == Contact::blocked) {
    throw UsageError(
        fmt::format("@contact: paths of {} may touch obstacles; prm, lazy-prm and voronoi keep off them", planner));
  }
  return problem;
}

std::size_t corner_count(const Scene& scene) {
  constexpr std::size_t weight_of_point = 25;  // a wall without length is seen from everywhere
  std::size_t corners = 2 * scene.walls.size();
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Segment wall = scene.walls.segment(i);
    if (wall.a == wall.b) corners += weight_of_point;
  }
  for (const ScenePolygon& polygon : scene.polygons) corners += polygon.corners.size();
  return corners;
}

void describe_plane_planner(Answer& answer, const SolveRequest& request, const WallProblem& problem,
                            const SearchChoice& search) {
  answer.problem = problem.general();
  answer.planner = name_of(request.planner);
  answer.search = name_of(search.search);
  answer.seed = request.options.seed;
  if (request.options.queue) answer.options.push_back({"queue", std::string(name_of(*request.options.queue))});
}

void stay(Answer& answer, const WallProblem& problem) {
  answer.outcome = Outcome::solved;
  answer.path = {problem.start, problem.goal};
  answer.path_figures.clear();
}

void without_clashes(const SolveRequest& request, const std::function<void()>& plan) {
  try {
    plan();
  } catch (const ObstacleClash& clash) {
    const Scene& scene = request.scene;
    const bool polygon = clash.obstacle() < scene.polygons.size();
    throw InputError(
        polygon ? place_of_polygon(scene, clash.obstacle()) : scene.source,
        fmt::format("{} takes obstacles that lie apart or touch, but {} and {} cross or overlap; prm, lazy-prm and "
                    "visibility take them",
                    name_of(request.planner), obstacle_text(scene, clash.obstacle()),
                    obstacle_text(scene, clash.other())));
  }
}

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

std::vector<Cell> cells_joined_to(const OccupancyMap& map, const Bitmap& wide, double reach, Vec2 p,
                                  const Execution& execution) {
  const auto own = cell_at(map, p);
  if (!own) return {};
  if (reach == 0.0 || (!wide.test(own->x, own->y) && is_joined(map, reach, p, *own, execution))) return {*own};
  constexpr std::int64_t around = 2;
  constexpr std::size_t most = 3;  // each may cost a search
  std::vector<std::pair<double, Cell>> free;
  for (std::int64_t y = std::int64_t{own->y} - around; y <= std::int64_t{own->y} + around; ++y) {
    for (std::int64_t x = std::int64_t{own->x} - around; x <= std::int64_t{own->x} + around; ++x) {
      if (x < 0 || y < 0 || x >= map.width() || y >= map.height() || wide.holds(x, y)) continue;
      const Cell cell{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
      if (is_joined(map, reach, p, cell, execution)) free.emplace_back(distance(p, cell_centre(map, cell)), cell);
    }
  }
  std::ranges::stable_sort(free, [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Cell> cells;
  const auto beside = [](Cell a, Cell b) {
    return (a.x == b.x || a.y == b.y) && a.x - b.x + 1 < 3 && a.y - b.y + 1 < 3;
  };
  for (const auto& candidate : free) {
    const Cell cell = candidate.second;
    const bool is_known = std::ranges::any_of(cells, [&](Cell known) { return beside(known, cell); });
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

}  // namespace warren
