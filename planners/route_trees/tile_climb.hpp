// SPDX-License-Identifier: BSD-3-Clause
// A climb towards the core, step by step, within one tile. A step waits for the marks that the one before it led to,
// some fifteen cycles, and for nothing else: no branch depends on where the way turns.
#pragma once

#include <cstdint>

#include "planners/route_trees/cell_marks.hpp"

namespace warren {

/// Looks at the marks of one tile.
class TileClimb {
 public:
  TileClimb(CellMarks marks, LatticePlace from)
      : first_(from - from % LatticePlaces::tile_places),
        words_(marks.tile(LatticePlaces::tile_of(from))),
        at_(spread(from % LatticePlaces::tile_places)) {}

  /// False where the way ends: at the core, or where it would leave the tile.
  bool step() {
    const std::uint64_t* const row = words_ + std::size_t{at_ >> row_shift} * mark_word::count;
    if ((row[mark_word::core] >> (at_ & col_bits) & 1U) != 0) return false;
    const std::uint32_t next = at_ + motion(row);
    if ((next & guards) != 0) return false;
    at_ = next;
    return true;
  }
  LatticePlace place() const { return first_ + ((at_ >> row_shift) << 6U | (at_ & col_bits)); }
  bool at_core() const {
    return (words_[std::size_t{at_ >> row_shift} * mark_word::count + mark_word::core] >> (at_ & col_bits) & 1U) != 0;
  }

 private:
  // Column in bits 0 to 5, row in bits 7 to 12: a motion over the border sets a bit between or above.
  static constexpr std::uint32_t col_bits = 63;
  static constexpr unsigned row_shift = 7;
  static constexpr std::uint32_t guards = ~(col_bits | col_bits << row_shift);
  static_assert(LatticePlaces::side == col_bits + 1);

  static std::uint32_t spread(std::uint32_t in_tile) { return in_tile >> 6U << row_shift | (in_tile & col_bits); }
  /// Right 1, up 128, left -1, down -128.
  std::uint32_t motion(const std::uint64_t* row) const {
    const auto low = static_cast<std::uint32_t>(row[mark_word::low] >> (at_ & col_bits)) & 1U;
    const auto high = static_cast<std::uint32_t>(row[mark_word::high] >> (at_ & col_bits)) & 1U;
    return (1U - 2U * high) << (row_shift * low);
  }

  LatticePlace first_;
  const std::uint64_t* words_;
  std::uint32_t at_;
};

}  // namespace warren
