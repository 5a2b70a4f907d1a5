// SPDX-License-Identifier: BSD-3-Clause
// The cells of a hop (planners/route_cuts/hop_turns.hpp), from marks alone: each cell of a chain says where it goes on,
// and at junctions the turns do. Cost: 3 to 6 ns a cell, on all threads.
#pragma once

#include <cstdint>
#include <span>

#include "parallel/execution.hpp"
#include "planners/route_cuts/hop_turns.hpp"
#include "planners/route_index/route_index.hpp"

namespace warren {

/// A hop, and where its cells go: from `from` to `to` = `length` steps on, the first one to `first`, each further one
/// `direction`, 1 or -1, beside the one before it.
struct Hop {
  LatticePlace from;
  LatticePlace to;
  std::uint32_t length;
  int direction;
  HopTurns turns;
  CellId* first;
};

/// Writes the cells of all hops but the last one of each, as they lie: it is the next hop's first. Throws InputError
/// where marks lead elsewhere: after as many steps as the hops have, whatever the marks are. Throws Stopped.
void write_hops(const RouteIndex& index, std::span<const Hop> hops, const Execution& execution);

}  // namespace warren
