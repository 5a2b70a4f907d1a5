// SPDX-License-Identifier: BSD-3-Clause
#include "studies/contests/graph_of_world.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/base/error.hpp"
#include "pictures/layers/roadmap_in_the_plane.hpp"
#include "scenes/scene/unit_of.hpp"
#include "solve/steps/kind_of_problem.hpp"
#include "studies/compare/comparison.hpp"

namespace warren::studies {
namespace {

/// The roadmap that the planner leaves.
WorldGraph roadmap_graph(SolveRequest request, const ChosenSolver& solver) {
  ByProducts made_too;
  request.keep = &made_too;
  const Answer answer = solver.kind->solve(request);
  if (answer.outcome == Outcome::stopped) throw Stopped{answer.stop_reason.value_or(StopReason::time)};
  WorldGraph made;
  made.outcome = answer.outcome;
  const bool has_trees = !made_too.trees.empty();
  const PlannedRoadmap<Vec2> roadmap =
      has_trees ? in_the_plane(made_too.trees, request.execution) : std::move(made_too.roadmap);
  if (roadmap.states.empty()) {
    if (answer.outcome != Outcome::solved) return made;
    throw UsageError(fmt::format("@graph: {} leaves no graph to search", name_of(solver.planner)));
  }
  made.graph.options = json_options(answer.options);
  std::erase_if(made.graph.options, [](const auto& option) { return option.first == "pipeline"; });
  made.graph.at.assign(roadmap.states.begin(), roadmap.states.end());
  made.graph.graph = with_plane_lengths(roadmap.graph, made.graph.at);
  made.graph.start = static_cast<VertexId>(made.graph.at.size() - 2);
  made.graph.goal = static_cast<VertexId>(made.graph.at.size() - 1);
  return made;
}

}  // namespace

PlannerKind usual_graph_planner(const Scene& scene, const Question& question, const SolveOptions& options) {
  const PlannerKind usual = choose_solver(options, scene, question).planner;
  return usual == PlannerKind::lazy_prm ? PlannerKind::prm : usual;
}

WorldGraph world_graph(const Scene& scene, const Question& question, const SolveOptions& options,
                       const Execution& execution) {
  const RobotKind robot = robot_of(scene, question).kind;
  if (robot != RobotKind::point && robot != RobotKind::disc) {
    throw UsageError(
        fmt::format("{}: searches are compared on graphs in the plane, and a {} has states of its own; "
                    "@planners compares its planners",
                    scene.source, name_of(robot)));
  }
  const ChosenSolver solver = choose_solver(options, scene, question);
  WorldGraph made = roadmap_graph({options, scene, question, solver.planner, execution}, solver);
  made.graph.source = scene.source;
  made.graph.kind = name_of(solver.planner);
  made.graph.unit = unit_of(scene);
  return made;
}

}  // namespace warren::studies
