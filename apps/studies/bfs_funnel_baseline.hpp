// SPDX-License-Identifier: BSD-3-Clause
// The honest bar beside any record: what somebody does who knows that the walls are a maze. Reads the cells back from
// the walls, walks them breadth first, and pulls the string through the corridor's open sides (the funnel of Lee and
// Preparata 1984, in Mononen's form). Gives the shortest path of a point that may touch wall ends; in a maze with loops
// the shortest within the corridor that the breadth-first search took. O(walls + cells) time; beside the walls 1 byte a
// cell, 1 a step and 16 a bend.
#pragma once

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::studies {

/// From the maze's start (0.5, 1) to its goal (cols + 0.5, rows); empty if cells don't connect them. The scene has the
/// maze hint. Throws InputError if a wall is off the unit grid, Stopped at the deadline.
Path<Vec2> bfs_funnel(const Scene& scene, const Execution& execution);

}  // namespace warren::studies
