// SPDX-License-Identifier: BSD-3-Clause
// What the grid planner is told: the options that maps and lattices of scenes share.
#pragma once

#include "planners/grid/grid_search.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// Throws UsageError for dfs; `usual` where nothing is said.
GridMethod grid_method(const SolveOptions& options, GridMethod usual);

/// Throws UsageError where the world has more cells of that size than any grid or map may have.
void check_cell(double cell, const Scene& scene);

/// The raster of a scene: cell and angles of the options, else the file's grid line, else a four-hundredth of the
/// longer side of the bounds (or of the obstacles' box) and 72 headings. A map's cells are its own. Throws UsageError
/// for a world without extent and for values out of range.
GridSpec grid_spec(const GridFields& options, const Scene& scene);

}  // namespace warren
