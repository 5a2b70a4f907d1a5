// SPDX-License-Identifier: BSD-3-Clause
// Cuts a simple polygon into convex ones: ears are clipped (every decision by the exact orientation), then triangles
// are joined across diagonals wherever the union stays convex (Hertel, Mehlhorn 1983: at most four times the fewest
// pieces). A convex polygon stays whole. O(n^2) time for n corners, more only where few corners are ears.
#pragma once

#include <span>
#include <vector>

#include "core/base/types.hpp"

namespace warren {

/// polygon: simple, three or more corners, either orientation. The pieces run counter-clockwise, their corners are the
/// polygon's (those on straight sides may be left out), their interiors are disjoint and their union is the polygon.
std::vector<std::vector<Vec2>> convex_pieces(std::span<const Vec2> polygon);

}  // namespace warren
