// SPDX-License-Identifier: BSD-3-Clause
// Points at which a path passes the doors of vertical cells: the middles, as close as doubles come to them.
//
// A door has one end in the input (its corner) and one that would have to be computed. The middle is rounded, asked
// exactly whether it still lies between the two, and replaced by the corner where it does not (doors of a few units in
// the last place): the corner belongs to both cells, so legs between the points of a cell never leave it, whatever the
// rounding. Such a path may touch the corner.
#pragma once

#include <optional>
#include <vector>

#include "core/base/types.hpp"
#include "parallel/execution.hpp"
#include "planners/cells/cell_decomposition.hpp"

namespace warren {

/// Immutable; refers to the cells. Copies nothing else.
class DoorPoints {
 public:
  /// O(doors), on all threads.
  DoorPoints(const CellDecomposition& cells, const Execution& execution);

  Vec2 middle(std::uint32_t door) const { return middles_[door]; }
  /// Where the leg between the middles of two doors of one cell should bend: doors below and above one corner are
  /// joined around it, a little inside the cell. None: the leg is straight, or there is no room.
  std::optional<Vec2> bend(std::uint32_t from, std::uint32_t to) const;
  /// Length of that leg.
  double leg_length(std::uint32_t from, std::uint32_t to) const;

 private:
  Vec2 middle_of(std::uint32_t door) const;
  bool strictly_inside(const VerticalCell& cell, Vec2 p) const;

  const CellDecomposition& cells_;
  std::vector<Vec2> middles_;
};

}  // namespace warren
