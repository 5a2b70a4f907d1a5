// SPDX-License-Identifier: BSD-3-Clause
// The graph of a world, for searches to be compared on: what a planner of `solve` would search, with its options.
#pragma once

#include "core/base/solution.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"
#include "studies/searches/search_graph.hpp"

namespace warren::studies {

/// The planner whose graph is searched where none is asked for: the one that `solve` would take, prm for lazy-prm.
/// Throws UsageError where no planner solves this world.
PlannerKind usual_graph_planner(const Scene& scene, const Question& question, const SolveOptions& options);

struct WorldGraph {
  SearchGraph graph;                  ///< empty unless built
  Outcome outcome = Outcome::solved;  ///< start_blocked, goal_blocked: there is no graph to search
};

/// Solves with the planner and takes the graph that it leaves. Throws UsageError as `solve` does and for planners that
/// leave none, Stopped.
WorldGraph world_graph(const Scene& scene, const Question& question, const SolveOptions& options,
                       const Execution& execution);

}  // namespace warren::studies
