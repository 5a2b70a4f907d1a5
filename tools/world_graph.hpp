// SPDX-License-Identifier: BSD-3-Clause
// The graph of a world, for searches to be compared on: what a planner of `solve` would search, with its options.
#pragma once

#include <string>
#include <string_view>

#include "core/solution.hpp"
#include "parallel/execution.hpp"
#include "tools/arguments.hpp"
#include "tools/search_graph.hpp"
#include "worlds/scene.hpp"

namespace warren {

/// Names of the planners whose graphs can be searched, blank-separated; the first that fits a world is the usual one.
inline constexpr std::string_view graph_planners = "prm";

/// The one that is taken for this world where none is asked for.
std::string usual_graph_planner(const Scene& scene);

struct WorldGraph {
  SearchGraph graph;                  ///< empty unless built
  Outcome outcome = Outcome::solved;  ///< start_blocked, goal_blocked: there is no graph to search
};

/// Builds it. `arguments`: those of a `solve` with --planner. Throws UsageError as `solve` does, Stopped.
WorldGraph world_graph(const Scene& scene, const Arguments& arguments, const Execution& execution);

}  // namespace warren
