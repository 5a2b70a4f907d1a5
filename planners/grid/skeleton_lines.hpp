// SPDX-License-Identifier: BSD-3-Clause
// The skeleton of a map without a question (planners/grid/map_skeleton.hpp, ends stay), as a graph of straight lines:
// vertices are the cells where it forks, ends or turns. Steps of lines are those of planners/grid/skeleton_planner, to
// the side and across corners beside which both cells are free, so that a disc that fits at the middles of cells fits
// all along. A ring without a fork begins at its first cell. O(cells) beside the thinning.
#pragma once

#include <vector>

#include "core/base/bitmap.hpp"
#include "core/search/graph.hpp"
#include "planners/grid/skeleton_planner.hpp"

namespace warren {

struct SkeletonLines {
  std::vector<Cell> cells;  ///< row by row
  std::vector<Edge> edges;  ///< ascending, each once, from < to; straight, or at half a right angle
};

/// Throws Stopped.
SkeletonLines skeleton_lines(const SkeletonRoadmap& roadmap, const Execution& execution);

}  // namespace warren
