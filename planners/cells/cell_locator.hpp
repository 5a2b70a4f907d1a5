// SPDX-License-Identifier: BSD-3-Clause
// Where points lie among vertical cells that are there already: the answer that the sweep gives for points that it is
// asked about on its way (CellPlace), without sweeping again. Every decision is exact.
// O(cells + corners) a point, a comparison or two for most of them.
#pragma once

#include "core/plane/polygon.hpp"
#include "planners/cells/cell_decomposition.hpp"

namespace warren {

/// `cells` are those of decompose() for the same obstacles.
CellPlace locate(const CellDecomposition& cells, const PlaneObstacles& obstacles, Vec2 p);

/// Is the cell one between the box's side and a segment on it where nobody can move? That is so for the bounds, which
/// are walls. Where the box only confines, paths run along polygons on it, but not between walls and it.
bool is_flat(const CellDecomposition& cells, const PlaneObstacles& obstacles, const VerticalCell& cell);

}  // namespace warren
