// SPDX-License-Identifier: BSD-3-Clause
// From cells to walls and back: the borders between blocked and free cells as segments, the longest that there are, and
// the cells that walls and polygons touch.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// In world coordinates, horizontal ones first, row by row; what lies outside of the map is blocked. A point that does
/// not touch them stays among free cells, or among blocked ones. O(cells / 64 + segments). Throws
/// Stopped.
std::vector<Segment> border_walls(const OccupancyMap& map, const Execution& execution);

/// Gives a scene that is a map its border walls, for planners and pictures of walls; does nothing to other scenes.
void add_map_walls(Scene& scene, const Execution& execution);

/// The scene as cells of a given side from the lower corner of its bounds, or of its obstacles' box: a cell is blocked
/// if its closed square touches a wall or a polygon (its inside too). Throws InputError for cells beside 0 or more than
/// 2^32 of them, and for scenes without extent; Stopped.
OccupancyMap map_of_scene(const Scene& scene, double cell, const Execution& execution);

}  // namespace warren
