// SPDX-License-Identifier: BSD-3-Clause
// The planner `visibility`: the shortest path for a point among polygons and walls, contact allowed, by the visibility
// graph (planners/visibility/visibility_graph) or lazily (planners/visibility/lazy_visibility).
#pragma once

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "parallel/execution.hpp"
#include "planners/roadmap/planned_roadmap.hpp"
#include "planners/roadmap/roadmap_options.hpp"
#include "planners/visibility/visibility_graph.hpp"

namespace warren {

struct VisibilityOptions {
  VisibilityEdges edges = VisibilityEdges::reduced;
  bool lazy = false;                      ///< needs reduced edges and A* with the heap; InputError otherwise
  SearchKind search = SearchKind::astar;  ///< bfs: fewest edges, neighbours ascending; dfs: some path
  QueueKind queue = QueueKind::heap;

  void validate() const;
};

/// Plans from start to goal among the obstacles. start_blocked, goal_blocked: strictly inside of a polygon or outside
/// of the bounds (on a boundary is allowed). solved: with A* and Dijkstra the path is the shortest there is.
/// not_connected: no path exists. Never throws Stopped: a deadline or a memory limit gives Outcome::stopped.
/// `keep`, where given, receives the graph with start and goal (lazy: the edges that were found).
Solution<Vec2> visibility_path(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal, const VisibilityOptions& options,
                               const Execution& execution, PlannedRoadmap<Vec2>* keep = nullptr);

/// The same where, without bounds, the obstacles' box confines the point (planners/pieces/box_as_bounds.hpp).
Solution<Vec2> confined_visibility_path(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal,
                                        const VisibilityOptions& options, const Execution& execution,
                                        PlannedRoadmap<Vec2>* keep = nullptr);

/// What of such a confined plan depends on neither start nor goal. Immutable; any number of threads may plan on it.
struct VisibilityRoadmap {
  /// Throw as VisibilityGraph's; `known`: its graph.
  VisibilityRoadmap(const PlaneObstacles& obstacles, VisibilityEdges edges, const Execution& execution);
  VisibilityRoadmap(const PlaneObstacles& obstacles, VisibilityEdges edges, Graph known, const Execution& execution);
  VisibilityRoadmap(const VisibilityRoadmap&) = delete;
  VisibilityRoadmap& operator=(const VisibilityRoadmap&) = delete;

  const Box box;
  const VisibleCorners corners;
  const VisibilityGraph graph;  ///< refers to the corners
};

/// The same plan on a graph that is there already. Of the options `edges` is the roadmap's; it is not lazy.
Solution<Vec2> visibility_path(const VisibilityRoadmap& roadmap, Vec2 start, Vec2 goal,
                               const VisibilityOptions& options, const Execution& execution,
                               PlannedRoadmap<Vec2>* keep = nullptr);

}  // namespace warren
