// SPDX-License-Identifier: BSD-3-Clause
// All obstacles of a scene against all legs of a path. The obstacles are streamed past a screen
// (verify/near/path_screen) that drops those surely too far away to matter; what it leaves is compared with the legs
// near it (verify/near/leg_index, verify/judges/leg_reports). Where no obstacle comes within some leg lengths of
// the path the screen is of no use: then the legs are searched by their boxes.
#pragma once

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/judges/leg_reports.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/near/leg_boxes.hpp"
#include "verify/near/obstacle_index.hpp"
#include "verify/near/obstacle_sides.hpp"

namespace warren {

/// The tally of all walls and of the sides of polygons and bounds; its box is that of walls and polygons. The same for
/// any number of threads.
Tally compare_obstacles(const Scene& scene, const Obstacles& obstacles, const LegBoxes& legs,
                        const VerifyOptions& options, const Execution& execution);

// The legs of a path against the obstacles of an index, leg after leg: for scenes that are asked again and again. Of
// the blocks of obstacles those are left out that lie farther from the leg than the least distance so far, by their
// boxes and by the leg's line; the first leg begins with some obstacles near it, so that there is such a distance. Legs
// that follow each other are near each other: the blocks near eight of them are looked for once, unless they are many.
// What is left out is no matter of order (verify/exact/exact_segments.hpp, distance), so the tally is that of
// compare_obstacles, which passes over the whole scene.

/// The tally of all walls and sides; its box is that of walls and polygons. The same for any number of threads.
Tally compare_indexed(const ObstacleIndex& index, const LegBoxes& legs, const VerifyOptions& options,
                      const Execution& execution);

}  // namespace warren
