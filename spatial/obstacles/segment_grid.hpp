// SPDX-License-Identifier: BSD-3-Clause
// A uniform grid that lists, for each square cell, the segments that meet the closed cell (and a few that only come
// near it): what a walk from cell to cell along a line needs to meet every segment on the line. About as many cells as
// segments; larger ones where long segments would be listed too often. Build O(segments + listings); a listing is 4
// bytes, a cell 4. Far-away single segments make all cells large: a world that is crowded in one spot is served slowly,
// never wrongly.
#pragma once

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
  void lay_out(const Box& box, std::size_t segments, double scale);
  template <class Visit>
  void for_each_cell_of(const Segment& s, const Visit& visit) const;
  std::uint32_t clamped(double at, std::uint32_t count) const {
    return bounded_whole<std::uint32_t>(at, 0.0, count - 1.0);
  }

  Vec2 origin_;
  double cell_ = 1.0;
  double slack_ = 0.0;  // by which cells are widened when segments are listed: far above any rounding
  std::uint32_t cols_ = 0;
  std::uint32_t rows_ = 0;
  RawVector<std::uint64_t> offsets_;
  RawVector<std::uint32_t> segments_;
};

}  // namespace warren
