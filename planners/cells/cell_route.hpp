// SPDX-License-Identifier: BSD-3-Clause
// A way through vertical cells, door by door, and the paths that follow it: through the doors' middles, or the shortest
// one.
//
// The shortest path is a string pulled taut through the doors (funnel algorithm: Chazelle 1982; Lee, Preparata 1984).
// Of each door only its corner counts: the segment at the other end begins and ends at corners that the route passes as
// well, or that lie behind its ends, and a string that keeps to those keeps to the segment. So the string bends at
// corners of the input alone and every decision is an exact orientation. Where the route turns back (two doors below
// and above one corner in a row) the string is tied to that corner, and between such corners the route runs from left
// to right or from right to left, which is all the funnel needs. O(doors).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/path.hpp"
#include "core/base/types.hpp"
#include "planners/cells/cell_decomposition.hpp"
#include "planners/cells/door_points.hpp"

namespace warren {

/// cells[i] and cells[i + 1] share the open door doors[i]; start lies in the first cell, goal in the last.
struct CellRoute {
  Vec2 start, goal;
  std::vector<std::uint32_t> cells;
  std::vector<std::uint32_t> doors;
};

/// Through the middles of the doors, of which each two in a row belong to one cell; start and goal included.
Path<Vec2> path_through_middles(Vec2 start, Vec2 goal, std::span<const std::uint32_t> doors, const DoorPoints& points);

/// The shortest path through the doors; bends at corners of the obstacles only.
Path<Vec2> shortest_path_through(const CellRoute& route, const CellDecomposition& cells);

}  // namespace warren
