// SPDX-License-Identifier: BSD-3-Clause
// Polygons that may overlap, cut so that their sides share nothing but corners: a corner wherever sides cross, end on
// each other or lie on each other. What the polygons cover together then shows at each side: it bounds the union where
// no polygon covers one of its sides (the number of polygons above a side is what a sweep counts).
//
// Crossings are no doubles in general, so all corners are rounded to multiples of a power of two, 2^-45 of the largest
// coordinate, and the cutting is repeated until nothing crosses (planners/pieces/crossing_cuts); from there on
// everything is exact. No point of an outline moves by more than 0.71 units a round, and a few rounds do: `error`
// tells. Corners move, outlines stay closed, so the count of polygons around a point is right for all points farther
// than `error` from the outlines. Time: O(n + pairs that come near each other) a round; one thread.
#pragma once

#include "core/plane/polygon.hpp"
#include "parallel/execution.hpp"

namespace warren {

struct NodedPolygons {
  PolygonSet polygons;  ///< in the same order; those that vanish when rounded have no corners
  double error = 0.0;   ///< world units: how far a point of an outline may have moved
};

/// Throws InputError where the rounding doesn't come to rest, or for 2^31 sides and more; Stopped at the deadline.
NodedPolygons node_polygons(const PolygonSet& polygons, const Execution& execution);

}  // namespace warren
