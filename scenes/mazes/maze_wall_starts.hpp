// SPDX-License-Identifier: BSD-3-Clause
// Walls of a maze from its bits. Cells are cut into runs of 65536 in storage order (column by column); one pass counts
// the walls that each run owns, sums give its place in the output, a second pass writes. Unit walls are written without
// branches through a small buffer that stays in the first cache: about 1.5 ns a wall, bound by the memory written to.
// For whoever makes all walls (maze_walls.cpp), and who makes some columns after the other (maze_walls.cpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/plane/wall_set.hpp"
#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren::maze {

inline constexpr std::size_t wall_grain = std::size_t{1} << 16;
inline constexpr std::uint32_t largest_float_side = (1U << 23U) - 1;  // side + 0.5 is a float up to here

/// Are the walls of a maze of this size floats in a file?
inline bool walls_are_floats(std::uint32_t rows, std::uint32_t cols) {
  return std::max(rows, cols) <= largest_float_side;
}

/// Makes walls from grid lines: line k is the coordinate k + 0.5.
template <class Wall>
struct GridLines;
template <class T>
struct GridLines<WallOf<T>> {
  static T at(std::uint32_t line) { return static_cast<T>(line) + T{0.5}; }
  static WallOf<T> upright(std::uint32_t x, std::uint32_t y, std::uint32_t length) {
    return {at(x), at(y), at(x), at(y + length)};
  }
  static WallOf<T> level(std::uint32_t x, std::uint32_t y, std::uint32_t length) {
    return {at(x), at(y), at(x + length), at(y)};
  }
};
template <>
struct GridLines<PackedWall> {
  static std::int32_t steps(std::uint32_t units) { return static_cast<std::int32_t>(units) * PackedWall::per_unit; }
  static std::int32_t at(std::uint32_t line) { return steps(line) + PackedWall::per_unit / 2; }
  static PackedWall upright(std::uint32_t x, std::uint32_t y, std::uint32_t length) {
    return PackedWall::upright(at(x), at(y), steps(length));
  }
  static PackedWall level(std::uint32_t x, std::uint32_t y, std::uint32_t length) {
    return PackedWall::level(at(x), at(y), steps(length));
  }
};

/// Where columns of cells lie in a maze of which they are a part.
struct ColumnsOfMaze {
  std::uint32_t first;                    ///< column 0 of the cells in the maze
  std::uint32_t all;                      ///< columns of the maze
  const std::uint32_t* beyond = nullptr;  ///< by row: cells that an upper wall goes on along, right of the cells
};

/// Cells row_first .. row_last - 1 of one column.
struct Run {
  std::uint32_t col, row_first, row_last;
};

/// Calls f(Run) for the columns that cells r.first .. r.last - 1, numbered column by column, lie in.
template <class F>
void for_runs(const MazeCells& cells, Range r, F&& f) {
  const std::size_t rows = cells.rows();
  for (std::size_t cell = r.first; cell < r.last;) {
    const std::size_t col = cell / rows;
    const std::size_t row_last = std::min(rows, r.last - col * rows);
    f(Run{static_cast<std::uint32_t>(col), static_cast<std::uint32_t>(cell - col * rows),
          static_cast<std::uint32_t>(row_last)});
    cell = col * rows + row_last;
  }
}

/// The interior walls that start at a cell, as bits of MazeCells: in the unit variant the walls that it owns.
class WallStarts {
 public:
  WallStarts(const MazeCells& cells, bool merged) : WallStarts(cells, merged, {0, cells.cols()}) {}
  /// Of columns that are a part of a maze, but for its first the left one of them is only looked at.
  WallStarts(const MazeCells& cells, bool merged, ColumnsOfMaze columns)
      : cells_(cells), bytes_(cells.bytes().data()), columns_(columns), merged_(merged) {}

  /// Which bits of this column's cells are interior walls (upper walls of the top row apart).
  unsigned interior_of(std::uint32_t col) const {
    return columns_.first + col + 1 < columns_.all ? MazeCells::all_walls : MazeCells::upper_wall;
  }
  unsigned at(std::uint32_t col, std::uint32_t row) const {
    const std::size_t i = cells_.index(col, row);
    unsigned bits = bytes_[i] & interior_of(col);
    if (row + 1 == cells_.rows()) bits &= ~unsigned{MazeCells::upper_wall};
    if (!merged_) return bits;
    if (row > 0) bits &= ~(bytes_[i - 1] & unsigned{MazeCells::right_wall});
    if (col > 0) bits &= ~(bytes_[i - cells_.stride()] & unsigned{MazeCells::upper_wall});
    return bits;
  }
  /// Cells that the right wall of (col, row) runs along, upwards.
  std::uint32_t rows_along(std::uint32_t col, std::uint32_t row) const {
    std::uint32_t top = row + 1;
    while (merged_ && top < cells_.rows() && cells_.wall_right(col, top)) ++top;
    return top - row;
  }
  /// Cells that the upper wall of (col, row) runs along, to the right.
  std::uint32_t cols_along(std::uint32_t col, std::uint32_t row) const {
    std::uint32_t right = col + 1;
    while (merged_ && right < cells_.cols() && cells_.wall_above(right, row)) ++right;
    const bool goes_on = merged_ && right == cells_.cols() && columns_.beyond != nullptr;
    return right - col + (goes_on ? columns_.beyond[row] : 0);
  }
  /// Of a column in the maze.
  std::uint32_t col_of(std::uint32_t col) const { return columns_.first + col; }
  bool merged() const { return merged_; }
  /// Walls that start in a run.
  std::size_t count(const Run& run) const { return merged_ ? count_merged(run) : count_units(run); }

