// SPDX-License-Identifier: BSD-3-Clause
// What the grid planner is told: the options that maps and lattices of scenes share.
#pragma once

#include <span>
#include <string_view>

#include "planners/grid_search.hpp"
#include "tools/arguments.hpp"
#include "tools/command.hpp"

namespace warren {

/// --cell --angles --face-motion --diagonal --layers
std::span<const OptionSpec> grid_option_specs();

/// --diagonal: sqrt2 where nothing is said. Throws UsageError.
Diagonal diagonal_option(const Arguments& arguments);

/// --search: astar, dijkstra or bfs; `usual` where nothing is said. Throws UsageError for dfs.
GridMethod method_option(const Arguments& arguments, GridMethod usual);

std::string_view name_of(Diagonal diagonal);
std::string_view name_of(GridMethod method);

}  // namespace warren
