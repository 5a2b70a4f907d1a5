// SPDX-License-Identifier: BSD-3-Clause
// Plans a point's path through vertical cells (planners/vertical_cells/cell_decomposition.hpp): decomposes, searches
// for a route, and lays a path through its doors.
//
// Breadth- and depth-first search run over the cells: fewest cells, and some cells. Dijkstra and A* run over the doors'
// middles: the shortest of all paths that pass doors in their middles, hence never longer than what the other two find
// with DoorKind::midpoint. With DoorKind::funnel the route is chosen in the same way and the path is the shortest one
// through that route's cells; another route may have a shorter one. Paths may touch obstacles.
// Time: the decomposition's, and O(cells log cells) for the search.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/enum_names.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/vertical_cells/cell_decomposition.hpp"

namespace warren {

/// Points at which a path passes the doors of vertical cells: the middles, as close as doubles come to them. A door has
/// one end in the input (its corner) and one that would have to be computed. The middle is rounded, asked exactly
/// whether it still lies between the two, and replaced by the corner where it does not (doors of a few units in the
/// last place): the corner belongs to both cells, so legs between the points of a cell never leave it, whatever the
/// rounding. Such a path may touch the corner. Immutable; refers to the cells.
class DoorPoints {
 public:
  /// O(doors), on all threads.
  DoorPoints(const CellDecomposition& cells, const Execution& execution);

  /// Of a door.
  Vec2 middle(std::uint32_t door) const { return middles_[door]; }
  /// Where the leg between the middles of two doors of one cell should bend: doors below and above one corner are
  /// joined around it, a little inside the cell. None: the leg is straight, or there is no room.
  std::optional<Vec2> bend(std::uint32_t from, std::uint32_t to) const;
  /// Length of that leg.
  double leg_length(std::uint32_t from, std::uint32_t to) const;

 private:
  Vec2 middle_of(std::uint32_t door) const;

  const CellDecomposition& cells_;
  std::vector<Vec2> middles_;
};

/// A way through vertical cells: cells[i] and cells[i + 1] share the open door doors[i]; start lies in the first cell,
/// goal in the last.
struct CellRoute {
  Vec2 start;                        ///< in the first cell
  Vec2 goal;                         ///< in the last one
  std::vector<std::uint32_t> cells;  ///< one after the other
  std::vector<std::uint32_t> doors;  ///< one fewer
};

/// Where a path passes from cell to cell: in the middle of the door, or where the shortest one does.
enum class DoorKind : std::uint8_t { midpoint, funnel };
constexpr auto enum_names(DoorKind) { return std::array<std::string_view, 2>{"midpoint", "funnel"}; }

/// How cells are made and searched.
struct CellOptions {
  DoorKind doors = DoorKind::midpoint;    ///< where they are passed
  SearchKind search = SearchKind::astar;  ///< over the doors
  QueueKind queue = QueueKind::heap;      ///< of astar and dijkstra
  Overlaps overlaps = Overlaps::refused;  ///< as decompose() takes them
};

/// What a plan leaves to be drawn or counted.
struct CellPlan {
  CellDecomposition cells;  ///< all of them
  CellRoute route;          ///< empty unless solved
};

/// Plans from start to goal for a point that may touch obstacles. Outcomes: solved; start_blocked and goal_blocked
/// (strictly inside a polygon, or outside the bounds; without bounds, the obstacles' box); not_connected, which here
/// means that there is no path, since the decomposition is exact (where polygons are united, but for the rounding);
/// stopped. In the solution `roadmap` counts cells, doors and components of cells, `separation` the cells that start
/// and goal can reach. Throws ObstacleClash where obstacles cross or overlap. `keep`, where given, receives cells and
/// route. The same for any number of threads.
Solution<Vec2> plan_through_cells(const PlaneObstacles& obstacles, Vec2 start, Vec2 goal, const CellOptions& options,
                                  const Execution& execution, CellPlan* keep = nullptr);

/// What of a plan depends on neither start nor goal. Immutable; any number of threads may plan on it.
struct CellRoadmap : NotCopied {
  /// Throws as decompose().
  CellRoadmap(PlaneObstacles plane, const Execution& execution);

  const PlaneObstacles obstacles;  ///< that the cells lie between
  const CellDecomposition cells;   ///< all of them
  const DoorPoints points;         ///< refers to the cells
};

/// The same plan on cells that are there already; they were not united. There are obstacles or bounds.
Solution<Vec2> plan_through_cells(const CellRoadmap& roadmap, Vec2 start, Vec2 goal, const CellOptions& options,
                                  const Execution& execution);

}  // namespace warren
