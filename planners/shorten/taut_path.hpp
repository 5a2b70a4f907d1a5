// SPDX-License-Identifier: BSD-3-Clause
// The shortest path with the clearance in the homotopy class of a given one: the string of
// planners/shorten/taut_path, its arcs replaced by tangents from outside, checked leg by leg.
//
// Tolerance: tangents stand 0.16 radians apart, so an arc becomes at most 0.22 % longer (closer tangents only where a
// wall on the other side needs the room). Clearance 0, where touching is blocked and no shortest path exists, is
// replaced by a millionth of the walls' spacing, or as much of it as the given path itself keeps.
// Measured in bench/taut_bench.cpp, with random shortcutting beside it.
#pragma once

#include <span>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren {

/// path: free with this clearance (as keeps_clearance answers), at least one point. The result has the same ends, is
/// free in the same sense, is never longer than the path, and stays in its box. Throws Stopped at the deadline.
/// The same for any number of threads.
Path<Vec2> taut_path(const WallIndex& walls, std::span<const Vec2> path, double clearance, const Execution& execution);

}  // namespace warren
