// SPDX-License-Identifier: BSD-3-Clause
// The proof behind "infeasible": where all walls lie on the unit grid, a body of any size that keeps off the walls can
// pass from cell to cell only through open sides (a grid point without walls is the corner of four open sides), so
// cells that a flood does not join are not joined by any path. Claims nothing where bounds reach beyond the maze's box,
// since a path could leave by the entrance and come in again by the exit. O(walls + cells).
#pragma once

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Is it proved that no path joins start and goal? Both are free points of the scene, which has the maze hint.
bool proves_infeasible(const Scene& scene, Vec2 start, Vec2 goal, const Execution& execution);

}  // namespace warren
