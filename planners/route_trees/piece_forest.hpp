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
// Cost: O(pieces) to build, serial but for the climbs; about 0.016 pieces a cell in a perfect maze, 16 bytes each.
#pragma once

#include <array>
#include <cstdint>

#include "parallel/execution.hpp"
#include "planners/route_trees/array_or_view.hpp"
#include "planners/route_trees/cell_marks.hpp"

namespace warren {

using PieceId = std::uint32_t;
inline constexpr PieceId no_piece = ~PieceId{0};

/// The arrays, as a file may hold them. Exits of a tile are counted by direction, and along the side.
struct PieceArrays {
  ArrayOrView<std::uint64_t> exits;       ///< four words a tile: which cells of its right, upper, left, lower side
  ArrayOrView<std::uint32_t> first_exit;  ///< of a tile; and the end
  ArrayOrView<PieceId> piece;             ///< of an exit
  ArrayOrView<PieceId> head;              ///< of a piece: the first of its path
  ArrayOrView<PieceId> parent;            ///< of a piece
  ArrayOrView<std::uint32_t> depth;       ///< of a piece: steps from its exit's cell to the core
  ArrayOrView<LatticePlace> door;         ///< of a piece: the cell that its exit leads to
};

/// Which cells along a side of a tile point over it.
std::uint64_t exits_of(CellMarks marks, std::uint32_t tile, unsigned direction);

/// Where a climb in a tile ended.
struct Climb {
  LatticePlace last;    ///< in the tile
  std::uint32_t steps;  ///< to it
  bool at_core;         ///< or at an exit
};

/// Looks at the arrays; any number of threads may.
class PieceForest {
 public:
  PieceForest(const LatticePlaces& places, CellMarks marks, const PieceArrays& arrays)
      : places_(places), marks_(marks), arrays_(arrays) {}

  /// Ends after as many steps as a tile has cells at the latest, whatever the marks are.
  Climb climb(LatticePlace from) const;
  /// The piece whose exit a climb ended at.
  PieceId piece_at(LatticePlace exit) const;

  PieceId head(PieceId p) const { return arrays_.head[p]; }
  PieceId parent(PieceId p) const { return arrays_.parent[p]; }
  std::uint32_t depth(PieceId p) const { return arrays_.depth[p]; }
  LatticePlace door(PieceId p) const { return arrays_.door[p]; }

 private:
  const LatticePlaces& places_;
  CellMarks marks_;
  const PieceArrays& arrays_;
};

/// Throws Stopped.
PieceArrays build_pieces(const LatticePlaces& places, CellMarks marks, const Execution& execution);

}  // namespace warren
