// SPDX-License-Identifier: BSD-3-Clause
// A visibility graph as it must not be made, for comparison: two corners are joined if none of some points of the way
// between them is inside a polygon. Ways between corners are looked at every `step`, ways from start and goal at a
// hundred places, however long they are. It accepts edges that cut through obstacles between two of these points.
// A point counts as inside if it is farther from the outline than its own rounding, so that sides of polygons pass.
// O(n^2 samples log n) for n corners.
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "spatial/obstacles/polygon_index.hpp"

namespace warren {

/// Edges, ascending, with from < to: corners in the polygons' order, then start, then goal. step > 0. Walls and bounds
/// are not looked at. The same for any number of threads; throws Stopped.
std::vector<Edge> sampled_visibility(const PolygonIndex& polygons, Vec2 start, Vec2 goal, double step,
                                     const Execution& execution);

/// How deep the segment runs inside of polygons: the greatest distance of one of `places` points of it to the outline
/// of a polygon around it; 0 if none of them is inside.
double depth_inside(const PolygonIndex& polygons, const Segment& segment, std::size_t places);

}  // namespace warren
