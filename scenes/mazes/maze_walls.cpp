// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/maze_walls.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>

#include "core/base/raw_vector.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

// Walls of a maze from its bits. Cells are cut into runs of 65536 in storage order (column by column); one pass counts
// the walls that each run owns, sums give its place in the output, a second pass writes. Unit walls are written without
// branches through a small buffer that stays in the first cache: about 1.5 ns a wall, bound by the memory written to.

constexpr std::size_t wall_grain = std::size_t{1} << 16;
constexpr std::uint32_t largest_float_side = (1U << 23U) - 1;  // side + 0.5 is a float up to here

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
std::vector<std::size_t> places_of(const MazeCells& cells, const WallStarts& starts, Range some, std::size_t before,
                                   const Execution& execution) {
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

constexpr std::uint32_t largest_packed_side = PackedWall::most / PackedWall::per_unit - 1;

/// Calls f with a wall of the narrowest type that holds all walls of such a maze.
template <class F>
auto with_wall_type(std::uint32_t rows, std::uint32_t cols, const F& f) {
  const std::uint32_t side = std::max(rows, cols);
  if (side <= largest_packed_side) return f(PackedWall());
  return side <= largest_float_side ? f(FloatWall()) : f(DoubleWall());
}

/// Takes the walls of one chunk as WallWriter does, and looks whether those that stand are they.
template <class Wall>
class WallComparer {
 public:
  explicit WallComparer(const Wall* walls) : at_(walls) {}
  void make_room() const {}
  void add(const Wall& wall, unsigned keep) {
    if (keep == 0) return;
    same_ = same_ && *at_ == wall;
    ++at_;
  }
  bool same() const { return same_; }

 private:
  const Wall* at_;
  bool same_ = true;
};

template <class Wall>
bool has_walls_as(std::span<const Wall> walls, const MazeCells& cells, const Execution& execution) {
  const WallStarts starts(cells, false);
  const std::vector<std::size_t> places = places_of(cells, starts, {0, cells.cell_count()}, 4, execution);
  const std::array<Wall, 4> frame = outline<Wall>(cells.rows(), cells.cols());
  if (walls.size() != places.back() || !std::equal(frame.begin(), frame.end(), walls.begin())) return false;
  std::vector<std::uint8_t> same(places.size() - 1);
  for_chunks(cells.cell_count(), wall_grain, execution, [&](Range r) {
    WallComparer<Wall> comparer(walls.data() + places[r.first / wall_grain]);
    for_runs(cells, r, [&](const Run& run) { write_units<Wall>(cells, starts, run, comparer); });
    same[r.first / wall_grain] = comparer.same() ? 1 : 0;
  });
  return std::find(same.begin(), same.end(), 0) == same.end();
}

template <class Wall>
WallSet walls_as(const MazeCells& cells, bool merged, const Execution& execution) {
  const WallStarts starts(cells, merged);
  const std::vector<std::size_t> places = places_of(cells, starts, {0, cells.cell_count()}, 4, execution);
  const std::array<Wall, 4> frame = outline<Wall>(cells.rows(), cells.cols());
  execution.reserve(places.back() * sizeof(Wall));
  RawVector<Wall> walls(places.back());
  std::copy(frame.begin(), frame.end(), walls.begin());
  write_walls(cells, starts, {0, cells.cell_count()}, places, walls.data(), execution);
  return WallSet(std::move(walls));
}

constexpr std::size_t rows_grain = std::size_t{1} << 14;
constexpr std::size_t cells_a_piece = std::size_t{1} << 20;

template <class T>
std::string_view bytes_of(std::span<const WallOf<T>> walls) {
  return {reinterpret_cast<const char*>(walls.data()), walls.size_bytes()};  // NOLINT: the walls' bytes
}

Execution quietly(const Execution& execution) { return {execution.threads, execution.deadline}; }

}  // namespace

std::uint64_t interior_walls(const MazeCells& cells, const Execution& execution) {
  const WallStarts starts(cells, false);
  return sum_of_chunks(cells.cell_count(), wall_grain, execution, [&](Range r) {
    std::uint64_t sum = 0;
    for_runs(cells, r, [&](const Run& run) { sum += starts.count(run); });
    return sum;
  });
}

std::size_t maze_wall_bytes(std::uint32_t rows, std::uint32_t cols) {
  return with_wall_type(rows, cols, []<class Wall>(Wall) { return sizeof(Wall); });
}

WallSet maze_walls(const MazeCells& cells, bool merged, const Execution& execution) {
  if (execution.progress != nullptr) execution.progress->begin("walls", cells.cell_count());
  return with_wall_type(cells.rows(), cells.cols(),
                        [&]<class Wall>(Wall) { return walls_as<Wall>(cells, merged, execution); });
}

bool has_maze_walls(const WallSet& walls, const MazeCells& cells, const Execution& execution) {
  return with_wall_type(cells.rows(), cells.cols(), [&]<class Wall>(Wall) {
    return walls.visit([&]<class Held>(std::span<const Held> held) {
      if constexpr (std::is_same_v<Held, Wall>) return has_walls_as(held, cells, execution);
      return false;
    });
  });
}

