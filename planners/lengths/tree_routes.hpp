// SPDX-License-Identifier: BSD-3-Clause
// Ways in the trees that hang off the core: where a cell reaches the core, and where two cells of one tree meet. Cells
// are climbed in at most three tiles, pieces between them; two or three microseconds at any size.
//
// What such ways are written by: a walk over the lattice by its marks, cell after cell, that writes where it is. Each
// step waits for the marks that the one before it led to, so some walks are made side by side.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "planners/lengths/route_index.hpp"

namespace warren {

/// A way that a walk makes, and where its cells go: from `from` to `to` = `steps` steps on, the first one to `first`,
/// each further one `direction`, 1 or -1, beside the one before it.
struct MarkedWay {
  LatticePlace from;
  LatticePlace to;
  std::uint32_t steps;
  int direction;
  CellId* first;
};

/// Where a walk stands, and where its cells go.
class MarkWalk : protected WalkedCells {
 public:
  explicit MarkWalk(const RouteIndex& index)
      : index_(index),
        marks_(index.marks()),
        next_{1, index.places().size().cols, ~CellId{0}, ~index.places().size().cols + 1} {}

  bool goes() const { return left_ > 0; }
  /// Asks the memory for what a walk from there looks at.
  void prefetch(LatticePlace p) const { marks_.prefetch_tile(LatticePlaces::tile_of(p)); }

 protected:
  void begin(const MarkedWay& way) {
    left_ = way.steps;
    cell_ = index_.places().cell_of(way.from);
    out_ = way.first;
    direction_ = way.direction;
    to_ = way.to;
    stand_at(way.from);
  }
  void write() const { *out_ = cell_; }
  /// False where that leaves the lattice.
  bool go(unsigned way) {
    --left_;
    cell_ += next_[way];
    out_ += direction_;
    const std::uint32_t next = at_ + motion[way];
    if ((next & guards) != 0) [[unlikely]]
      return cross(way);
    at_ = next;
    return true;
  }
  LatticePlace place() const { return tile_ * LatticePlaces::tile_places + in_tile(at_); }
  std::uint32_t col() const { return at_ & col_bits; }
  bool is_lowest_row() const { return at_ <= col_bits; }
  /// Its marks.
  const std::uint64_t* row() const { return words_ + std::size_t{at_ >> row_shift} * mark_word::count; }
  /// Has it ended beside where it leads to?
  bool is_astray() const { return left_ == 0 && place() != to_; }

  const RouteIndex& index_;
  const CellMarks marks_;
  std::uint32_t left_ = 0;  // steps
  int direction_ = 1;

 private:
  static constexpr std::array<std::uint32_t, 4> motion{1, 1U << row_shift, ~std::uint32_t{0}, ~(1U << row_shift) + 1};

  bool cross(unsigned way) {
    const LatticePlace next = index_.places().step(place(), way);
    if (next >= index_.places().place_count()) return false;
    prefetch(next);
    stand_at(next);
    return true;
  }
  void stand_at(LatticePlace p) {
    tile_ = LatticePlaces::tile_of(p);
    index_.look_at_tile(p);
    words_ = marks_.tile(tile_);
    at_ = at(p);
  }

  const std::array<CellId, 4> next_;  // what a motion adds to a cell, modulo 2^32
  CellId cell_ = 0;
  CellId* out_ = nullptr;
  LatticePlace to_ = 0;
  std::uint32_t tile_ = 0;
  std::uint32_t at_ = 0;  // in it
  const std::uint64_t* words_ = nullptr;
};

/// Makes walks of all ways on all threads, `grain` ways a chunk, four side by side. Walk: a MarkWalk with begin(way)
/// and step(); ways are MarkedWays. Throws what these throw, and Stopped.
template <class Walk, class Way>
void walk_all(const RouteIndex& index, std::span<const Way> ways, std::size_t grain, const Execution& execution) {
  constexpr std::size_t ahead = 4;  // ways whose first tile is asked for before their turn
  for_chunks(ways.size(), grain, execution, [&](Range r) {
    std::array<Walk, 4> walks{Walk(index), Walk(index), Walk(index), Walk(index)};
    std::size_t next = r.first;
    for (bool goes = true; goes;) {
      goes = false;
      for (Walk& walk : walks) {
        if (walk.goes()) {
          walk.step();
        } else if (next < r.last) {
          walk.begin(ways[next++]);
          if (next + ahead < r.last) walk.prefetch(ways[next + ahead].from);
        } else {
          continue;
        }
        goes = true;
      }
    }
  });
}

/// Writes the cells of all legs, parts of ways to the core, but for the one that each leads to, from marks alone: some
/// ns a cell, on all threads. Throws InputError where marks lead elsewhere, after as many steps as the legs have;
/// Stopped.
void write_climbs(const RouteIndex& index, std::span<const MarkedWay> legs, const Execution& execution);

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
  explicit TreeRoutes(const RouteIndex& index) : index_(index), pieces_(index.pieces()) {}

  TreeJoin join(LatticePlace start, LatticePlace goal) const;
  /// Adds the legs of a climb to its end, cut at doors, so that many threads may write them. Throws InputError.
  void cut(MarkedWay climb, std::vector<MarkedWay>& legs) const;

 private:
  /// A cell on its way to the core: it stands in a piece, or in none where the core is in its tile.
  struct Climber {
    LatticePlace at;
    Climb climb;          // from where it began, in its tile
    std::uint32_t depth;  // of where it began, if there in a piece: steps to the core
    PieceId piece;
    PieceId left = no_piece;  // the last piece that it has left
    std::uint32_t steps = 0;  // from where it began to `at`
  };
  Climber climber(LatticePlace from, const Climb& climb) const;
  void climb_to_one_piece(Climber& start, Climber& goal) const;
  void step_out(Climber& climber) const;
  Climb rest_of(const Climber& climber) const;

  const RouteIndex& index_;
  PieceForest pieces_;
};

}  // namespace warren
