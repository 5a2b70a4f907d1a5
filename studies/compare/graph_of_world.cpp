// SPDX-License-Identifier: BSD-3-Clause
#include "studies/compare/graph_of_world.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "solve/question/kind_of_problem.hpp"
#include "solve/question/planner_choice.hpp"
#include "solve/question/question.hpp"

namespace warren {
namespace {

/// The roadmap that the planner leaves for a picture.
WorldGraph roadmap_graph(const SolveRequest& request, const ChosenSolver& solver) {
  Drawing drawing;
  SolveRequest with_drawing = request;
  with_drawing.drawing = &drawing;
  const Answer answer = solver.kind->solve(with_drawing);
  if (answer.outcome == Outcome::stopped) throw Stopped{answer.stop_reason.value_or(StopReason::time)};
  WorldGraph made;
  made.outcome = answer.outcome;
  if (drawing.roadmap.states.empty()) {
    if (answer.outcome != Outcome::solved) return made;
    throw UsageError(fmt::format("--graph: {} leaves no graph to search", name_of(solver.planner)));
  }
  made.graph.options = answer.options;
  std::erase_if(made.graph.options, [](const auto& option) { return option.first == "pipeline"; });
  made.graph.at.assign(drawing.roadmap.states.begin(), drawing.roadmap.states.end());
  made.graph.graph = with_plane_lengths(drawing.roadmap.graph, made.graph.at);
  made.graph.start = static_cast<VertexId>(made.graph.at.size() - 2);
  made.graph.goal = static_cast<VertexId>(made.graph.at.size() - 1);
  return made;
}

}  // namespace

std::string usual_graph_planner(const Scene& scene, const Arguments& arguments) {
  const ChosenSolver solver = choose_solver(arguments, scene, problem_options(arguments));
  return std::string{name_of(solver.planner == PlannerKind::lazy_prm ? PlannerKind::prm : solver.planner)};
}

WorldGraph world_graph(const Scene& scene, const Arguments& arguments, const Execution& execution) {
  const ProblemOptions problem = problem_options(arguments);
  const RobotKind robot = robot_of(scene, problem).kind;
  if (robot != RobotKind::point && robot != RobotKind::disc) {
    throw UsageError(
        fmt::format("{}: searches are compared on graphs in the plane, and a {} has states of its own; "
                    "--planners compares its planners",
                    scene.source, kind_name(robot)));
  }
  const ChosenSolver solver = choose_solver(arguments, scene, problem);
  WorldGraph made = roadmap_graph({arguments, scene, problem, solver.planner, execution}, solver);
  made.graph.source = scene.source;
  made.graph.kind = name_of(solver.planner);
  return made;
}

}  // namespace warren
