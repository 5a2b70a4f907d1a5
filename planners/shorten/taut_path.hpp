// SPDX-License-Identifier: BSD-3-Clause
// The shortest path with the clearance in the homotopy class of a given one: a taut string, its arcs replaced by
// tangents from outside, checked leg by leg.
//
// Tolerance: tangents stand 0.16 radians apart, so an arc becomes at most 0.22 % longer (closer tangents only where a
// wall on the other side needs the room). Clearance 0, where touching is blocked and no shortest path exists, is
// replaced by a millionth of the walls' spacing, or as much of it as the given path itself keeps.
// Measured in bench/taut_bench.cpp, with random shortcutting beside it.
#pragma once

#include <functional>
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

// Pulls a path of the plane taut where a way costs more than its length: vertices are left out, moved, and put in, each
// wherever the exact cost of the legs falls and the legs are free by the caller's check. Descent, so the path never
// gets dearer and stays in its homotopy class as far as short moves do; it is no proof of anything. One thread, no
// chance: the same bytes everywhere.

/// What the legs of a path cost, and which may be.
struct PricedLegs {
  std::function<double(Vec2, Vec2)> cost;   ///< of a straight leg, at least its length
  std::function<bool(Vec2, Vec2)> is_free;  ///< may the leg be?
  double step = 1.0;                        ///< the first move of a vertex, about a cell; the last is a 64th of it
};

/// The path, no dearer, its ends the same. Ends where two turns save less than a ten-thousandth. Throws Stopped.
Path<Vec2> priced_taut(Path<Vec2> path, const PricedLegs& legs, const Execution& execution);

}  // namespace warren