 private:
  std::size_t count_merged(const Run& run) const {
    std::size_t n = 0;
    for (std::uint32_t row = run.row_first; row < run.row_last; ++row) {
      const unsigned bits = at(run.col, row);
      n += (bits & 1U) + (bits >> 1U);
    }
    return n;
  }
  std::size_t count_units(const Run& run) const {
    const std::uint8_t* bytes = bytes_ + cells_.index(run.col, 0);
    const unsigned interior = interior_of(run.col);
    std::uint32_t n = 0;  // a run is no longer than the grain
    for (std::uint32_t row = run.row_first; row < run.row_last; ++row) {
      const unsigned bits = bytes[row] & interior;
      n += (bits & 1U) + (bits >> 1U);
    }
    if (run.row_last == cells_.rows()) n -= bytes[cells_.rows() - 1] >> 1U;  // the outline's
    return n;
  }

  const MazeCells& cells_;
  const std::uint8_t* bytes_;
  ColumnsOfMaze columns_;
  bool merged_;
};

/// Collects the walls of one chunk and hands them on in blocks.
template <class Wall>
class WallWriter {
 public:
  explicit WallWriter(Wall* out) : out_(out) {}
  ~WallWriter() { std::copy_n(block_.data(), used_, out_); }
  WallWriter(const WallWriter&) = delete;
  WallWriter& operator=(const WallWriter&) = delete;

  void make_room() {
    if (used_ + 2 <= block_.size()) return;
    out_ = std::copy_n(block_.data(), used_, out_);
    used_ = 0;
  }
  /// Keeps the wall if `keep` is 1, forgets it if 0.
  void add(const Wall& wall, unsigned keep) {
    block_[used_] = wall;
    used_ += keep;
  }

 private:
  Wall* out_;
  std::array<Wall, 512> block_;
  std::size_t used_ = 0;
};

template <class Wall, class Writer>
void write_units(const MazeCells& cells, const WallStarts& starts, const Run& run, Writer& writer) {
  const std::uint8_t* bytes = cells.bytes().data() + cells.index(run.col, 0);
  using Lines = GridLines<Wall>;
  const unsigned interior = starts.interior_of(run.col);
  const std::uint32_t col = starts.col_of(run.col);
  for (std::uint32_t row = run.row_first; row < run.row_last; ++row) {
    const unsigned bits = bytes[row] & interior & (row + 1 == cells.rows() ? 1U : 3U);
    writer.make_room();
    writer.add(Lines::upright(col + 1, row, 1), bits & 1U);
    writer.add(Lines::level(col, row + 1, 1), bits >> 1U);
  }
}

template <class Wall>
void write_merged(const WallStarts& starts, const Run& run, WallWriter<Wall>& writer) {
  using Lines = GridLines<Wall>;
  const std::uint32_t col = starts.col_of(run.col);
  for (std::uint32_t row = run.row_first; row < run.row_last; ++row) {
    const unsigned bits = starts.at(run.col, row);
    writer.make_room();
    if ((bits & MazeCells::right_wall) != 0) {
      writer.add(Lines::upright(col + 1, row, starts.rows_along(run.col, row)), 1);
    }
    if ((bits & MazeCells::upper_wall) != 0) {
      writer.add(Lines::level(col, row + 1, starts.cols_along(run.col, row)), 1);
    }
  }
}

template <class Wall>
std::array<Wall, 4> outline(std::uint32_t rows, std::uint32_t cols) {
  using Lines = GridLines<Wall>;
  return {Lines::level(0, 0, cols), Lines::level(0, rows, cols), Lines::upright(0, 1, rows - 1),
          Lines::upright(cols, 0, rows - 1)};
}

/// Where the walls of each chunk of these cells stand, behind the first `before`; and the end.
inline std::vector<std::size_t> places_of(const MazeCells& cells, const WallStarts& starts, Range some,
                                          std::size_t before, const Execution& execution) {
  std::vector<std::size_t> places(chunk_count(some.size(), wall_grain) + 1, 0);
  for_chunks(some.size(), wall_grain, {execution.threads, execution.deadline}, [&](Range r) {
    std::size_t n = 0;
    for_runs(cells, {some.first + r.first, some.first + r.last}, [&](const Run& run) { n += starts.count(run); });
    places[r.first / wall_grain + 1] = n;
  });
  places[0] = before;
  for (std::size_t c = 1; c < places.size(); ++c) places[c] += places[c - 1];
  return places;
}

/// Writes the walls of these cells, whose chunks' places places_of() has told.
template <class Wall>
void write_walls(const MazeCells& cells, const WallStarts& starts, Range some, std::span<const std::size_t> places,
                 Wall* walls, const Execution& execution) {
  for_chunks(some.size(), wall_grain, execution, [&](Range r) {
    WallWriter<Wall> writer(walls + places[r.first / wall_grain]);
    for_runs(cells, {some.first + r.first, some.first + r.last}, [&](const Run& run) {
      starts.merged() ? write_merged<Wall>(starts, run, writer) : write_units<Wall>(cells, starts, run, writer);
    });
  });
}

}  // namespace warren::maze
