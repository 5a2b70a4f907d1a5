// SPDX-License-Identifier: BSD-3-Clause
// Ways in the trees that hang off the core: where a cell reaches the core, and where two cells of one tree meet. Cells
// are climbed in at most three tiles, pieces between them; two or three microseconds at any size.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/run/execution.hpp"
#include "planners/lengths/route_index.hpp"

namespace warren {

/// Part of a way to the core, and where its cells go: from `from` to `to` = `steps` steps on, the first one to `first`,
/// each further one `direction`, 1 or -1, beside the one before it.
struct ClimbLeg {
  LatticePlace from;
  LatticePlace to;
  std::uint32_t steps;
  int direction;
  CellId* first;
};

/// Writes the cells of all legs but for the one that each leads to, from marks alone: some ns a cell, on all threads.
/// Throws InputError where marks lead elsewhere, after as many steps as the legs have; Stopped.
void write_climbs(const RouteIndex& index, std::span<const ClimbLeg> legs, const Execution& execution);

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
      : index_(index), places_(index.places()), marks_(index.marks()), pieces_(index.pieces()) {}

  TreeJoin join(LatticePlace start, LatticePlace goal) const;
  /// Adds the legs of a climb to its end, cut at doors, so that many threads may write them. Throws InputError.
  void cut(ClimbLeg climb, std::vector<ClimbLeg>& legs) const;

 private:
  /// A cell on its way to the core: it stands in a piece, or in none where the core is in its tile.
  struct Climber {
    LatticePlace at;
    Climb climb;          // from `at`, in its tile
    std::uint32_t depth;  // of where it began, if there in a piece: steps to the core
    PieceId piece;
    PieceId head = no_piece;  // of its path
    PieceId up = no_piece;    // where its path leads to
    PieceId left = no_piece;  // the last piece that it has left
    std::uint32_t steps = 0;  // from where it began to `at`
  };
  Climber climber(LatticePlace from, const Climb& climb) const;
  void enter(Climber& climber, PieceId piece) const;
  void climb_to_one_piece(Climber& start, Climber& goal) const;
  void step_out(Climber& climber) const;
  TreeJoin meet_in_piece(const Climber& start, const Climber& goal) const;
  TreeJoin meet_at_core(Climber& start, Climber& goal) const;

  const RouteIndex& index_;
  const LatticePlaces& places_;
  CellMarks marks_;
  PieceForest pieces_;
};

}  // namespace warren
