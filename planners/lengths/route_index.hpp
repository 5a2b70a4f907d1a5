// SPDX-License-Identifier: BSD-3-Clause
// The route index of a lattice roadmap: made once, it answers the shortest length between any two cells, and the path,
// exactly, thousands of times faster than a search of the roadmap. For mazes: what is tree is climbed, what has no
// choice is walked, and only where loops meet is there something to decide.
//
//   peeling            which cells are tree, and which way their core is           (planners/lengths/core_graph)
//   pieces             trees cut at the borders of tiles, with heavy paths         (PieceForest)
//   core graph         junctions of the core, joined by chains                     (core_graph)
//   reduction          junctions without choice leave it; chains are marked      (core_graph)
//   dissection         the core cut by few junctions again and again               (dissection)
//   fronts             lengths and ways between the junctions of cuts, the gates   (separator_fronts)
//
// All of it is plain arrays, which a file may hold (route_index.hpp), and the same bytes for any thread count. In
// open space nearly every cell is a junction and cuts are as long as the lattice is wide: there a search of the grid is
// better, and the index is refused by counting.
// A backtracker's maze of 10^8 cells on two busy cores (bench/roadmaps/route_phases.cpp; passages in memory before):
//   walls left that are taken out        none     1 %    10 %
//   seconds to build                      1.6     3.0      32
//   bytes a cell, passages included      0.95    1.26    4.74
//   length of random pairs, median us        4      60     850
//   the same, 99 of 100                      9     124    1220
//   path beyond its length, ns a cell        7     9.5      40
//
// Pieces: the trees that hang off the core, cut at the borders of tiles. A piece is what of a tree lies connected in
// one tile and points over its border: all cells of it leave by the same exit. Pieces form a forest: a piece's parent
// is the piece that its exit leads to, none where it leads to cells that reach the core inside their tile. A climb from
// a cell to its piece's exit stays in one tile, in cache; from there on pieces are climbed, not cells.
//
// The lowest common ancestor of two pieces is found by heavy paths: each piece's largest child goes on its path, and
// pieces are numbered path by path, an upper path before those that hang off it. Of two pieces on different paths the
// one with the larger number leaves its path by the head; at most log2(pieces) times, a handful in mazes. This takes
// one number less a piece than Schieber and Vishkin's labels, and says at once by which child an ancestor is reached.
// All that a climb needs of a piece, and of the path that it leaves, is in one line of cache.
// Cost: O(pieces) to build, serial but for the climbs; about 0.016 pieces a cell in a perfect maze, 20 bytes each.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/run/execution.hpp"
#include "parallel/once.hpp"
#include "planners/lengths/core_graph.hpp"
#include "planners/lengths/separator_fronts.hpp"

namespace warren {

using PieceId = std::uint32_t;
inline constexpr PieceId no_piece = ~PieceId{0};

struct TreePiece {
  PieceId head;         ///< the first piece of its path; all others lead to the one with the next smaller number
  PieceId up;           ///< where the head of its path leads to, no_piece: to the core
  std::uint32_t depth;  ///< steps from its exit's cell to the core
  LatticePlace door;    ///< the cell that its exit leads to
};

/// The arrays, as a file may hold them. Exits of a tile are counted by direction, and along the side.
struct PieceArrays {
  ArrayOrView<std::uint64_t> exits;       ///< four words a tile: which cells of its right, upper, left, lower side
  ArrayOrView<std::uint32_t> first_exit;  ///< of a tile; and the end
  ArrayOrView<PieceId> piece;             ///< of an exit
  ArrayOrView<TreePiece> pieces;
};

/// Where a climb in a tile ended.
struct Climb {
  LatticePlace last;    ///< in the tile
  std::uint32_t steps;  ///< to it
  bool at_core;         ///< or at an exit
};

/// Looks at the arrays; any number of threads may. Numbers that lead out of the arrays, or round in a circle, throw
/// InputError where they are met.
class PieceForest {
 public:
  PieceForest(const LatticePlaces& places, CellMarks marks, const PieceArrays& arrays)
      : places_(places), marks_(marks), arrays_(arrays) {}

  /// Ends after as many steps as a tile has cells at the latest, whatever the marks are.
  Climb climb(LatticePlace from) const;
  /// Two climbs side by side: each step waits for the one before it, so two take hardly longer than one.
  std::array<Climb, 2> climb_both(LatticePlace a, LatticePlace b) const;
  /// Asks the memory for all that a climb from here looks at.
  void prefetch(LatticePlace from) const;
  /// The piece whose exit a climb ended at.
  PieceId piece_at(LatticePlace exit) const;
  /// Less than the number of pieces: as piece_at() and other pieces give them.
  const TreePiece& piece(PieceId p) const;

 private:
  const LatticePlaces& places_;
  CellMarks marks_;
  const PieceArrays& arrays_;
};

/// Throws Stopped.
PieceArrays build_pieces(const LatticePlaces& places, CellMarks marks, const Execution& execution);

struct RouteIndexOptions {
  std::uint32_t leaf = 0;   ///< most junctions of a leaf, to most_leaf_junctions; searched cell by cell; 0: counted
  bool open_space = false;  ///< build it where it doesn't pay, too
  void validate() const;
};

/// Does the index pay? Where no more than 3 of 10 cells are junctions with a choice: mazes of which up to a
/// fifth of the walls left are taken out.
bool route_index_pays(std::uint64_t junctions, std::uint64_t cells);

/// What an index is made of, but for the passages.
struct RouteArrays {
  ArrayOrView<std::uint64_t> marks;  ///< of all cells, see core_graph.hpp
  PieceArrays pieces;
  ArrayOrView<std::uint64_t> gates;         ///< a bit a place; empty if there is no gate
  ArrayOrView<std::uint32_t> gates_before;  ///< before each row of 64 places; empty if there is no gate
  ArrayOrView<GateRank> gate_rank;          ///< of a gate in the order of places
  FrontArrays fronts;
};

/// Immutable; any number of threads may read.
class RouteIndex {
 public:
  /// Throws InputError where it doesn't pay and open_space isn't set, and Stopped.
  RouteIndex(LatticePassages passages, const RouteIndexOptions& options, const Execution& execution);
  /// From arrays made before, owned or views. Whatever their numbers are, no question leaves the arrays or turns in a
  /// circle: what is looked at is checked where it is met, a front as a whole when it is first met, and questions throw
  /// InputError. Throws InputError itself for arrays of the wrong size and fronts that lead out of them.
  RouteIndex(LatticePassages passages, RouteArrays arrays);

