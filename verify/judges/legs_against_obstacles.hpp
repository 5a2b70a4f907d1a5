// SPDX-License-Identifier: BSD-3-Clause
// Obstacles against the legs of a path: by a pass over all of them, or by an index of those that are asked about again
// and again. Both are one loop. Segments in their order (obstacles in the one case, legs in the other) meet many that
// lie in blocks of boxes (verify/near/leg_boxes, verify/near/obstacle_index); blocks are left out that lie farther away
// than the least distance so far, by their boxes and by the segment's line. Segments that follow each other are near
// each other: the blocks near 64 of them are looked for once, and each eight choose among those, unless they are many.
//
// The pass drops most obstacles before that by a screen (verify/near/path_screen), whose cells are as wide as what some
// obstacles say of the least distance. By the index the first leg begins with some sides near it.
//
// What is left out is no matter of order (verify/exact/exact_segments.hpp, distance), so both tallies are the same
// bits.
//
// What each part earns: a verification on one thread with it, and without it. The screen: 12 and 133 ms along the
// lattice of a maze of 1500 x 1500 cells (2.2 million walls, 150,000 legs), 61 and 139 by samples anywhere in it, 43
// and 52 among 100,000 polygons. Looking for several at once: 61 and 98 ms in that maze; by an index 0.13 and 0.75 ms
// for 1000 legs of it, 0.13 and 0.21 without the 64. The segment's line: 0.27 and 0.87 s where 300 legs cross 300,000
// walls.
#pragma once

#include "core/run/execution.hpp"
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

/// The tally of all walls and sides; its box is that of walls and polygons. The same for any number of threads.
Tally compare_indexed(const ObstacleIndex& index, const LegBoxes& legs, const VerifyOptions& options,
                      const Execution& execution);

}  // namespace warren
