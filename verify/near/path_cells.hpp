// SPDX-License-Identifier: BSD-3-Clause
// The path in boxes, cell by cell: a second screen, for the walls that verify/near/path_screen calls doubtful because
// the path runs through their cells, though not near enough to them.
//
// A grid over the path's box, cells about as large as a wall: one bit a cell says whether the path passes, a rank over
// the bits leads to two boxes, of what runs rather level there and of what runs rather steep. A wall is clear where all
// boxes of the cells around it are as far as asked for. Walls at the same distance on both sides of the path are the
// rule in a maze; comparing each with the legs of each cell takes twice as long.
//
// Memory: a bit and half a byte a cell (at most 64 cells a leg), 32 bytes a cell that the path passes. A leg costs its
// length in cells, twice; a wall the rows of cells around it and the boxes in them. Conservative: a wall that comes
// nearer is never called clear (boxes are rounded outwards to floats; gaps are differences of doubles, whose rounding
// is monotone, squared and added as verify/exact/exact_segments does).
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "parallel/execution.hpp"
#include "verify/near/leg_boxes.hpp"

namespace warren {

/// Refers to the path, which must outlive it. After set_reach any number of threads may ask.
class PathBoxes {
 public:
  /// typical_wall: the extent of most walls, 0 if not known; it only decides on the cells.
  PathBoxes(const LegBoxes& legs, double typical_wall, const Execution& execution);

  /// From now on walls at `least` and at r (1 + 1e-12) are far enough. At most some cells, or the screen is slow.
  void set_reach(double least, double r);

  /// Is the wall in this box surely at the reach or farther, and not touched? Takes what it looks at, in words of
  /// cells, from the budget; false where that doesn't do.
  bool is_clear(const Box& wall, std::size_t& budget) const {
    const double u_first = (wall.min.x - origin_.x) * per_cell_ - grow_;
    const double u_last = (wall.max.x - origin_.x) * per_cell_ + grow_;
    const double v_first = (wall.min.y - origin_.y) * per_cell_ - grow_;
    const double v_last = (wall.max.y - origin_.y) * per_cell_ + grow_;
    if (u_last < 0.0 || v_last < 0.0 || u_first >= columns_ || v_first >= rows_) return true;
    const Window window{cell_number(std::max(u_first, 0.0)), cell_number(std::min(u_last, columns_ - 1.0)),
                        cell_number(std::max(v_first, 0.0)), cell_number(std::min(v_last, rows_ - 1.0))};
    const std::size_t words = window.words();
    if (words > budget) return false;
    budget -= words;
    return all_slots(
        window, [&](std::size_t slot) { return is_far(boxes_[slot].level, wall) && is_far(boxes_[slot].steep, wall); });
  }

 private:
  /// Rounded outwards.
  struct FloatBox {
    float min_x, min_y, max_x, max_y;
    void include(const FloatBox& box);
  };
  static FloatBox rounded(const Box& box);
  struct Passage {
    FloatBox level, steep;
  };
  /// Cells first .. last.
  struct Window {
    std::size_t column_first, column_last, row_first, row_last;
    std::size_t words() const { return (row_last - row_first + 1) * ((column_last - column_first) / word_columns + 1); }
  };

  static constexpr std::size_t word_columns = 57;  ///< what 64 bits hold from any bit of their first byte
  static constexpr double slack = 1e-6;            ///< cells; far above the rounding of cell numbers

  static std::size_t cell_number(double u) { return bounded_whole<std::size_t>(u); }
  std::size_t slot_of(std::size_t column, std::size_t row) const {
    const std::size_t byte = row * stride_ + column / 8;
    return rank_[byte] + ones_below(bits_[byte], column % 8);
  }
  /// Ones among the lowest `count` bits.
  static std::uint32_t ones_below(std::uint32_t bits, std::size_t count) {
    bits &= (1U << count) - 1;
    bits -= (bits >> 1) & 0x55U;
    bits = (bits & 0x33U) + ((bits >> 2) & 0x33U);
    return (bits + (bits >> 4)) & 0xfU;
  }
  bool is_far(const FloatBox& b, const Box& wall) const {
    const double dx = std::max(std::max(b.min_x - wall.max.x, wall.min.x - b.max_x), 0.0);
    const double dy = std::max(std::max(b.min_y - wall.max.y, wall.min.y - b.max_y), 0.0);
    const double gap_sq = dx * dx + dy * dy;
    return gap_sq >= near_sq_ && gap_sq > 0.0;
  }

  /// Does test(slot) hold for all marked cells of the window? Ends with the first for which it doesn't.
  template <class Test>
  bool all_slots(const Window& window, const Test& test) const {
    for (std::size_t row = window.row_first; row <= window.row_last; ++row) {
      for (std::size_t column = window.column_first; column <= window.column_last; column += word_columns) {
        std::uint64_t cells = 0;
        std::memcpy(&cells, &bits_[row * stride_ + column / 8], sizeof(cells));
        const std::size_t count = std::min(window.column_last - column + 1, word_columns);
        cells = (cells >> (column % 8)) & ((std::uint64_t{1} << count) - 1);
        for (; cells != 0; cells &= cells - 1) {
          if (!test(slot_of(column + as_whole<std::size_t>(std::countr_zero(cells)), row))) return false;
        }
      }
    }
    return true;
  }

  void choose_cell(double length, double typical_wall);
  /// visit(piece, box) for pieces that make up all legs; box: exactly around the piece, or wider.
  template <class Visit>
  void for_each_piece(const Execution& execution, const Visit& visit) const;
  template <class Visit>
  void for_each_cell(const Segment& piece, const Visit& visit) const;
  void mark_cells(const Execution& execution);
  void gather_boxes(const Execution& execution);

  std::span<const Vec2> path_;
  Box box_;
  Vec2 origin_;
  double cell_ = 1.0;
  double per_cell_ = 1.0;
  double grow_ = 0.0;     ///< cells
  double near_sq_ = 0.0;  ///< what is at this distance, squared, is far enough
  double columns_ = 0.0;
  double rows_ = 0.0;
  std::size_t stride_ = 0;         ///< bytes of a row
  RawVector<std::uint8_t> bits_;   ///< which cells the path passes
  RawVector<std::uint32_t> rank_;  ///< marked cells before a byte's
  RawVector<Passage> boxes_;       ///< one a marked cell
};

}  // namespace warren
