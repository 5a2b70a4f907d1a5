// SPDX-License-Identifier: BSD-3-Clause
// The cells of climbs (planners/route_trees/piece_forest.hpp), from marks alone. Cost: some ns a cell, on all threads.
#pragma once

#include <cstdint>
#include <span>

#include "parallel/execution.hpp"
#include "planners/route_index/route_index.hpp"

namespace warren {

/// Part of a way to the core, and where its cells go: from `from` to `to` = `steps` steps on, the first one to `first`,
/// each further one `direction`, 1 or -1, beside the one before it.
struct ClimbLeg {
  LatticePlace from;
  LatticePlace to;
  std::uint32_t steps;
  int direction;
  CellId* first;
};

/// Writes the cells of all legs but for the one that each leads to. Throws InputError where marks lead elsewhere, after
/// as many steps as the legs have; Stopped.
void write_climbs(const RouteIndex& index, std::span<const ClimbLeg> legs, const Execution& execution);

}  // namespace warren
