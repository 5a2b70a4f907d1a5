// SPDX-License-Identifier: BSD-3-Clause
// Which cells of a map a body may touch along a motion of a lattice (worlds/poses/motion_set.hpp), once for all places:
// rows of bits, so that a motion is looked up among a map's free cells instead of computed. A cell is left out only
// where it is proved that its closed square keeps the body's clearance all along the motion
// (worlds/poses/certified_motion.hpp); what comes within a sixteenth of a cell of that may be in. So what the stamps
// call free is free, and nothing hides between two poses or inside of the outline. Motions of one quarter of the
// headings are computed, in parallel; the other quarters are these turned, which squares allow exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "spatial/maps/free_cells.hpp"
#include "worlds/poses/motion_set.hpp"

namespace warren {

/// Immutable; any number of threads may ask. Keeps nothing of the motions.
class SweptStamps {
 public:
  /// outline: in cells, around the reference point, one point for a disc; reach: what is kept around it, in cells, a
  /// disc's radius too. Throws Stopped.
  SweptStamps(const MotionSet& motions, std::span<const Vec2> outline, double reach, const Execution& execution);

  /// Is the motion free of blocked cells, and within the map, where it begins in the middle of the cell?
  bool is_free(const FreeCells& map, Cell from, const LatticeMotion& motion) const;

  std::size_t bytes() const { return rows_.size() * sizeof(Row); }
  /// The cells of a motion's stamp as seen from the cell where its shape begins: for tests and pictures.
  std::vector<std::array<std::int32_t, 2>> cells(const LatticeMotion& motion) const;

 private:
  struct Row {
    std::int32_t x;
    std::int32_t y;
    std::uint64_t bits;  // bit i: cell x + i
  };
  struct Stamp {
    std::size_t first;  // of rows_
    std::size_t last;
    std::int32_t min_x, min_y, max_x, max_y;
  };
  void add(std::vector<std::array<std::int32_t, 2>> cells);
  const Stamp& of(const LatticeMotion& motion) const { return stamps_[4 * motion.shape + motion.quarter_turns]; }

  std::vector<Stamp> stamps_;  // of each shape, its quarter turns after each other
  std::vector<Row> rows_;
};

}  // namespace warren
