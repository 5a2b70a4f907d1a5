// SPDX-License-Identifier: BSD-3-Clause
// Junctions without choice leave the core's map: where the longer one of two parallel chains, or a chain back to its
// own junction, has been left out, a junction may have two chains left, which become one, or one, which goes with it;
// that again may make chains parallel. Lengths between junctions that stay are the same. Cells of what left are not
// lost: a search from them walks the lattice's own cells to the junctions that stay. The cells of the chains that stay
// are told where these go on, so that whoever follows one meets a choice at junctions that stay and nowhere else.
// Junctions on the grid of posts (core_graph.hpp) stay, so that these searches remain short. In mazes with 1 % loops
// more than half of the junctions leave, with 10 % a fifth; cuts get shorter by as much.
// Cost: serial, some tens of ns a junction.
#pragma once

#include "parallel/execution.hpp"
#include "planners/route_cuts/core_graph.hpp"

namespace warren {

/// peeled: as core_graph() took it. Junctions that become part of a chain have its two core edges left there, and each
/// cell on a chain that stays gets its peel_bit::direction bits: does the chain go on to the right, and upwards; a
/// junction has those of all its chains. Throws Stopped; the graph is then of no more use.
void reduce_core(CoreGraph& graph, const LatticePlaces& places, RawVector<std::uint8_t>& peeled,
                 const Execution& execution);

}  // namespace warren
