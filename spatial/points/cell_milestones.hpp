// SPDX-License-Identifier: BSD-3-Clause
// Which cells of a map make milestones of a roadmap whose corridors are about a cell wide: the middle of every free
// cell, but of two neighbours inside a straight corridor one cell wide only one, by a chequerboard. What is left out
// has two kept cells beside it, two cells apart, so motions of at most two cells join exactly what steps over common
// sides join; and a maze drawn with walls and corridors of one cell has one milestone a cell of the maze. Bit-parallel:
// O(cells / 64).
#pragma once

#include "core/base/bitmap.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// The longest motion between milestones that are to be joined, in cells, and room for rounding.
inline constexpr double cell_milestone_reach = 2.0 * (1.0 + 1e-6);

/// A bit for each cell whose middle is a milestone. Throws Stopped.
Bitmap cell_milestones(const Bitmap& blocked, const Execution& execution);

/// Are most free cells in passages one cell wide, that is, in no square of two by two free cells? There a sample drawn
/// anywhere seldom sees the next one, and the middles of the cells are the cheaper milestones.
bool is_narrow(const Bitmap& blocked);

}  // namespace warren
