// SPDX-License-Identifier: BSD-3-Clause
// The core of a lattice roadmap as a planar map: junctions, the cells where three core edges or more meet, joined by
// chains of cells without choice. A few more cells are junctions, those of every 16th column in every 16th row, so that
// chains are short and few rings have no junction at all. A junction has four slots, one a direction; slot d of
// junction j is half-edge 4 j + d, and `twin` is the half-edge at the other end of its chain: chains and the order of
// slots around a junction are all that cutting the plane needs. A chain back to its own junction, and the longer one of
// two between the same junctions, is on no shortest path between junctions and is left out.
// What planners/graph/roadmap_search.hpp makes of a graph lacks the two things that lengths need: which way each cell
// of a tree was taken off, and the order of slots. Cost: each chain is walked from both ends, O(core cells); 32 bytes a
// junction.
#pragma once

#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "planners/lengths/cell_marks.hpp"

namespace warren {

/// A cell's byte: bits 0 to 3 its core edges; `peeled` if it is no cell of the core, with its direction in bits 4
/// and 5, which are 0 in the core.
namespace peel_bit {
inline constexpr std::uint8_t edges = 15;
inline constexpr unsigned direction_shift = 4;
inline constexpr std::uint8_t peeled = 64;
}  // namespace peel_bit

/// What of a lattice roadmap is tree, and which way its root is. A dead end is taken off with its only edge and points
/// along it; what becomes a dead end by that follows, until none is left. What remains is the 2-core, where every cell
/// has two core edges or more, and one cell of each component that is a tree: its root. So each cell that is taken off
/// points towards the core, or to the root of its tree.
///
/// Each tile of 64 x 64 cells is peeled by itself, following each dead end inwards; then squares of 8 x 8 tiles,
/// squares of 8 x 8 of these, and so on: each takes up the dead ends that point over the borders inside it. Squares of
/// a size share nothing, and which cell becomes a tree's root follows from the order in a square, so the bytes are the
/// same for any thread count. Cost: one byte a cell, O(cells) time; few cells are left for the large squares. A byte a
/// place. Throws Stopped.
RawVector<std::uint8_t> peel(const LatticePassages& passages, const LatticePlaces& places, const Execution& execution);

using JunctionId = std::uint32_t;
using HalfEdge = std::uint32_t;
inline constexpr HalfEdge no_half_edge = ~HalfEdge{0};

struct CoreGraph {
  RawVector<LatticePlace> place;    ///< of a junction, ascending
  RawVector<HalfEdge> twin;         ///< of a half-edge, no_half_edge where the slot is empty
  RawVector<std::uint32_t> length;  ///< of its chain, in steps
  std::uint64_t core_cells = 0;

  std::size_t size() const { return place.size(); }
};

/// A bit for each slot of a junction that isn't empty.
inline std::uint8_t slots_of(const CoreGraph& graph, JunctionId v) {
  unsigned slots = 0;
  for (unsigned s = 0; s < 4; ++s) slots |= graph.twin[4 * v + s] != no_half_edge ? 1U << s : 0U;
  return static_cast<std::uint8_t>(slots);
}

/// Is the place on the grid of posts, every 16th column in every 16th row?
constexpr bool is_post(LatticePlace p) { return (p & (15U | 15U * LatticePlaces::side)) == 0; }

/// peeled: what peel() gave. Throws Stopped, and InputError where there are 2^30 junctions or more.
CoreGraph core_graph(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places, const Execution& execution);

/// Junctions without choice leave the core's map: where the longer one of two parallel chains, or a chain back to its
/// own junction, has been left out, a junction may have two chains left, which become one, or one, which goes with it;
/// that again may make chains parallel. Lengths between junctions that stay are the same. Cells of what left are not
/// lost: a search from them walks the lattice's own cells to the junctions that stay. The cells of the chains that stay
/// are told where these go on, so that whoever follows one meets a choice at junctions that stay and nowhere else.
/// Junctions on the grid of posts stay, so that these searches remain short. In mazes with 1 % loops
/// more than half of the junctions leave, with 10 % a fifth; cuts get shorter by as much.
/// Cost: serial, some tens of ns a junction.
///
/// peeled: as core_graph() took it. Junctions that become part of a chain have its two core edges left there, and each
/// cell on a chain that stays gets its peel_bit::direction bits: does the chain go on to the right, and upwards; a
/// junction has those of all its chains. Throws Stopped; the graph is then of no more use.
void reduce_core(CoreGraph& graph, const LatticePlaces& places, RawVector<std::uint8_t>& peeled,
                 const Execution& execution);

/// The words for peeled bytes, after reduce_core(). Throws Stopped.
RawVector<std::uint64_t> mark_words(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places,
                                    const Execution& execution);

// Nested dissection of the core: the map is cut in two by few junctions (planners/lengths/dissection.cpp), the
// parts again, until they have no more than a leaf's junctions. Nodes are the cuts and the leaves, listed children
// first; a node's junctions have chains to its own, to those of its descendants and of its ancestors only.
//
// Large regions are cut one beside the other, the small ones whole by one thread each. Which is large follows from the
// number of junctions, and all parts are joined in their order, so the result is the same for any thread count.
// Cost: O(junctions log junctions); about 60 bytes a junction of the regions being cut.

struct DissectionNode {
  std::uint32_t members;   ///< how many of the junctions are its own
  std::uint32_t children;  ///< nodes right below it, listed before it
  std::uint32_t is_leaf;   ///< 1: what is left between cuts
};

struct Dissection {
  RawVector<DissectionNode> node;  ///< children before parents
  RawVector<JunctionId> member;    ///< node by node, ascending in each
};

/// The most junctions of a leaf: a way through so many is told by less than 63 bits
/// (planners/lengths/separator_fronts.hpp).
inline constexpr std::size_t most_leaf_junctions = 36;

/// leaf: 1 .. most_leaf_junctions. Throws Stopped.
Dissection dissect(const CoreGraph& graph, std::size_t leaf, const Execution& execution);

}  // namespace warren
