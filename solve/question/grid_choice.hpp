// SPDX-License-Identifier: BSD-3-Clause
// What the grid planner is told: the options that maps and lattices of scenes share.
#pragma once

#include <span>
#include <string_view>

#include "planners/grid/grid_search.hpp"
#include "scenes/scene/scene.hpp"
#include "tools/words/arguments.hpp"
#include "tools/words/command.hpp"

namespace warren {

/// --cell --angles --face-motion --step-cost --turn-cost --diagonal --layers
std::span<const OptionSpec> grid_option_specs();

/// --diagonal: sqrt2 where nothing is said. Throws UsageError.
Diagonal diagonal_option(const Arguments& arguments);

/// --search: astar, dijkstra or bfs; `usual` where nothing is said. Throws UsageError for dfs.
GridMethod method_option(const Arguments& arguments, GridMethod usual);

/// --cell: throws UsageError where it is no size, or where the world has more such cells than any grid or map.
double cell_value(std::string_view text, const Scene& scene);

/// The raster of a scene: --cell and --angles, else the file's grid line, else a four-hundredth of the longer side of
/// the bounds (or of the obstacles' box) and 72 headings. A map's cells are its own. Throws UsageError for a world
/// without extent and for values out of range.
GridSpec grid_spec(const Arguments& arguments, const Scene& scene);

std::string_view name_of(Diagonal diagonal);
std::string_view name_of(GridMethod method);

}  // namespace warren
