// SPDX-License-Identifier: BSD-3-Clause
// The route through vertical cells whose taut path is the shortest of all: best first over what can be seen through the
// doors (Polyanya: Cui, Harabor, Grastien, IJCAI 2017, here on trapezoids and with exact decisions).
//
// A node stands in a door, sees it from a root (start, or a corner that the path bends at) between two rays through
// corners, and knows the length of the way to the root. Passing the next door narrows the rays by that door's corner,
// or bends at a corner that was just passed: what lies behind it is seen from there. As in
// planners/vertical_cells/cell_planner.hpp the other ends of doors don't matter, and where the way turns back under a
// corner it bends there. Whether rays leave anything is an exact orientation; only the order of the search, by length
// so far and least length to the goal, is rounded: the route is the best but for routes as short within rounding. A
// corner is a root again only if it is reached by no longer a way. Nodes are made as they are met and are no vertices
// of a graph, so the loop isn't core's best_first. Time: O(nodes log nodes), usually few nodes a cell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "planners/vertical_cells/cell_decomposition.hpp"

namespace warren {

struct TautRoute {
  /// From the start's to the goal's; cells[i] and cells[i + 1] share doors[i]. Empty: none was found.
  std::vector<std::uint32_t> cells;
  std::vector<std::uint32_t> doors;
  std::uint64_t expanded = 0;  ///< nodes
};

/// `ends`: where start and goal lie, in this order. informed: A*, else Dijkstra's order. Throws
/// Stopped at the deadline.
TautRoute shortest_taut_route(const CellDecomposition& cells, std::span<const CellPlace> ends, Vec2 start, Vec2 goal,
                              bool informed, const Execution& execution);

}  // namespace warren
