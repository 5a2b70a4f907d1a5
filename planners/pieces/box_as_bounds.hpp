// SPDX-License-Identifier: BSD-3-Clause
// Worlds without bounds, whose obstacles' box confines the reference point and is no wall: paths may run along polygons
// on it and around walls that end on it, and shortest paths don't leave it by themselves. But nobody gets between the
// box and a wall that lies on its side: a maze's outline shall not be walked around on the outside.
#pragma once

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"

namespace warren {

/// The bounds, or else the box of polygons and walls; empty where there is nothing.
Box box_around(const PlaneObstacles& obstacles);

/// The same for planners of shortest paths that know bounds only. Behind each wall on a side of the box stands a
/// polygon that reaches to bounds well outside of the box; without such walls, or with bounds, nothing is changed.
PlaneObstacles confined(PlaneObstacles obstacles);

}  // namespace warren
