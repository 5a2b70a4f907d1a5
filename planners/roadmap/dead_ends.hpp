// SPDX-License-Identifier: BSD-3-Clause
// Which cells lead nowhere, and when a search need not look into them any more. A cell from which all ways to the ends
// of the question lead over one side, the way out, lies in a dead end: peeled cell by cell from its tip, so each cell
// of it has a way out of its own, and behind that lies all that can be reached without it. O(cells), two bytes a cell.
//
// A search may leave a milestone of a dead end unexpanded once all milestones that a motion over the way out can come
// to are settled, for nothing that it would lower lies elsewhere: a motion that leaves what lies behind passes the
// side, and no motion is longer than the radius. So labels and parents beyond the dead end are those of a search
// without it, and the path is the same. A search from both ends may do it where its own side has settled them (the
// argument of core/search/bidirectional_search.hpp holds: a vertex of the middle of a shortest path, in a dead end, is
// left by a vertex that is closed by neither side or was settled by both in one round, whose labels then are right). In
// a maze that leaves the corridor between start and goal and a cell or two of each branch: of uniform milestones among
// 4,000 x 4,000 cells an eighth is settled instead of nine tenths (docs/performance.md).
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/world.hpp"
#include "core/plane/cell_sides.hpp"
#include "parallel/execution.hpp"
#include "spatial/points/neighbours.hpp"

namespace warren {

/// A world of the plane that knows which sides of unit cells no motion crosses.
/// w.cell_sides(most_cells, execution)  nothing where that can't be said, or where the cells are more
template <class W>
concept CellSideWorld = World<W> && requires(const W& w, const Execution& execution) {
  { w.cell_sides(std::size_t{}, execution) } -> std::same_as<CellSides>;
};

/// Immutable; any number of threads may ask.
class DeadEnds {
 public:
  DeadEnds() = default;  ///< none
  /// `kept`: the cells of the ends. Throws Stopped.
  DeadEnds(CellSides cells, std::span<const std::size_t> kept, const Execution& execution);

  bool empty() const { return cells_.open.empty(); }
  const CellSides& cells() const { return cells_; }
  std::uint8_t open_sides(std::size_t cell) const { return cells_.open[cell] & CellSides::all; }
  /// The side of the cell over which all ways lead; 0 outside of dead ends.
  std::uint8_t way_out(std::size_t cell) const { return static_cast<std::uint8_t>(cells_.open[cell] >> 4U); }

 private:
  CellSides cells_;  // way out in the upper half of the byte
};

/// What one search knows of them: belongs to one thread, or to one side of a search. Refers to all that it is given.
class DeadEndSeals {
 public:
  /// The milestones of the search, and the longest of its motions. Throws Stopped: four bytes a cell.
  DeadEndSeals(const DeadEnds& dead_ends, const Neighbours<2>& milestones, double radius, const Execution& execution);

  /// May milestone v stay unexpanded? labels: of a search, negative where it has settled the vertex. O(1) while the
  /// milestone that was the reason to say no is not settled; else O(milestones near the way out), a few times a cell.
  bool holds(VertexId v, std::span<const double> labels) {
    const std::size_t cell = dead_ends_->cells().cell_of(milestones_->point(v));
    return dead_ends_->way_out(cell) != 0 && is_sealed(cell, labels);
  }

 private:
  static constexpr std::size_t most_near = 64;
  static constexpr VertexId nobody = 0xffffffff;  // that is known yet
  static constexpr VertexId sealed = 0xfffffffe;

  bool is_sealed(std::size_t cell, std::span<const double> labels);
  bool gather_outside(std::size_t cell, const Segment& way_out);
  VertexId unsettled_outside(const Segment& way_out, std::span<const double> labels) const;

  const DeadEnds* dead_ends_;
  const Neighbours<2>* milestones_;
  double radius_;
  RawVector<VertexId> waits_for_;     // of each cell: an unsettled milestone beyond the way out, nobody or sealed
  std::vector<std::size_t> outside_;  // scratch: cells that a motion over the way out may come to
};

}  // namespace warren
