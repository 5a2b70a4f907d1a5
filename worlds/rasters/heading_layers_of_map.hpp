// SPDX-License-Identifier: BSD-3-Clause
// The layers of a turning body on an occupancy map: states stand at the middles of the map's cells, blocked cells are
// closed squares, and what lies outside of the map is blocked. Which cells around a position touch the body there (or
// what it sweeps on a step or a turn) is the same everywhere: a stamp, found once a layer by the exact sum of body and
// square. The layer is the blocked cells widened by the stamp, 64 cells at a time: each of the stamp's rows is an
// interval or a few, and an interval of any length is two shifted copies of a doubled row. O(layers * stamp rows *
// cells / 64), whatever the map holds; layers in parallel.
#pragma once

#include <span>

#include "core/plane/heading_layers.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"

namespace warren {

/// outline: three corners or more around the reference point, world units; clearance: room around the body, >= 0; 0:
/// touching is blocked. Positions and headings are the map's own: as if its origin were (0, 0) and it were not turned.
/// Throws InputError for more than HeadingLayers::most_states, no heading, and a body that reaches over 4096 cells;
/// Stopped.
HeadingLayers map_layers(const OccupancyMap& map, std::span<const Vec2> outline, std::uint32_t angles, double clearance,
                         const Execution& execution);

}  // namespace warren
