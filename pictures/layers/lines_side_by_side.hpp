// SPDX-License-Identifier: BSD-3-Clause
// Paths that share parts, drawn so that none hides another: where several run along the same stretch they take turns in
// dashes, elsewhere each is a line.
#pragma once

#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// For each path the chains that show it; all of them together cover every path. Stretches are shared in either
/// direction, wherever the paths' corners are; all lies on a raster of 2^-14 of the paths' extent, so what is nearer
/// than that is the same. dash > 0: about how long a dash is, world units. O(legs · log + dashes) where legs are short
/// or run along the axes; a long slanted one is held against the corners in its columns or rows. Throws Stopped.
std::vector<PolygonSet> lines_side_by_side(std::span<const std::vector<Vec2>> paths, double dash,
                                           const Execution& execution);

}  // namespace warren
