// SPDX-License-Identifier: BSD-3-Clause
// The planner cells: vertical cells, a route through them, and a path through its doors. That there is no route proves
// that there is no path.
#include <array>

#include "planners/cell_planner.hpp"
#include "tools/answer_json.hpp"
#include "tools/option_values.hpp"
#include "tools/plane_planners.hpp"
#include "tools/verified_answer.hpp"

namespace warren {
namespace {

constexpr std::array<std::string_view, 2> door_words{"midpoint", "funnel"};

CellOptions options_of(const SolveRequest& request, const SearchChoice& search) {
  CellOptions options{.doors = DoorKind::midpoint, .search = search.search, .queue = search.queue};
  if (const auto doors = request.arguments.value("--doors")) {
    options.doors = static_cast<DoorKind>(choice_value("--doors", *doors, door_words));
  }
  return options;
}

/// The doors, which are the borders between cells; floors and ceilings are obstacles anyway.
void draw(const CellPlan& plan, Drawing& drawing) {
  PictureLayer layer{"cells", colors::layer, widths::edge, {}};
  for (std::uint32_t door = 0; door < plan.cells.doors.size(); ++door) {
    const Segment line = plan.cells.door_line(door);
    layer.lines.add(std::array{line.a, line.b});
  }
  drawing.layers.push_back(std::move(layer));
}

}  // namespace

Answer solve_by_cells(const SolveRequest& request) {
  const WallProblem problem = touching_problem(request);
  const SearchChoice search = search_choice(request.arguments);
  const CellOptions options = options_of(request, search);
  Answer answer;
  describe_plane_planner(answer, request, problem, search);
  answer.options.emplace_back("doors", json_string(door_words[static_cast<std::size_t>(options.doors)]));
  answer_within_limits(answer, [&] {
    const PlaneObstacles obstacles = indexed_obstacles(request, answer);
    CellPlan plan;
    take_solution(answer, plan_without_clashes(request, [&] {
                    return plan_through_cells(obstacles, problem.start, problem.goal, options, request.execution,
                                              &plan);
                  }));
    answer.cells = CellCount{plan.cells.cells.size(), plan.cells.doors.size()};
    if (answer.outcome == Outcome::not_connected) answer.outcome = Outcome::infeasible;  // cells miss no way
    if (request.drawing != nullptr) draw(plan, *request.drawing);
    verify_solved(answer, request.scene, problem, request.execution);
  });
  return answer;
}

}  // namespace warren
