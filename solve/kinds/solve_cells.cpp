// SPDX-License-Identifier: BSD-3-Clause
// The planner cells: vertical cells, a route through them, and a path through its doors. That there is no route proves
// that there is no path.
#include <array>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"
#include "planners/vertical_cells/cell_planner.hpp"
#include "solve/kinds/geometric_roadmaps.hpp"
#include "solve/kinds/plane_steps.hpp"
#include "solve/steps/solve_steps.hpp"

namespace warren {
CellOptions cell_options(const SolveOptions& asked, const SearchChoice& search) {
  const CellOptions options{
      .doors = asked.cells.doors.value_or(DoorKind::midpoint), .search = search.search, .queue = search.queue};
  if (options.doors == DoorKind::funnel && asked.queue) {
    throw UsageError("@queue: @doors funnel searches with a queue of its own; @doors midpoint takes others");
  }
  return options;
}

NamedFigure doors_option(const CellOptions& options) { return {"doors", std::string(name_of(options.doors))}; }

NamedLines doors_of(const CellDecomposition& cells) {
  NamedLines doors{"cells", {}};
  for (std::uint32_t door = 0; door < cells.doors.size(); ++door) {
    const Segment line = cells.door_line(door);
    doors.lines.add(std::array{line.a, line.b});
  }
  return doors;
}

Answer solve_by_cells(const SolveRequest& request) {
  const WallProblem problem = touching_problem(request);
  const SearchChoice search = search_choice(request.options);
  const CellOptions options = cell_options(request.options, search);
  Answer answer;
  describe_plane_planner(answer, request, problem, search);
  answer.options.push_back(doors_option(options));
  answer_within_limits(answer, [&] {
    const CellRoadmap* known = asked_roadmap<CellRoadmap>(request);
    PlaneObstacles obstacles;
    if (known == nullptr) obstacles = indexed_obstacles(request, answer);
    if (stand_on_seams(request, problem, answer)) return;
    CellPlan plan;
    Solution<Vec2> solution;
    without_clashes(request, [&] {
      const auto& [start, goal] = std::tie(problem.start, problem.goal);
      solution = known != nullptr ? plan_through_cells(*known, start, goal, options, request.execution)
                                  : plan_through_cells(obstacles, start, goal, options, request.execution, &plan);
    });
    take_solution(answer, std::move(solution));
    const CellDecomposition& cells = known != nullptr ? known->cells : plan.cells;
    answer.cells = CellCount{cells.cells.size(), cells.doors.size()};
    if (answer.outcome == Outcome::not_connected) answer.outcome = Outcome::infeasible;  // cells miss no way
    if (request.keep != nullptr) request.keep->lines.push_back(doors_of(cells));
    verify_solved(answer, request.scene, problem, request.execution, request.asked.judged());
  });
  return answer;
}

}  // namespace warren
