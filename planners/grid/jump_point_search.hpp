// SPDX-License-Identifier: BSD-3-Clause
// Jump point search (Harabor, Grastien 2011) for octile maps on which a diagonal step needs both cells beside it free:
// the successors of a cell are the next cells where a shortest path may have to turn. Rows and columns are scanned 64
// cells at a time (block-based scanning, Harabor, Grastien 2014), columns in a transposed copy of the map.
//
// With this rule only straight moves have forced neighbours: moving along +x, the cell beside is a turn where it is
// free and the cell behind it is not; a diagonal move goes on until a straight scan from it finds a turn or the goal.
#pragma once

#include <bit>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "spatial/maps/free_cells.hpp"

namespace warren {

/// Refers to the cells, which must outlive it. Immutable; any number of threads may read.
class JumpPoints {
 public:
  /// O(cells). Throws Stopped.
  JumpPoints(const FreeCells& cells, const Execution& execution);

  /// Calls visit(w, length) for the jump points after v, which was reached from `parent` (no_vertex: it is the start).
  template <class Visit>
  void visit(VertexId v, VertexId parent, VertexId goal, const Visit& visit) const {
    for (unsigned rest = directions(v, parent); rest != 0; rest &= rest - 1) {
      const auto s = static_cast<unsigned>(std::countr_zero(rest));
      const auto [dx, dy] = cell_steps[s];
      const VertexId w = jump(v, dx, dy, goal);
      if (w != no_vertex) visit(w, distance(v, w));
    }
  }

  /// Jump points with the cells between them.
  RawVector<VertexId> with_steps(std::span<const VertexId> jump_points) const;

 private:
  /// A bit for each of cell_steps that a shortest path may take from v.
  unsigned directions(VertexId v, VertexId parent) const;
  VertexId jump(VertexId v, int dx, int dy, VertexId goal) const;
  VertexId jump_straight(VertexId v, int dx, int dy, VertexId goal) const;
  VertexId jump_diagonal(VertexId v, int dx, int dy, VertexId goal) const;
  double distance(VertexId v, VertexId w) const {
    const Cell a = rows_.cell(v);
    const Cell b = rows_.cell(w);
    const double dx = std::abs(static_cast<double>(a.x) - b.x);
    const double dy = std::abs(static_cast<double>(a.y) - b.y);
    return dx == dy ? std::numbers::sqrt2 * dx : dx + dy;  // along a row, a column or a diagonal
  }

  const FreeCells& rows_;
  FreeCells columns_;  // the same map, x and y exchanged
};

}  // namespace warren
