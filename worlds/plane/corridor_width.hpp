// SPDX-License-Identifier: BSD-3-Clause
// How wide the free ways between walls are, by looking from the middles of some walls to either side; and how many
// uniform samples ways of that width need. What `--samples auto` begins with: a guess that need not be right.
#pragma once

#include <cstddef>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "spatial/obstacles/polygon_index.hpp"
#include "spatial/obstacles/wall_index.hpp"

namespace warren {

/// 4.5 samples for each square as wide as what the clearance leaves of `width`.
double samples_for_width(double width, double area, double clearance);

/// What so many walls in such a box are worth, however long the box is: what a square as broad as the box would need,
/// since a long world of few walls is no harder than the same one pushed together, or some samples for each wall, since
/// a long corridor may have a cell for each.
double most_samples_for(const Box& box, double width, double clearance, std::size_t walls);

/// The lower quartile of the free widths on both sides of some walls, but for sides inside of polygons (nullptr: there
/// are none); the side of a square of the box's area where no other wall is seen. Throws Stopped: a look among crowded
/// walls takes long.
double typical_width(const WallIndex& index, const Box& box, const PolygonIndex* polygons, const Execution& execution);

}  // namespace warren
