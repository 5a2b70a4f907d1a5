// SPDX-License-Identifier: BSD-3-Clause
// Does a leg keep a clearance beyond doubt of rounding? Yes if it does in doubles with 1e-12 to spare, or if the leg's
// and the wall's boxes are apart by just as much on one axis, which is decided exactly: what runs in the middle of a
// gap along an axis keeps half the gap's width, not a unit in the last place less.
#pragma once

#include "core/base/types.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren {

/// r > 0: false where the leg comes nearer than r to a wall, or where rounding leaves that open. r = 0: does the leg
/// touch no wall? Exact.
bool certainly_keeps_clearance(const WallIndex& walls, const Segment& leg, double r) noexcept;

}  // namespace warren