  const LatticePassages& passages() const { return passages_; }
  const LatticePlaces& places() const { return places_; }
  const RouteArrays& arrays() const { return arrays_; }
  CellMarks marks() const { return CellMarks(arrays_.marks.data()); }
  PieceForest pieces() const { return {places_, marks(), arrays_.pieces}; }
  /// Before marks of the tile of a place are read.
  void look_at_tile(LatticePlace p) const {
    constexpr std::size_t words = LatticePlaces::side * mark_word::count;
    arrays_.marks.look(LatticePlaces::tile_of(p) * words, words);
  }
  bool is_gate(LatticePlace p) const { return !arrays_.gates.empty() && (arrays_.gates[p / 64] >> p % 64 & 1U) != 0; }
  /// The rank of a cell that is a gate.
  GateRank gate_at(LatticePlace p) const;
  /// The cell of a gate.
  LatticePlace gate_place(GateRank rank) const;
  /// The front that a gate is in.
  FrontId front_of(GateRank rank) const {
    const std::span<const Front> fronts = arrays_.fronts.fronts.span();
    FrontId front = front_near_[rank / gates_a_look];
    while (front + 1 < fronts.size() && fronts[front + 1].first <= rank) ++front;
    return front;
  }
  void prefetch_front_of(GateRank rank) const {
    __builtin_prefetch(arrays_.fronts.fronts.data() + front_near_[rank / gates_a_look]);
    __builtin_prefetch(arrays_.fronts.fronts.data() + front_near_[rank / gates_a_look] + 1);
  }
  /// A front whose bounds and rows may be read.
  const Front& front(FrontId number) const {
    if (!sound_.test(number)) [[unlikely]]
      check_front(number);
    return arrays_.fronts.fronts[number];
  }

 private:
  static constexpr std::size_t gates_a_look = 4;

  /// Of a gate, in the order of places.
  std::size_t number_of_gate(LatticePlace p) const {
    const std::uint64_t below = (std::uint64_t{1} << p % 64) - 1;
    return std::size_t{arrays_.gates_before[p / 64]} +
           static_cast<std::size_t>(std::popcount(arrays_.gates[p / 64] & below));
  }

  void mark_gates(const Execution& execution);
  void find_fronts(const Execution& execution);
  void check_front(FrontId number) const;

  LatticePassages passages_;
  LatticePlaces places_;
  RouteArrays arrays_;
  RawVector<FrontId> front_near_;  // of every 4th gate
  mutable LastingMarks sound_{0};  // fronts that have been checked
};

/// A route index as named arrays of bytes, for whoever writes files, and back: the arrays of a mapped file are looked
/// at where they are. Numbers lie in the machine's own order; elements have the widths of RouteArrays.
struct RouteSection {
  std::string_view name;      ///< a literal, at most 15 letters
  std::size_t element_bytes;  ///< of one element; for structs, their size
  std::span<const std::byte> bytes;
  FirstLook first_look = {};  ///< before its bytes are read
};

/// All arrays, in a fixed order; they live as long as the index.
std::vector<RouteSection> route_sections(const RouteIndex& index);

/// Their names and widths alone, without bytes.
std::vector<RouteSection> route_section_kinds();

/// An index that looks at the sections' bytes, which must outlive it and be aligned to 8 bytes. Sections with other
/// names are left alone. Throws InputError for one that is missing, has half an element, or contradicts another.
RouteIndex route_index_of(LatticeSize size, std::span<const RouteSection> sections);

/// May its bytes be looked at one by one, when they are needed? Else whoever makes an index of it looks at all of them.
bool is_read_in_parts(std::string_view section);

/// Throws InputError unless every number in the arrays is in its range; what is wrong nevertheless gives wrong answers
/// and nothing worse. O(bytes).
void check_route_arrays(const LatticePlaces& places, const RouteArrays& arrays);

// Questions to a route index: the shortest length between two cells, and a path of that length. Both cells climb to the
// core; cells of one tree meet in it. In the core both look around up to the gates of their leaf, and the fronts join
// these, if the other cell wasn't nearer. Exact: the length is that of a breadth-first search of the whole lattice.
// Cost: microseconds in trees, then the rows of the fronts above both; see bench/roadmaps/route_index_bench.cpp.

/// Scratch of one thread: 8 bytes a gate. Refers to the index, which must outlive it.
class RouteQuery {
 public:
  explicit RouteQuery(const RouteIndex& index);
  ~RouteQuery();
  RouteQuery(RouteQuery&&) noexcept;

  /// In steps; none where no path joins the cells. Throws InputError for a cell outside the lattice.
  std::optional<std::uint32_t> length(CellId start, CellId goal);
  /// The cells of a shortest path, both ends included; empty where there is none. Throws Stopped.
  RawVector<CellId> path(CellId start, CellId goal, const Execution& execution = {.threads = 1});

 private:
  class Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace warren
