// SPDX-License-Identifier: BSD-3-Clause
// Where a convex body that doesn't turn would meet a convex obstacle, marked on a coarse grid of places: the rows of
// the Minkowski sum of the obstacle and the mirrored body, whose sides are taken in the order of their directions as
// they are merged. O(n + m + rows) for n and m corners, nothing is allocated. A guide, not a proof: doubles as they
// come.
#pragma once

#include <span>

#include "core/base/place_grid.hpp"
#include "core/base/types.hpp"

namespace warren {

/// Takes the bits of places away at which the body comes nearer to the obstacle than `reach` (>= 0), by the larger of
/// the distances in x and y, and maybe of a few more. Both run counter-clockwise, with one corner or more.
void take_blocked_places(std::span<const Vec2> obstacle, std::span<const Vec2> mirrored_body, double reach,
                         PlaceGrid& free);

}  // namespace warren
