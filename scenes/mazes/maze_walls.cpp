// SPDX-License-Identifier: BSD-3-Clause
// Walls of a maze from its bits. Cells are cut into runs of 65536 in storage order (column by column); one pass counts
// the walls that each run owns, sums give its place in the output, a second pass writes. Unit walls are written without
// branches through a small buffer that stays in the first cache: about 1.5 ns a wall, bound by the memory written to.
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren {
namespace {

constexpr std::size_t wall_grain = std::size_t{1} << 16;
constexpr std::uint32_t largest_float_side = (1U << 23U) - 1;  // side + 0.5 is a float up to here

bool as_floats(const MazeCells& cells) { return std::max(cells.rows(), cells.cols()) <= largest_float_side; }

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
  WallStarts(const MazeCells& cells, bool merged) : cells_(cells), bytes_(cells.bytes().data()), merged_(merged) {}

  /// Which bits of this column's cells are interior walls (upper walls of the top row apart).
  unsigned interior_of(std::uint32_t col) const {
    return col + 1 < cells_.cols() ? MazeCells::all_walls : MazeCells::upper_wall;
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
    return right - col;
  }
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
  bool merged_;
};

/// Collects the walls of one chunk and hands them on in blocks.
template <class T>
class WallWriter {
 public:
  explicit WallWriter(WallOf<T>* out) : out_(out) {}
  ~WallWriter() { std::copy_n(block_.data(), used_, out_); }
  WallWriter(const WallWriter&) = delete;
  WallWriter& operator=(const WallWriter&) = delete;

  void make_room() {
    if (used_ + 2 <= block_.size()) return;
    out_ = std::copy_n(block_.data(), used_, out_);
    used_ = 0;
  }
  /// Keeps the wall if `keep` is 1, forgets it if 0.
  void add(T x1, T y1, T x2, T y2, unsigned keep) {
    block_[used_] = {x1, y1, x2, y2};
    used_ += keep;
  }

 private:
  WallOf<T>* out_;
  std::array<WallOf<T>, 512> block_;
  std::size_t used_ = 0;
};

/// Takes the walls of one chunk as WallWriter does, and looks whether those that stand are they.
template <class T>
class WallComparer {
 public:
  explicit WallComparer(const WallOf<T>* walls) : at_(walls) {}
  void make_room() const {}
  void add(T x1, T y1, T x2, T y2, unsigned keep) {
    if (keep == 0) return;
    same_ = same_ && *at_ == WallOf<T>{x1, y1, x2, y2};
    ++at_;
  }
  bool same() const { return same_; }

 private:
  const WallOf<T>* at_;
  bool same_ = true;
};

template <class T, class Writer>
void write_units(const MazeCells& cells, const WallStarts& starts, const Run& run, Writer& writer) {
  const std::uint8_t* bytes = cells.bytes().data() + cells.index(run.col, 0);
  const unsigned interior = starts.interior_of(run.col);
  const T left = static_cast<T>(run.col) + T{0.5};
  const T right = left + T{1};
  for (std::uint32_t row = run.row_first; row < run.row_last; ++row) {
    const unsigned bits = bytes[row] & interior & (row + 1 == cells.rows() ? 1U : 3U);
    const T low = static_cast<T>(row) + T{0.5};
    const T high = low + T{1};
    writer.make_room();
    writer.add(right, low, right, high, bits & 1U);
    writer.add(left, high, right, high, bits >> 1U);
  }
}

template <class T>
void write_merged(const WallStarts& starts, const Run& run, WallWriter<T>& writer) {
  for (std::uint32_t row = run.row_first; row < run.row_last; ++row) {
    const unsigned bits = starts.at(run.col, row);
    const T left = static_cast<T>(run.col) + T{0.5};
    const T low = static_cast<T>(row) + T{0.5};
    const T high = low + T{1};
    writer.make_room();
    if ((bits & MazeCells::right_wall) != 0) {
      writer.add(left + T{1}, low, left + T{1}, low + static_cast<T>(starts.rows_along(run.col, row)), 1);
    }
    if ((bits & MazeCells::upper_wall) != 0) {
      writer.add(left, high, left + static_cast<T>(starts.cols_along(run.col, row)), high, 1);
    }
  }
}

template <class T>
std::array<WallOf<T>, 4> outline(const MazeCells& cells) {
  const T right = static_cast<T>(cells.cols()) + T{0.5};
  const T top = static_cast<T>(cells.rows()) + T{0.5};
  constexpr T low = 0.5;
  return {{{low, low, right, low}, {low, top, right, top}, {low, low + 1, low, top}, {right, low, right, top - 1}}};
}

/// Where the walls of each chunk of cells stand, behind the outline's four; and the end.
std::vector<std::size_t> places_of(const MazeCells& cells, const WallStarts& starts, const Execution& execution) {
  std::vector<std::size_t> places(chunk_count(cells.cell_count(), wall_grain) + 1, 0);
  for_chunks(cells.cell_count(), wall_grain, {execution.threads, execution.deadline}, [&](Range r) {
    std::size_t n = 0;
    for_runs(cells, r, [&](const Run& run) { n += starts.count(run); });
    places[r.first / wall_grain + 1] = n;
  });
  places[0] = 4;
  for (std::size_t c = 1; c < places.size(); ++c) places[c] += places[c - 1];
  return places;
}

template <class T>
bool has_walls_as(std::span<const WallOf<T>> walls, const MazeCells& cells, const Execution& execution) {
  const WallStarts starts(cells, false);
  const std::vector<std::size_t> places = places_of(cells, starts, execution);
  const std::array<WallOf<T>, 4> frame = outline<T>(cells);
  if (walls.size() != places.back() || !std::equal(frame.begin(), frame.end(), walls.begin())) return false;
  std::vector<std::uint8_t> same(places.size() - 1);
  for_chunks(cells.cell_count(), wall_grain, execution, [&](Range r) {
    WallComparer<T> comparer(walls.data() + places[r.first / wall_grain]);
    for_runs(cells, r, [&](const Run& run) { write_units<T>(cells, starts, run, comparer); });
    same[r.first / wall_grain] = comparer.same() ? 1 : 0;
  });
  return std::find(same.begin(), same.end(), 0) == same.end();
}

template <class T>
WallSet walls_as(const MazeCells& cells, bool merged, const Execution& execution) {
  const WallStarts starts(cells, merged);
  const std::vector<std::size_t> places = places_of(cells, starts, execution);
  const std::array<WallOf<T>, 4> frame = outline<T>(cells);
  execution.reserve(places.back() * sizeof(WallOf<T>));
  RawVector<WallOf<T>> walls(places.back());
  std::copy(frame.begin(), frame.end(), walls.begin());
  for_chunks(cells.cell_count(), wall_grain, execution, [&](Range r) {
    WallWriter<T> writer(walls.data() + places[r.first / wall_grain]);
    for_runs(cells, r, [&](const Run& run) {
      merged ? write_merged<T>(starts, run, writer) : write_units<T>(cells, starts, run, writer);
    });
  });
  return WallSet(std::move(walls));
}

}  // namespace

std::uint64_t interior_walls(const MazeCells& cells, const Execution& execution) {
  const WallStarts starts(cells, false);
  std::vector<std::uint64_t> parts(chunk_count(cells.cell_count(), wall_grain));
  for_chunks(cells.cell_count(), wall_grain, execution, [&](Range r) {
    for_runs(cells, r, [&](const Run& run) { parts[r.first / wall_grain] += starts.count(run); });
  });
  std::uint64_t sum = 0;
  for (const std::uint64_t part : parts) sum += part;
  return sum;
}

WallSet maze_walls(const MazeCells& cells, bool merged, const Execution& execution) {
  if (execution.progress != nullptr) execution.progress->begin("walls", cells.cell_count());
  return as_floats(cells) ? walls_as<float>(cells, merged, execution) : walls_as<double>(cells, merged, execution);
}

bool has_maze_walls(const WallSet& walls, const MazeCells& cells, const Execution& execution) {
  if (walls.holds_floats() != as_floats(cells)) return false;
  return walls.visit([&](auto all) { return has_walls_as(all, cells, execution); });
}

}  // namespace warren
