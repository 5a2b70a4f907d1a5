// SPDX-License-Identifier: BSD-3-Clause
// The core of a lattice roadmap as a planar map: junctions, the cells where three core edges or more meet, joined by
// chains of cells without choice. A few more cells are junctions, those of every 16th column in every 16th row, so that
// chains are short and few rings have no junction at all. A junction has four slots, one a direction; slot d of
// junction j is half-edge 4 j + d, and `twin` is the half-edge at the other end of its chain: chains and the order of
// slots around a junction are all that cutting the plane needs. A chain back to its own junction, and the longer one of
// two between the same junctions, is on no shortest path between junctions and is left out.
// Cost: each chain is walked from both ends, O(core cells); 32 bytes a junction.
#pragma once

#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"
#include "planners/route_trees/lattice_places.hpp"

namespace warren {

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

/// peeled: planners/route_trees/peeling.hpp. Throws Stopped, and InputError where there are 2^30 junctions or more.
CoreGraph core_graph(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places, const Execution& execution);

}  // namespace warren
