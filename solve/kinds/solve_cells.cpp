// SPDX-License-Identifier: BSD-3-Clause
// The planner cells: vertical cells, a route through them, and a path through its doors. That there is no route proves
// that there is no path.
#include <array>

#include "core/base/error.hpp"
#include "planners/cells/cell_planner.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/question/solve_steps.hpp"
#include "solve/question/write_answer_io.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

constexpr std::array<std::string_view, 2> door_words{"midpoint", "funnel"};

}  // namespace

CellOptions cell_options(const Arguments& arguments, const SearchChoice& search) {
  CellOptions options{.doors = DoorKind::midpoint, .search = search.search, .queue = search.queue};
  if (const auto doors = arguments.value("--doors")) {
    options.doors = static_cast<DoorKind>(choice_value("--doors", *doors, door_words));
  }
  if (options.doors == DoorKind::funnel && arguments.has("--queue")) {
    throw UsageError("--queue: --doors funnel searches with a queue of its own; --doors midpoint takes others");
  }
  return options;
}

std::pair<std::string, std::string> doors_option(const CellOptions& options) {
  return {"doors", json_string(door_words[static_cast<std::size_t>(options.doors)])};
}

PictureLayer doors_of(const CellDecomposition& cells) {
  PictureLayer layer{"cells", colors::layer, widths::edge, {}};
  for (std::uint32_t door = 0; door < cells.doors.size(); ++door) {
    const Segment line = cells.door_line(door);
    layer.lines.add(std::array{line.a, line.b});
  }
  return layer;
}

Answer solve_by_cells(const SolveRequest& request) {
  const WallProblem problem = touching_problem(request);
  const SearchChoice search = search_choice(request.arguments);
  const CellOptions options = cell_options(request.arguments, search);
  Answer answer;
  describe_plane_planner(answer, request, problem, search);
  answer.options.push_back(doors_option(options));
  answer_within_limits(answer, [&] {
    const PlaneObstacles obstacles = indexed_obstacles(request, answer);
    if (stand_on_seams(request, problem, answer)) return;
    CellPlan plan;
    take_solution(answer, plan_without_clashes(request, [&] {
                    return plan_through_cells(obstacles, problem.start, problem.goal, options, request.execution,
                                              &plan);
                  }));
    answer.cells = CellCount{plan.cells.cells.size(), plan.cells.doors.size()};
    if (answer.outcome == Outcome::not_connected) answer.outcome = Outcome::infeasible;  // cells miss no way
    if (request.drawing != nullptr) request.drawing->layers.push_back(doors_of(plan.cells));
    verify_solved(answer, request.scene, problem, request.execution);
  });
  return answer;
}

}  // namespace warren
