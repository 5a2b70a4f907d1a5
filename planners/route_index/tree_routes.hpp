// SPDX-License-Identifier: BSD-3-Clause
// Ways in the trees that hang off the core: where a cell reaches the core, and where two cells of one tree meet. Cells
// are climbed in at most three tiles, pieces between them; a few microseconds at any size.
#pragma once

#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "planners/route_index/route_index.hpp"

namespace warren {

/// How two cells get to each other, as far as trees go.
struct TreeJoin {
  std::uint32_t start_steps;  ///< to the cell where both ways join, or to the core
  std::uint32_t goal_steps;
  LatticePlace start_core;  ///< where each way ends; the same cell where both join in a tree or at one cell of the core
  LatticePlace goal_core;

  bool in_tree() const { return start_core == goal_core; }
};

/// Looks at the index; any number of threads may.
class TreeRoutes {
 public:
  explicit TreeRoutes(const RouteIndex& index)
      : places_(index.places()), marks_(index.marks()), pieces_(index.pieces()) {}

  TreeJoin join(LatticePlace start, LatticePlace goal) const;
  /// Appends a cell and those after it on its way to the core, as many as steps.
  void append_climb(LatticePlace from, std::uint32_t steps, RawVector<LatticePlace>& cells) const;

 private:
  /// A cell on its way to the core: it stands in a piece, or in none where the core is in its tile.
  struct Climber {
    LatticePlace at;
    PieceId piece;
    Climb up;             // from `at`, in its tile
    std::uint32_t steps;  // from where it began to `at`
    std::uint32_t depth;  // of where it began, if there in a piece: steps to the core
  };
  Climber climber(LatticePlace from) const;
  void leave(Climber& climber, PieceId by) const;
  void climb_to_one_piece(Climber& start, Climber& goal) const;
  TreeJoin meet_in_tile(const Climber& start, const Climber& goal) const;

  const LatticePlaces& places_;
  CellMarks marks_;
  PieceForest pieces_;
};

}  // namespace warren
