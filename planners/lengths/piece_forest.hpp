// SPDX-License-Identifier: BSD-3-Clause
// The trees that hang off the core, cut at the borders of tiles. A piece is what of a tree lies connected in one tile
// and points over its border: all cells of it leave by the same exit. Pieces form a forest: a piece's parent is the
// piece that its exit leads to, none where it leads to cells that reach the core inside their tile. A climb from a
// cell to its piece's exit stays in one tile, in cache; from there on pieces are climbed, not cells.
//
// The lowest common ancestor of two pieces is found by heavy paths: each piece's largest child goes on its path, and
// pieces are numbered path by path, an upper path before those that hang off it. Of two pieces on different paths the
// one with the larger number leaves its path by the head; at most log2(pieces) times, a handful in mazes. This takes
// one number less a piece than Schieber and Vishkin's labels, and says at once by which child an ancestor is reached.
// All that a climb needs of a piece, and of the path that it leaves, is in one line of cache.
// Cost: O(pieces) to build, serial but for the climbs; about 0.016 pieces a cell in a perfect maze, 20 bytes each.
#pragma once

#include <array>
#include <cstdint>

#include "core/run/execution.hpp"
#include "planners/lengths/array_or_view.hpp"
#include "planners/lengths/cell_marks.hpp"

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

/// Which cells along a side of a tile point over it.
std::uint64_t exits_of(CellMarks marks, std::uint32_t tile, unsigned direction);

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

}  // namespace warren
