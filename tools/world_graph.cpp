// SPDX-License-Identifier: BSD-3-Clause
#include "tools/world_graph.hpp"

#include "planners/prm.hpp"
#include "tools/planner_options.hpp"
#include "tools/problem.hpp"
#include "tools/solve_kind.hpp"
#include "worlds/maze_world.hpp"

namespace warren {
namespace {

/// The roadmap of prm's last round.
WorldGraph prm_graph(const Scene& scene, const Arguments& arguments, const Execution& execution) {
  const WallProblem problem = wall_problem(scene, problem_options(arguments));
  const PlannerOptions options = planner_options(arguments, scene, problem);
  const MazeWorld world(scene, problem.reach(), execution);
  Roadmap<Vec2> roadmap;
  const Solution<Vec2> solution = prm(world, problem.start, problem.goal, options.roadmap, execution, &roadmap);
  if (solution.outcome == Outcome::stopped) throw Stopped{solution.stop_reason};
  WorldGraph made;
  made.outcome = solution.outcome;
  if (roadmap.states.empty()) return made;
  made.graph.at.assign(roadmap.states.begin(), roadmap.states.end());
  made.graph.graph = with_plane_lengths(roadmap.graph, made.graph.at);
  made.graph.start = static_cast<VertexId>(made.graph.at.size() - 2);
  made.graph.goal = static_cast<VertexId>(made.graph.at.size() - 1);
  return made;
}

}  // namespace

std::string usual_graph_planner(const Scene&) { return "prm"; }

WorldGraph world_graph(const Scene& scene, const Arguments& arguments, const Execution& execution) {
  const ChosenSolver solver = choose_solver(arguments, scene, problem_options(arguments));
  WorldGraph made = prm_graph(scene, arguments, execution);
  made.graph.source = scene.source;
  made.graph.kind = name_of(solver.planner);
  return made;
}

}  // namespace warren
