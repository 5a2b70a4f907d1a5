// SPDX-License-Identifier: BSD-3-Clause
// All obstacles of a scene against all legs of a path. The obstacles are streamed past a screen
// (verify/near/path_screen) that drops those surely too far away to matter; what it leaves is compared with the legs
// near it (verify/near/leg_index, verify/judges/leg_against_side). Where no obstacle comes within some leg lengths of
// the path the screen is of no use: then the legs are searched by their boxes.
#pragma once

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/judges/leg_against_side.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/near/leg_boxes.hpp"
#include "verify/near/obstacle_sides.hpp"

namespace warren {

/// The tally of all walls and of the sides of polygons and bounds; its box is that of walls and polygons. The same for
/// any number of threads.
Tally compare_obstacles(const Scene& scene, const Obstacles& obstacles, const LegBoxes& legs,
                        const VerifyOptions& options, const Execution& execution);

}  // namespace warren
