// SPDX-License-Identifier: BSD-3-Clause
// Is this path free on a map? Each leg is compared with the closed square of every blocked cell near it, in cells; what
// lies outside of the map is blocked. Independent of what found it: nothing from spatial/ or planners/, orientations
// and distances by verify/exact/exact_segments, borders as the cells say and not as walls.
#pragma once

#include <span>

#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {

/// A point or disc; with a reach of 0 it touches no blocked square; contact can't be allowed. A leg costs the cells
/// within its clearance, and those within the least distance met so far. Water is free to a path that begins on water
/// and blocked to all others. At least one point, all finite (InputError otherwise). The same for any number of
/// threads; throws Stopped.
Verification verify_on_map(const OccupancyMap& map, std::span<const Vec2> path, const VerifyOptions& options,
                           const Execution& execution);

}  // namespace warren
