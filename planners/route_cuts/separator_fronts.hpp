// SPDX-License-Identifier: BSD-3-Clause
// Shortest lengths between the gates of the core: a contraction hierarchy whose order is a nested dissection (Dibbelt,
// Strasser, Wagner 2014), kept front by front, as sparse factorisations are (multifrontal; Duff and Reid 1983).
//
// The junctions of cuts are the gates, ranked children before parents. A front is the cut of one node: its gates, and
// its bounds, the gates of upper cuts that a way through the node's region alone can lead to. Row i of a front holds
// the least length from its i-th gate to each later gate of it and to each bound, over ways whose cells between are
// below: of leaves, of lower fronts, or of earlier gates of this one. Cuts are minimal, so nearly all pairs have such
// ways, and rows are kept without gaps: no list of heads an entry, and whole words of lengths are added at once. Where
// all lengths of a front are below 2^16 - 1, they are kept in two bytes each: a question's time is that of reading
// rows. A shortest way between any two gates climbs from front to parent, then down again; both halves read rows only.
//
// To build, each node hands its parent the lengths between its bounds by ways through itself. Leaves of some dozens
// of junctions are eliminated by least degree and not stored: they are searched cell by cell when asked.
// Cost: 0.2 to 0.4 words a junction and level of the dissection; time is cubic in the size of the largest cut.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "parallel/execution.hpp"
#include "planners/route_cuts/dissection.hpp"
#include "planners/route_trees/array_or_view.hpp"

namespace warren {

/// A gate's number: children before parents.
using GateRank = std::uint32_t;
using FrontId = std::uint32_t;
inline constexpr FrontId no_front = ~FrontId{0};

struct Front {
  std::uint64_t first_bound;  ///< in bounds
  std::uint64_t rows;         ///< twice where its rows begin, plus 1 where they are of short lengths
  GateRank first;             ///< its gates are first .. first + gates - 1
  std::uint32_t gates;
  std::uint32_t bounds;
  FrontId parent;      ///< of its lowest bound, no_front if there is none; larger than its own number
  FrontId last_child;  ///< the child with the largest number, no_front if there is none
  FrontId sibling;     ///< the parent's next smaller child

  bool is_short() const { return (rows & 1U) != 0; }
  /// In short_lengths or lengths: row i has gates - 1 - i + bounds of them.
  std::uint64_t first_length() const { return rows / 2; }
};

/// Where row i of a front with so many gates and bounds begins.
constexpr std::uint64_t row_offset(std::uint64_t i, std::uint64_t gates, std::uint64_t bounds) {
  return i * (gates + bounds - 1) - (i > 0 ? i * (i - 1) / 2 : 0);
}

/// The arrays, as a file may hold them.
struct FrontArrays {
  ArrayOrView<Front> fronts;           ///< ascending by their first gates
  ArrayOrView<GateRank> bounds;        ///< ascending in each front
  ArrayOrView<std::uint32_t> lengths;  ///< of fronts with a length of 2^16 - 1 or more; no_way where there is none
  ArrayOrView<std::uint16_t> short_lengths;  ///< of the others; no_short_way where there is none
  ArrayOrView<LatticePlace> gate_place;      ///< of a gate
};

/// Throws Stopped.
FrontArrays build_fronts(const CoreGraph& graph, const Dissection& dissection, const Execution& execution);

}  // namespace warren
