// SPDX-License-Identifier: BSD-3-Clause
// A maze's lattice says where its walls are in two bits a cell: whoever keeps the roadmap of a large one in memory may
// let the walls themselves go, eight bytes each. The judge then reads the bits by code of its own, which holds them
// against the world's hash first, as those of a file.
#pragma once

#include "parallel/execution.hpp"
#include "solve/roadmaps/roadmap.hpp"

namespace warren {

/// Of a roadmap that was just built. Nothing happens where it has no lattice, or where the walls are not, to the bit
/// and in the order, those that stand wherever the lattice has no passage. References to the scene mean nothing then.
/// Half a second for 10^8 cells. Throws Stopped.
void let_walls_go(Roadmap& roadmap, const Execution& execution);

}  // namespace warren
