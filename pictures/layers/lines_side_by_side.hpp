// SPDX-License-Identifier: BSD-3-Clause
// Paths that share parts, drawn so that none hides another: where several run along the same legs they take turns in
// dashes, elsewhere each is a line.
#pragma once

#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "parallel/execution.hpp"

namespace warren {

/// For each path the chains that show it; all of them together cover every path. Legs are the same if their ends are,
/// in either direction. dash > 0: about how long a dash is, world units. O(legs · log + dashes). Throws Stopped.
std::vector<PolygonSet> lines_side_by_side(std::span<const std::vector<Vec2>> paths, double dash,
                                           const Execution& execution);

}  // namespace warren
