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
// Beside each length, in an array of its own that lengths never look at, stands which gate of lower rank the way goes
// over, in its two halves by that gate's row; or, where it passes no gate, its turns (separator_fronts.hpp). A path is
// told by these, without any search.
//
// To build, each node hands its parent the lengths between its bounds by ways through itself. Leaves of some dozens
// of junctions are eliminated by least degree and not stored: their ways are hops.
// Cost: 0.2 to 0.4 entries a junction and level of the dissection; time is cubic in the size of the largest cut.
//
// Fronts are made of sums of lengths and their least, many at once (lessen_row). Integers only, so every instruction
// set gives the same numbers; which one is used is asked of the processor once.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/instruction_set.hpp"
#include "core/run/execution.hpp"
#include "planners/lengths/core_graph.hpp"

namespace warren {

/// No way. Two lengths, and a length and no_way, can be added.
inline constexpr std::uint32_t no_way = std::uint32_t{1} << 30;

/// No way among short lengths.
inline constexpr std::uint16_t no_short_way = 0xffff;

/// least[i] becomes the smaller of itself and first + rest[i], for i < count. The arrays don't overlap. Length:
/// std::uint32_t, or std::uint16_t of short lengths, whose no_short_way lessens nothing that is at most no_way.
template <class Length>
using LessenRow = void (*)(std::uint32_t* least, const Length* rest, std::uint32_t first, std::size_t count);

/// The fastest of this processor, or of another set.
template <class Length>
LessenRow<Length> lessen_row(detail::InstructionSet set = detail::best_instruction_set());

/// The same where it is told by what: by[i] becomes `gate` where least[i] became smaller. `by` overlaps neither.
using LessenRowBy = void (*)(std::uint32_t* least, std::uint32_t* by, const std::uint32_t* rest, std::uint32_t first,
                             std::uint32_t gate, std::size_t count);
LessenRowBy lessen_row_by(detail::InstructionSet set = detail::best_instruction_set());

/// A hop is a way from a gate to another that passes no third: along one chain, or through the junctions of one leaf.
/// Its turns are one number: at each junction, the gate where it begins included, it takes one of so many exits, that
/// by which it came left out, and their numbers are the digits, the first one the lowest. Where there is one exit
/// alone, along chains, nothing is to be told. With most_leaf_junctions that is less than 4 * 3^36 < 2^60.
using HopTurns = std::uint64_t;

/// Puts turns together, in the order of the way.
class TurnWriter {
 public:
  /// exits: a bit a direction, `direction` among them.
  void take(unsigned exits, unsigned direction) {
    turns_ += unit_ * exit_count(exits & ((1U << direction) - 1));
    unit_ *= exit_count(exits);
  }
  HopTurns turns() const { return turns_; }

 private:
  HopTurns turns_ = 0;
  HopTurns unit_ = 1;
};

/// Which of two to four exits is taken, as a bit; `turns` becomes those that are left.
inline unsigned next_turn(unsigned exits, HopTurns& turns) {
  const unsigned count = exit_count(exits);
  HopTurns before = 0;
  if (count == 3) {
    before = turns % 3;
    turns /= 3;
  } else {  // two or four
    before = turns & (count - 1);
    turns >>= count / 2;
  }
  for (; before > 0; --before) exits &= exits - 1;
  return exits & (~exits + 1);
}

/// A gate's number: children before parents.
using GateRank = std::uint32_t;

using FrontId = std::uint32_t;
inline constexpr FrontId no_front = ~FrontId{0};

struct Front {
  std::uint64_t first_bound;  ///< in bounds
  std::uint64_t rows;         ///< twice where its rows begin, plus 1 where they are of short lengths
  std::uint64_t ways;         ///< four times where its ways begin, plus 0, 1 or 2 where they have 16, 32 or 64 bits
  GateRank first;             ///< its gates are first .. first + gates - 1
  std::uint32_t gates;
  std::uint32_t bounds;
  FrontId parent;  ///< of its lowest bound, no_front if there is none; larger than its own number

  bool is_short() const { return (rows & 1U) != 0; }
  /// In short_lengths or lengths: row i has gates - 1 - i + bounds of them.
  std::uint64_t first_length() const { return rows / 2; }
  /// In FrontArrays::ways: rows as of lengths, of so many elements each.
  std::uint64_t first_way() const { return ways / 4; }
  std::uint64_t way_elements() const { return std::uint64_t{1} << (ways & 3U); }
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
  /// Of all entries: twice how far the gate that the way goes over is below the row's rank; or twice a hop's turns,
  /// from the row's gate, plus 1; the lowest 16 bits first. Anything where there is no way.
  ArrayOrView<std::uint16_t> ways;
  ArrayOrView<LatticePlace> gate_place;  ///< of a gate
};

/// How entry `at` of a front goes, counted along its rows: as FrontArrays::ways has it.
inline std::uint64_t front_way(const FrontArrays& fronts, const Front& f, std::uint64_t at) {
  const std::uint64_t elements = f.way_elements();
  const std::uint64_t first = f.first_way() + at * elements;
  fronts.ways.look(first, elements);
  std::uint64_t way = 0;
  for (std::uint64_t i = elements; i > 0; --i) way = way << 16U | fronts.ways[first + i - 1];
  return way;
}

/// Throws Stopped.
FrontArrays build_fronts(const CoreGraph& graph, const Dissection& dissection, const Execution& execution);

}  // namespace warren
