// SPDX-License-Identifier: BSD-3-Clause
// The skeleton of a map, and plans along it: it leads from the start's cell to the goal's
// as far from what is blocked as it can. By length: the shortest way over the skeleton. By clearance: of the ways whose
// narrowest cell is as far from what is blocked as possible the shortest. Steps are those of the grid planner: to the
// side, and across a corner only where both cells beside it are free (Moving AI's rule), so that a body which fits at
// the middles of cells fits all along the path. Clearances are exact: whole numbers of squared half cells.
// The transform and the thinning are O(cells); the search is over the skeleton's cells alone.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/solution.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "planners/axis/medial_axis_planner.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "spatial/maps/distance_field.hpp"

namespace warren {

/// What becomes of ends of lines that nobody has asked to keep. go: all dead ends are gone. stay: where from the end
/// the distance grows by less than half a cell a cell in every direction, over the next cell and over the next three.
/// So lines stay that lead to the ends of corridors, and those go that lead into the corners of rooms (0.71 a cell)
/// and behind the bumps of walls.
enum class SkeletonEnds : std::uint8_t { go, stay };

/// The skeleton of a map's free cells: a network one cell thin, as far from what is blocked as it can be, by thinning
/// in the order of the distance transform. The nearest cell to what is blocked that can go without changing the
/// topology goes first: the free cells stay as connected as they were over common sides, and no loop around blocked
/// cells closes or opens (a simple point of the 4-connected plane: Kong, Rosenfeld, Computer Vision 48, 1989; the
/// order: Pudney, Computer Vision and Image Understanding 72, 1998). Cells that shall be kept stay, so the skeleton
/// joins them wherever the map does. What remains: the kept cells, a loop around each island of blocked cells, and what
/// joins these; dead ends are gone. O(cells log distances) time, serial; 9 bits a cell and 4 bytes a cell that waits.
///
/// blocked: set bits; the outside is blocked too. field: of what keeps its distance, the same size; its order counts,
/// and where ends stay its slope. kept: free cells that stay. Set bits of the result are the skeleton. Throws Stopped.
Bitmap map_skeleton(const Bitmap& blocked, const DistanceField& field, std::span<const Cell> kept,
                    const Execution& execution, SkeletonEnds ends = SkeletonEnds::go);

struct SkeletonOptions {
  AxisObjective objective = AxisObjective::length;
  SearchKind search = SearchKind::astar;  ///< breadth- and depth-first count steps
  QueueKind queue = QueueKind::heap;
};

/// Solved, start_blocked, goal_blocked or not_connected. Path: cells, each a step from the one before; roadmap: the
/// skeleton's cells, steps, components; separation: in cells.
struct SkeletonPath : Solution<Cell> {
  double clearance = 0.0;  ///< least distance of the path's middles from what is blocked, in cells
};

/// What of a plan depends on neither start nor goal: the skeleton itself does. Any number of threads may plan on it.
struct SkeletonRoadmap {
  /// map: what is blocked to a point, as what lies outside is; radius of a disc, in cells, >= 0. Throws Stopped.
  SkeletonRoadmap(const Bitmap& map, double radius, const Execution& execution);

  Bitmap blocked;       ///< to the disc
  DistanceField field;  ///< from what is blocked to a point
};

/// `steps`, where given, receives the skeleton's steps, for pictures. Throws Stopped.
SkeletonPath plan_on_skeleton(const SkeletonRoadmap& roadmap, Cell start, Cell goal, const SkeletonOptions& options,
                              const Execution& execution, std::vector<std::pair<Cell, Cell>>* steps = nullptr);

/// The skeleton of a map without a question (ends stay), as a graph of straight lines:
/// vertices are the cells where it forks, ends or turns. A ring without a fork begins at its first cell.
struct SkeletonLines {
  std::vector<Cell> cells;  ///< row by row
  std::vector<Edge> edges;  ///< ascending, each once, from < to; straight, or at half a right angle
};

/// O(cells) beside the thinning. Throws Stopped.
SkeletonLines skeleton_lines(const SkeletonRoadmap& roadmap, const Execution& execution);

}  // namespace warren
