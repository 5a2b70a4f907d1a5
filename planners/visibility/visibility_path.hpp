// SPDX-License-Identifier: BSD-3-Clause
// The planner `visibility`: the shortest path for a point among polygons and walls, contact allowed, by the visibility
// graph (planners/visibility/visibility_graph) or lazily.
#pragma once

#include <optional>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/graph/roadmap_options.hpp"
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

/// The same where, without bounds, the obstacles' box confines the point (see confined()).
Solution<Vec2> confined_visibility_path(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal,
                                        const VisibilityOptions& options, const Execution& execution,
                                        PlannedRoadmap<Vec2>* keep = nullptr);

/// What of such a confined plan depends on neither start nor goal. Immutable; any number of threads may plan on it.
struct VisibilityRoadmap : NotCopied {
  /// Throws as VisibilityGraph; `known`: its graph, where that is there already.
  VisibilityRoadmap(const PlaneObstacles& obstacles, VisibilityEdges edges, const Execution& execution,
                    std::optional<Graph> known = {});

  const Box box;  ///< that confines the point; empty: none does
  const VisibleCorners corners;
  const VisibilityGraph graph;  ///< refers to the corners
};

/// The same plan on a graph that is there already. Of the options `edges` is the roadmap's; it is not lazy.
Solution<Vec2> visibility_path(const VisibilityRoadmap& roadmap, Vec2 start, Vec2 goal,
                               const VisibilityOptions& options, const Execution& execution,
                               PlannedRoadmap<Vec2>* keep = nullptr);

/// The shortest path among polygons and walls without building the visibility graph: A* over the reduced graph, whose
/// rows are found when a vertex is settled, and of which only those edges are looked for that a taut way can take: at
/// each vertex the range of directions between straight on and the obstacle round which the way bends. Any optimal way
/// through a vertex is taut at it whichever optimal way led there, so the path is as short as the graph's. One look a
/// vertex settled, each over what can be seen in that range; memory 150 bytes a corner. Start and goal are not blocked,
/// and different; start is vertex corners.size(), goal the next. Looks (neighbour_queries) and what they found
/// (edges_checked) are added to the counters; `found`, where given, receives the edges. Throws Stopped, or says in the
/// result that it was stopped.
SearchResult lazy_visibility_search(const VisibleCorners& corners, Vec2 start, Vec2 goal, const Execution& execution,
                                    Counters& counters, std::vector<Edge>* found = nullptr);

/// Worlds without bounds, whose obstacles' box confines the reference point and is no wall: paths may run along
/// polygons on it and around walls that end on it, and shortest paths don't leave it by themselves. But nobody gets
/// between the box and a wall that lies on its side: a maze's outline shall not be walked around on the outside. For
/// planners of shortest paths, which know bounds only: behind each wall on a side of the box stands a polygon that
/// reaches to bounds well outside of the box; without such walls, or with bounds, nothing is changed.
PlaneObstacles confined(PlaneObstacles obstacles);

}  // namespace warren
