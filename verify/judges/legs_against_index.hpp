// SPDX-License-Identifier: BSD-3-Clause
// The legs of a path against the obstacles of an index, leg after leg: for scenes that are asked again and again. Of
// the blocks of obstacles those are left out that lie farther from the leg than the least distance so far, by their
// boxes and by the leg's line; the first leg begins with some obstacles near it, so that there is such a distance. Legs
// that follow each other are near each other: the blocks near eight of them are looked for once, unless they are many.
// What is left out is no matter of order (verify/exact/exact_segments.hpp, distance), so the tally is that of
// compare_obstacles, which passes over the whole scene.
#pragma once

#include "parallel/execution.hpp"
#include "verify/judges/leg_against_side.hpp"
#include "verify/judges/verify_point.hpp"
#include "verify/near/leg_boxes.hpp"
#include "verify/near/obstacle_index.hpp"

namespace warren {

/// The tally of all walls and sides; its box is that of walls and polygons. The same for any number of threads.
Tally compare_indexed(const ObstacleIndex& index, const LegBoxes& legs, const VerifyOptions& options,
                      const Execution& execution);

}  // namespace warren