WallStrips::WallStrips(const CellWallSource& cells, bool merged, const Execution& execution)
    : cells_(cells), merged_(merged) {
  if (merged) {
    execution.reserve(strip_count() * cells.rows() * sizeof(runs_[0]));
    runs_.resize(strip_count() * cells.rows());
  }
  if (execution.progress != nullptr) execution.progress->begin("walls", cells.tile_count());
  Strip strip = first_strip(execution);
  for (;; go_on(strip, execution)) {
    const WallStarts starts(strip.cells, merged, {first_col(strip), cells.cols()});
    const std::uint64_t lead = std::uint64_t{strip.lead} * cells.rows();
    count_ = places_of(strip.cells, starts, {lead, strip.cells.cell_count()}, count_, execution).back();
    if (merged) note_runs(strip, execution);
    if (strip.number + 1 == strip_count()) break;
  }
}

bool WallStrips::holds_floats() const { return std::max(cells_.rows(), cells_.cols()) <= largest_float_side; }

std::uint32_t WallStrips::width_of(std::size_t strip) const {
  const std::uint32_t side = 1U << cells_.side_log2();
  return std::min(side, cells_.cols() - static_cast<std::uint32_t>(strip) * side);
}

std::uint32_t WallStrips::first_col(const Strip& strip) const {
  return (static_cast<std::uint32_t>(strip.number) << cells_.side_log2()) - strip.lead;
}

WallStrips::Strip WallStrips::first_strip(const Execution& execution) const {
  Strip strip{0, 0, MazeCells(cells_.rows(), width_of(0), execution)};
  read(strip, execution);
  return strip;
}

void WallStrips::go_on(Strip& strip, const Execution& execution) const {
  const std::size_t number = strip.number + 1;
  Strip next{number, 1, MazeCells(cells_.rows(), width_of(number) + 1, execution)};
  const std::span<const std::uint8_t> last = std::span<const std::uint8_t>(strip.cells.bytes())
                                                 .subspan(strip.cells.index(strip.cells.cols() - 1, 0), cells_.rows());
  std::copy(last.begin(), last.end(), next.cells.bytes().begin() + static_cast<std::ptrdiff_t>(next.cells.index(0, 0)));
  read(next, execution);
  strip = std::move(next);
}

void WallStrips::read(Strip& strip, const Execution& execution) const {
  constexpr std::size_t grain = 8;  // a reader's scratch is large
  for_chunks(cells_.tile_count() / strip_count(), grain, execution, [&](Range r) {
    const auto reader = cells_.reader();
    CellTile tile;
    for (std::size_t row_of_tiles = r.first; row_of_tiles < r.last; ++row_of_tiles) {
      reader->read(row_of_tiles * strip_count() + strip.number, tile);
      copy_tile(tile, strip.cells, strip.lead);
    }
  });
}

void WallStrips::note_runs(const Strip& strip, const Execution& execution) {
  for_chunks(cells_.rows(), rows_grain, quietly(execution), [&](Range r) {
    for (auto row = static_cast<std::uint32_t>(r.first); row < r.last; ++row) {
      std::uint32_t col = strip.lead;
      while (col < strip.cells.cols() && strip.cells.wall_above(col, row)) ++col;
      runs_[strip.number * cells_.rows() + row] = static_cast<std::uint16_t>(col - strip.lead);
    }
  });
}

/// By row, how far an upper wall goes on right of a strip.
std::vector<std::uint32_t> WallStrips::beyond(std::size_t strip) const {
  std::vector<std::uint32_t> cells(merged_ ? cells_.rows() : 0, 0);
  for (std::size_t row = 0; row < cells.size(); ++row) {
    for (std::size_t next = strip + 1; next < strip_count(); ++next) {
      const std::uint32_t run = runs_[next * cells_.rows() + row];
      cells[row] += run;
      if (run < width_of(next)) break;
    }
  }
  return cells;
}

template <class T>
void WallStrips::write_strip(const Strip& strip, const std::function<void(std::string_view)>& take,
                             const Execution& execution) const {
  const std::vector<std::uint32_t> going_on = beyond(strip.number);
  const WallStarts starts(strip.cells, merged_, {first_col(strip), cells_.cols(), merged_ ? going_on.data() : nullptr});
  RawVector<WallOf<T>> walls;
  const std::uint64_t last = strip.cells.cell_count();
  for (std::uint64_t first = std::uint64_t{strip.lead} * cells_.rows(); first < last; first += cells_a_piece) {
    const Range some{first, std::min(first + cells_a_piece, last)};
    const std::vector<std::size_t> places = places_of(strip.cells, starts, some, 0, execution);
    if (places.back() > walls.capacity()) execution.reserve(places.back() * sizeof(WallOf<T>));
    walls.resize(places.back());
    write_walls(strip.cells, starts, some, places, walls.data(), quietly(execution));
    take(bytes_of<T>(walls));
  }
}

void WallStrips::write(const std::function<void(std::string_view)>& take, const Execution& execution) const {
  execution.reserve(merged_ ? cells_.rows() * sizeof(std::uint32_t) : 0);
  if (execution.progress != nullptr) execution.progress->begin("write", cells_.tile_count());
  const auto with = [&]<class T>(T) {
    const auto frame = outline<WallOf<T>>(cells_.rows(), cells_.cols());
    take(bytes_of<T>(frame));
    for (Strip strip = first_strip(execution);; go_on(strip, execution)) {
      write_strip<T>(strip, take, execution);
      if (strip.number + 1 == strip_count()) break;
    }
  };
  holds_floats() ? with(float{}) : with(double{});
}

}  // namespace warren
