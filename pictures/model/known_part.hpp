// SPDX-License-Identifier: BSD-3-Clause
// The part of a map that a picture shows: a map server's image often reaches far beyond what its robot has seen.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"

namespace warren {

/// The box, in the world, of all cells that are not unknown, with a fortieth of its longer side around them, two cells
/// at least. Nothing where it would leave out less than a tenth of the map's width and of its height, or where all is
/// unknown. O(cells / 64). Throws Stopped.
std::optional<Box> known_part(const OccupancyMap& map, const Execution& execution);

/// What lies in the box of an outline that is convex (Sutherland and Hodgman, 1974), in the same order; fewer than
/// three points where nothing does.
std::vector<Vec2> part_in_box(std::span<const Vec2> outline, const Box& box);

}  // namespace warren
