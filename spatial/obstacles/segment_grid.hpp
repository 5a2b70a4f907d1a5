// SPDX-License-Identifier: BSD-3-Clause
// A uniform grid that lists, for each square cell, the segments that meet the closed cell (and a few that only come
// near it): what a walk from cell to cell along a line needs to meet every segment on the line. About as many cells as
// segments; larger ones where long segments would be listed too often. Build O(segments + listings); a listing is 4
// bytes, a cell 8. Far-away single segments make all cells large: a world that is crowded in one spot is served slowly,
// never wrongly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// Immutable; any number of threads may read. Cell (col, row) is the closed box between the lines x_line(col),
/// x_line(col + 1), y_line(row) and y_line(row + 1), exactly.
class SegmentGrid {
 public:
  struct Cell {
    std::uint32_t col;
    std::uint32_t row;
  };

  SegmentGrid() = default;
  /// Fewer than 2^32 segments, finite. The outermost lines keep clear of all segments. Throws Stopped.
  SegmentGrid(std::span<const Segment> segments, const Execution& execution);

  std::uint32_t cols() const { return cols_; }
  std::uint32_t rows() const { return rows_; }
  std::size_t cell_count() const { return std::size_t{cols_} * rows_; }
  double x_line(std::uint32_t i) const { return origin_.x + i * cell_; }
  double y_line(std::uint32_t i) const { return origin_.y + i * cell_; }
  Box box() const { return {origin_, {x_line(cols_), y_line(rows_)}}; }
  Box box_of_cell(Cell c) const { return {{x_line(c.col), y_line(c.row)}, {x_line(c.col + 1), y_line(c.row + 1)}}; }
  /// The cell with x_line(col) <= p.x < x_line(col + 1), the same in y. p lies in box().
  Cell cell_of(Vec2 p) const;
  std::size_t index(Cell c) const { return std::size_t{c.row} * cols_ + c.col; }
  /// Numbers of the segments that may meet the cell: all that do, ascending.
  std::span<const std::uint32_t> in_cell(Cell c) const {
    const std::size_t i = index(c);
    return {segments_.data() + offsets_[i], segments_.data() + offsets_[i + 1]};
  }
  /// Calls visit(cell) for the cells that the segment comes as near to as `within` along both axes, and for some more,
  /// until it returns false; whether it never did. What lies beyond the grid counts to its outermost cells.
  template <class Visit>
  bool for_each_cell_near(const Segment& s, double within, const Visit& visit) const {
    const Box box = box_of(s);
    const double dy = s.b.y - s.a.y;
    const std::uint32_t last_row = row_at(box.max.y + within);
    for (std::uint32_t row = row_at(box.min.y - within); row <= last_row; ++row) {
      double low = box.min.x;
      double high = box.max.x;
      if (dy != 0.0) {  // the part of the segment in this row, so much wider
        const double at_bottom = (std::clamp(y_line(row) - within, box.min.y, box.max.y) - s.a.y) / dy;
        const double at_top = (std::clamp(y_line(row + 1) + within, box.min.y, box.max.y) - s.a.y) / dy;
        const double x1 = s.a.x + at_bottom * (s.b.x - s.a.x);
        const double x2 = s.a.x + at_top * (s.b.x - s.a.x);
        low = std::max(low, std::min(x1, x2));
        high = std::min(high, std::max(x1, x2));
      }
      const std::uint32_t last_col = col_at(high + within);
      for (std::uint32_t col = col_at(low - within); col <= last_col; ++col) {
        if (!visit(Cell{col, row})) return false;
      }
    }
    return true;
  }
  /// Calls visit(i, j) for segments i < j that are listed in one cell and whose boxes meet, some pairs more than once,
  /// until it returns false. segments: those that the grid is made of. Throws Stopped.
  template <class Visit>
  void for_each_pair(std::span<const Segment> segments, const Execution& execution, const Visit& visit) const {
    constexpr std::size_t looks_per_poll = 1 << 12;  // exact predicates can take microseconds
    std::size_t looks = 0;
    for (std::size_t cell = 0; cell < cell_count(); ++cell) {
      if (cell % (1 << 16) == 0) execution.check();
      for (std::uint64_t k = offsets_[cell]; k < offsets_[cell + 1]; ++k) {
        const Box box = box_of(segments[segments_[k]]);
        for (std::uint64_t l = k + 1; l < offsets_[cell + 1]; ++l) {
          if (++looks % looks_per_poll == 0) execution.check();
          if (box.meets(box_of(segments[segments_[l]])) && !visit(segments_[k], segments_[l])) return;
        }
      }
    }
  }

 private:
  /// Sets origin, cell size and counts for so many segments in the box.
  void lay_out(const Box& around, std::size_t segments, double scale);
  std::uint32_t clamped(double at, std::uint32_t count) const {
    return bounded_whole<std::uint32_t>(at, 0.0, count - 1.0);
  }
  std::uint32_t col_at(double x) const { return clamped((x - origin_.x) / cell_, cols_); }
  std::uint32_t row_at(double y) const { return clamped((y - origin_.y) / cell_, rows_); }

  Vec2 origin_;
  double cell_ = 1.0;
  double slack_ = 0.0;  // by which cells are widened when segments are listed: far above any rounding
  std::uint32_t cols_ = 0;
  std::uint32_t rows_ = 0;
  RawVector<std::uint64_t> offsets_;
  RawVector<std::uint32_t> segments_;
};

}  // namespace warren
