// SPDX-License-Identifier: BSD-3-Clause
// What of a lattice roadmap is tree, and which way its root is. A dead end is taken off with its only edge and points
// along it; what becomes a dead end by that follows, until none is left. What remains is the 2-core, where every cell
// has two core edges or more, and one cell of each component that is a tree: its root. So each cell that is taken off
// points towards the core, or to the root of its tree.
//
// Each tile of 64 x 64 cells is peeled by itself, following each dead end inwards; then squares of 8 x 8 tiles, squares
// of 8 x 8 of these, and so on: each takes up the dead ends that point over the borders inside it. Squares of a size
// share nothing, and which cell becomes a tree's root follows from the order in a square, so the bytes are the same
// for any thread count. Cost: one byte a cell, O(cells) time; few cells are left for the large squares.
#pragma once

#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"
#include "planners/route_trees/lattice_places.hpp"

namespace warren {

/// A cell's byte: bits 0 to 3 its core edges; `peeled` if it is no cell of the core, with its direction in bits 4
/// and 5, which are 0 in the core.
namespace peel_bit {
inline constexpr std::uint8_t edges = 15;
inline constexpr unsigned direction_shift = 4;
inline constexpr std::uint8_t peeled = 64;
}  // namespace peel_bit

/// A byte a place. Throws Stopped.
RawVector<std::uint8_t> peel(const LatticePassages& passages, const LatticePlaces& places, const Execution& execution);

}  // namespace warren
