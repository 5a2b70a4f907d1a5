// SPDX-License-Identifier: BSD-3-Clause
// Walls of a maze from its bits, from walls back to cells, and the flood over cells. For walls, cells are cut into
// runs of 65536 in storage order (column by column); one pass counts the walls that each run owns, sums give its place
// in the output, a second pass writes. Unit walls are written without branches through a small buffer that stays in
// the first cache: about 1.5 ns a wall, bound by the memory written to.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include "core/base/error.hpp"
#include "core/base/page_pool.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren {
namespace {

constexpr std::size_t wall_grain = std::size_t{1} << 16;
constexpr std::uint32_t largest_float_side = (1U << 23U) - 1;  // side + 0.5 is a float up to here

/// The wall that goes so far to the right, or up, from where grid lines x and y cross; line k is at k + 0.5.
template <class Wall>
Wall wall_on_lines(std::uint32_t x, std::uint32_t y, std::uint32_t right, std::uint32_t up) {
  if constexpr (std::is_same_v<Wall, PackedWall>) {
    const auto steps = [](std::uint32_t units) { return static_cast<std::int32_t>(units) * PackedWall::per_unit; };
    const auto at = [&](std::uint32_t line) { return steps(line) + PackedWall::per_unit / 2; };
    return right == 0 ? PackedWall::upright(at(x), at(y), steps(up)) : PackedWall::level(at(x), at(y), steps(right));
  } else {
    using T = typename Wall::Number;
    const auto at = [](std::uint32_t line) { return static_cast<T>(line) + T{0.5}; };
    return {at(x), at(y), at(x + right), at(y + up)};
  }
}

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
struct WallStarts {
  const MazeCells& cells;
  bool merged;
  ColumnsOfMaze columns{0, cells.cols()};  // where more lie to their left, the first of them is only looked at

  /// Which bits of this column's cells are interior walls (upper walls of the top row apart).
  unsigned interior_of(std::uint32_t col) const {
    return columns.first + col + 1 < columns.all ? MazeCells::all_walls : MazeCells::upper_wall;
  }
  unsigned at(std::uint32_t col, std::uint32_t row) const {
    const std::uint8_t* const bytes = cells.bytes().data();
    const std::size_t i = cells.index(col, row);
    unsigned bits = bytes[i] & interior_of(col);
    if (row + 1 == cells.rows()) bits &= ~unsigned{MazeCells::upper_wall};
    if (!merged) return bits;
    if (row > 0) bits &= ~(bytes[i - 1] & unsigned{MazeCells::right_wall});
    if (col > 0) bits &= ~(bytes[i - cells.stride()] & unsigned{MazeCells::upper_wall});
    return bits;
  }
  /// Cells that the right wall of (col, row) runs along, upwards.
  std::uint32_t rows_along(std::uint32_t col, std::uint32_t row) const {
    std::uint32_t top = row + 1;
    while (merged && top < cells.rows() && cells.wall_right(col, top)) ++top;
    return top - row;
  }
  /// Cells that the upper wall of (col, row) runs along, to the right.
  std::uint32_t cols_along(std::uint32_t col, std::uint32_t row) const {
    std::uint32_t right = col + 1;
    while (merged && right < cells.cols() && cells.wall_above(right, row)) ++right;
    const bool goes_on = merged && right == cells.cols() && columns.beyond != nullptr;
    return right - col + (goes_on ? columns.beyond[row] : 0);
  }
  /// Walls that start in a run.
  std::size_t count(const Run& run) const { return merged ? count_merged(run) : count_units(run); }
  std::size_t count_merged(const Run& run) const {
    std::size_t n = 0;
    for (std::uint32_t row = run.row_first; row < run.row_last; ++row) {
      const unsigned bits = at(run.col, row);
      n += (bits & 1U) + (bits >> 1U);
    }
    return n;
  }
  std::size_t count_units(const Run& run) const {
    const std::uint8_t* const bytes = cells.bytes().data() + cells.index(run.col, 0);
    const unsigned interior = interior_of(run.col);
    std::uint32_t n = 0;  // a run is no longer than the grain
    for (std::uint32_t row = run.row_first; row < run.row_last; ++row) {
      const unsigned bits = bytes[row] & interior;
      n += (bits & 1U) + (bits >> 1U);
    }
    if (run.row_last == cells.rows()) n -= bytes[cells.rows() - 1] >> 1U;  // the outline's
    return n;
  }
};

/// Collects the walls of one chunk and hands them on in blocks.
template <class Wall>
class WallWriter : NotCopied {
 public:
  explicit WallWriter(Wall* out) : out_(out) {}
  ~WallWriter() { std::copy_n(block_.data(), used_, out_); }

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

template <class Wall>
void write_units(const WallStarts& starts, const Run& run, WallWriter<Wall>& writer) {
  const MazeCells& cells = starts.cells;
  const std::uint8_t* bytes = cells.bytes().data() + cells.index(run.col, 0);
  const unsigned interior = starts.interior_of(run.col);
  const std::uint32_t col = starts.columns.first + run.col;
  for (std::uint32_t row = run.row_first; row < run.row_last; ++row) {
    const unsigned bits = bytes[row] & interior & (row + 1 == cells.rows() ? 1U : 3U);
    writer.make_room();
    writer.add(wall_on_lines<Wall>(col + 1, row, 0, 1), bits & 1U);
    writer.add(wall_on_lines<Wall>(col, row + 1, 1, 0), bits >> 1U);
  }
}

template <class Wall>
void write_merged(const WallStarts& starts, const Run& run, WallWriter<Wall>& writer) {
  const std::uint32_t col = starts.columns.first + run.col;
  for (std::uint32_t row = run.row_first; row < run.row_last; ++row) {
    const unsigned bits = starts.at(run.col, row);
    writer.make_room();
    if ((bits & MazeCells::right_wall) != 0) {
      writer.add(wall_on_lines<Wall>(col + 1, row, 0, starts.rows_along(run.col, row)), 1);
    }
    if ((bits & MazeCells::upper_wall) != 0) {
      writer.add(wall_on_lines<Wall>(col, row + 1, starts.cols_along(run.col, row), 0), 1);
    }
  }
}

/// Where the walls of each chunk of these cells stand, behind the first `before`; and the end.
std::vector<std::size_t> places_of(const WallStarts& starts, Range some, std::size_t before,
                                   const Execution& execution) {
  std::vector<std::size_t> places(chunk_count(some.size(), wall_grain) + 1, 0);
  for_chunks(some.size(), wall_grain, {execution.threads, execution.deadline}, [&](Range r) {
    std::size_t n = 0;
    for_runs(starts.cells, {some.first + r.first, some.first + r.last},
             [&](const Run& run) { n += starts.count(run); });
    places[r.first / wall_grain + 1] = n;
  });
  places[0] = before;
  for (std::size_t c = 1; c < places.size(); ++c) places[c] += places[c - 1];
  return places;
}

/// Writes the walls that start at these cells.
template <class Wall>
void write_chunk(const WallStarts& starts, Range cells, Wall* walls) {
  WallWriter<Wall> writer(walls);
  for_runs(starts.cells, cells, [&](const Run& run) {
    starts.merged ? write_merged<Wall>(starts, run, writer) : write_units<Wall>(starts, run, writer);
  });
}

/// The same of cells whose chunks' places places_of() has told.
template <class Wall>
void write_walls(const WallStarts& starts, Range some, std::span<const std::size_t> places, Wall* walls,
                 const Execution& execution) {
  for_chunks(some.size(), wall_grain, execution, [&](Range r) {
    write_chunk(starts, {some.first + r.first, some.first + r.last}, walls + places[r.first / wall_grain]);
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

template <class Wall>
bool has_walls_as(std::span<const Wall> walls, const MazeCells& cells, const Execution& execution) {
  const WallStarts starts{cells, false};
  const std::vector<std::size_t> places = places_of(starts, {0, cells.cell_count()}, 4, execution);
  const auto frame = maze_outline<Wall>(cells.rows(), cells.cols());
  if (walls.size() != places.back() || !std::equal(frame.begin(), frame.end(), walls.begin())) return false;
  const std::size_t first_other = first_in_chunks(cells.cell_count(), wall_grain, execution, [&](Range r) {
    const std::size_t* const place = &places[r.first / wall_grain];
    const auto held = walls.subspan(place[0], place[1] - place[0]);
    RawVector<Wall> made(held.size());
    write_chunk(starts, r, made.data());
    return std::equal(made.begin(), made.end(), held.begin()) ? r.last : r.first;
  });
  return first_other == cells.cell_count();
}

template <class Wall>
WallSet walls_as(const MazeCells& cells, bool merged, const Execution& execution) {
  const WallStarts starts{cells, merged};
  const std::vector<std::size_t> places = places_of(starts, {0, cells.cell_count()}, 4, execution);
  const auto frame = maze_outline<Wall>(cells.rows(), cells.cols());
  execution.reserve(places.back() * sizeof(Wall));
  RawVector<Wall> walls(places.back());
  std::copy(frame.begin(), frame.end(), walls.begin());
  write_walls(starts, {0, cells.cell_count()}, places, walls.data(), execution);
  return WallSet(std::move(walls));
}

constexpr std::size_t rows_grain = std::size_t{1} << 14;
constexpr std::size_t cells_a_piece = std::size_t{1} << 20;

std::uint32_t width_of_strip(const CellWallSource& maze, std::size_t strip) {
  const std::uint32_t side = 1U << maze.side_log2();
  return std::min(side, maze.cols() - static_cast<std::uint32_t>(strip) * side);
}

/// A column of tiles, and of the one before it the last column of cells.
struct WallStrip {
  std::size_t number;
  std::uint32_t lead;  // columns before it that are there: 0 or 1
  MazeCells cells;

  std::uint32_t first_col(const CellWallSource& maze) const {
    return (static_cast<std::uint32_t>(number) << maze.side_log2()) - lead;
  }
  Range own_cells() const { return {std::uint64_t{lead} * cells.rows(), cells.cell_count()}; }
};

/// Calls visit(strip) for each strip of a maze, from the left.
template <class Visit>
void for_each_strip(const CellWallSource& maze, const Execution& execution, const Visit& visit) {
  const PagePool pages;            // each strip is made of those of the strip before
  std::vector<std::uint8_t> last;  // column of cells of the strip before
  execution.reserve(maze.rows());
  for (std::size_t number = 0; number < maze.tile_cols(); ++number) {
    const std::uint32_t lead = number > 0 ? 1 : 0;
    WallStrip strip{number, lead, MazeCells(maze.rows(), width_of_strip(maze, number) + lead, execution)};
    std::copy(last.begin(), last.end(), strip.cells.bytes().data() + strip.cells.index(0, 0));
    copy_tiles(maze, number, maze.tile_cols(), strip.first_col(maze), strip.cells, execution);
    visit(strip);
    const auto column = strip.cells.bytes().subspan(strip.cells.index(strip.cells.cols() - 1, 0), maze.rows());
    last.assign(column.begin(), column.end());
  }
}

/// By row, how many of its own cells an upper wall at a strip's left end runs along.
void note_runs(const WallStrip& strip, std::span<std::uint16_t> runs, const Execution& execution) {
  const Execution quiet{execution.threads, execution.deadline};
  for_each_index<std::uint32_t>(runs.size(), rows_grain, quiet, [&](std::uint32_t row) {
    std::uint32_t col = strip.lead;
    while (col < strip.cells.cols() && strip.cells.wall_above(col, row)) ++col;
    runs[row] = static_cast<std::uint16_t>(col - strip.lead);
  });
}

constexpr std::size_t flood_grain = std::size_t{1} << 16;
constexpr std::int64_t units_per_look = std::int64_t{1} << 16;

/// Do all walls lie on the grid? Grid lines are numbered from 0: line k is the coordinate k + 0.5. Branch-free, four
/// lanes at once: adding and taking away 2^23 (2^52) rounds k to a whole number. Differences from that, and products of
/// a wall's two extents, are summed and stay zero; a NaN stays in the sums. k itself is exact wherever it passes, for a
/// float too as long as there are less than 2^23 lines.
template <class Wall>
bool all_on_grid(std::span<const Wall> walls, MazeHint hint) {
  using T = typename Wall::Number;
  using Lanes = Eigen::Array<T, 4, 1>;
  constexpr T whole = static_cast<T>(std::uint64_t{1} << (std::numeric_limits<T>::digits - 1));
  const Lanes last(static_cast<T>(hint.cols), static_cast<T>(hint.rows), static_cast<T>(hint.cols),
                   static_cast<T>(hint.rows));
  Lanes off = Lanes::Zero();
  Lanes excess = Lanes::Zero();
  T oblique = 0;
  for (const Wall& held : walls) {
    const WallOf<T> w = unpacked(held);
    const Lanes k = Lanes(w.x1, w.y1, w.x2, w.y2) - T{0.5};
    off += (((k + whole) - whole) - k).abs();
    excess = excess.max((k - last).max(-k));
    oblique += std::abs((w.x2 - w.x1) * (w.y2 - w.y1));
  }
  return off.sum() == 0 && oblique == 0 && excess.maxCoeff() <= 0;
}

template <class Wall>
bool all_on_grid_exactly(std::span<const Wall> walls, MazeHint hint) {
  constexpr std::uint64_t exact_lines = std::uint64_t{1} << (std::numeric_limits<typename Wall::Number>::digits - 1);
  if (std::max(hint.rows, hint.cols) < exact_lines) return all_on_grid(walls, hint);
  return std::all_of(walls.begin(), walls.end(), [&](const Wall& held) {
    const auto w = unpacked(held);
    const DoubleWall wide{w.x1, w.y1, w.x2, w.y2};
    return all_on_grid(std::span<const DoubleWall>(&wide, 1), hint);
  });
}

/// Packed walls are never oblique; in whole numbers a fifth of the time.
bool all_on_grid_exactly(std::span<const PackedWall> walls, MazeHint hint) {
  constexpr std::int32_t half = PackedWall::per_unit / 2;
  const auto most = [](std::uint32_t lines) {
    return static_cast<std::int32_t>(std::min<std::uint32_t>(lines, PackedWall::most / PackedWall::per_unit)) *
           PackedWall::per_unit;
  };
  const std::int32_t last_x = most(hint.cols);
  const std::int32_t last_y = most(hint.rows);
  std::int32_t off = 0;
  std::int32_t beyond = 0;  // below 0: a wall is
  for (const PackedWall& w : walls) {
    const auto [x1, y1, x2, y2] = w.ends();
    const std::int32_t lines[] = {x1 - half, y1 - half, x2 - half, y2 - half};
    off |= (lines[0] | lines[1] | lines[2] | lines[3]) & (PackedWall::per_unit - 1);
    beyond |= lines[0] | lines[1] | lines[2] | lines[3];
    beyond |= (last_x - lines[0]) | (last_y - lines[1]) | (last_x - lines[2]) | (last_y - lines[3]);
  }
  return off == 0 && beyond >= 0;
}

/// A wall in grid lines, lower ends first.
struct GridWall {
  std::int64_t x1, y1, x2, y2;
};

GridWall grid_wall(std::int64_t x1, std::int64_t y1, std::int64_t x2, std::int64_t y2) {
  return {std::min(x1, x2), std::min(y1, y2), std::max(x1, x2), std::max(y1, y2)};
}
/// Of a wall that lies on the grid.
template <class T>
GridWall grid_wall(const WallOf<T>& w) {
  const auto line = [](T x) { return static_cast<std::int64_t>(x - T{0.5}); };
  return grid_wall(line(w.x1), line(w.y1), line(w.x2), line(w.y2));
}
GridWall grid_wall(const PackedWall& w) {
  const PackedWall::Ends e = w.ends();
  const auto line = [](std::int32_t steps) { return (steps - PackedWall::per_unit / 2) / PackedWall::per_unit; };
  return grid_wall(line(e.x1), line(e.y1), line(e.x2), line(e.y2));
}

/// Sets the bits of the cells along a wall; walls on the outline are no cells' business. Returns how many.
std::int64_t raise(const GridWall& w, MazeHint hint, MazeCells& cells) {
  const bool upright = w.x1 == w.x2;
  const std::int64_t length = (w.x2 - w.x1) + (w.y2 - w.y1);
  const bool inside = upright ? w.x1 > 0 && w.x1 < hint.cols : w.y1 > 0 && w.y1 < hint.rows;
  if (!inside || length == 0) return 0;
  const auto col = static_cast<std::uint32_t>(w.x1 - (upright ? 1 : 0));
  const auto row = static_cast<std::uint32_t>(w.y1 - (upright ? 0 : 1));
  const std::uint8_t bit = upright ? MazeCells::right_wall : MazeCells::upper_wall;
  std::uint8_t* const first = cells.bytes().data() + cells.index(col, row);
  *first |= bit;  // most walls are a unit long, and their direction is a coin toss: no branch decides on it
  const std::size_t step = upright ? 1 : cells.stride();
  for (std::int64_t i = 1; i < length; ++i) first[static_cast<std::size_t>(i) * step] |= bit;
  return length;
}

/// Takes out all interior walls; the outline and the gaps keep theirs.
void open_all(MazeCells& cells, const Execution& execution) {
  const std::size_t grain = std::max<std::size_t>(1, flood_grain / cells.stride());
  for_each_index<std::uint32_t>(cells.cols(), grain, execution, [&](std::uint32_t col) {
    std::uint8_t* const first = cells.bytes().data() + cells.index(col, 0);
    std::fill_n(first, cells.rows(), col + 1 < cells.cols() ? std::uint8_t{0} : MazeCells::right_wall);
    first[cells.rows() - 1] |= MazeCells::upper_wall;
  });
}

}  // namespace

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
    execution.reserve(cells.tile_cols() * cells.rows() * sizeof(runs_[0]));
    runs_.resize(cells.tile_cols() * cells.rows());
  }
  if (execution.progress != nullptr) execution.progress->begin("walls", cells.tile_count());
  for_each_strip(cells, execution, [&](const WallStrip& strip) {
    const WallStarts starts{strip.cells, merged, {strip.first_col(cells), cells.cols()}};
    count_ = places_of(starts, strip.own_cells(), count_, execution).back();
    if (merged) note_runs(strip, std::span(runs_).subspan(strip.number * cells.rows(), cells.rows()), execution);
  });
}

bool WallStrips::holds_floats() const { return std::max(cells_.rows(), cells_.cols()) <= largest_float_side; }

std::vector<std::uint32_t> WallStrips::beyond(std::size_t strip) const {
  std::vector<std::uint32_t> cells(merged_ ? cells_.rows() : 0, 0);
  for (std::size_t row = 0; row < cells.size(); ++row) {
    for (std::size_t next = strip + 1; next < cells_.tile_cols(); ++next) {
      const std::uint32_t run = runs_[next * cells_.rows() + row];
      cells[row] += run;
      if (run < width_of_strip(cells_, next)) break;
    }
  }
  return cells;
}

template <class Wall, class Take>
void WallStrips::for_each_piece(const Take& take, const Execution& execution) const {
  execution.reserve(merged_ ? cells_.rows() * sizeof(std::uint32_t) : 0);
  const auto frame = maze_outline<Wall>(cells_.rows(), cells_.cols());
  take(std::span<const Wall>(frame));
  RawVector<Wall> walls;
  for_each_strip(cells_, execution, [&](const WallStrip& strip) {
    const std::vector<std::uint32_t> going_on = beyond(strip.number);
    const WallStarts starts{strip.cells, merged_, {strip.first_col(cells_), cells_.cols(), going_on.data()}};
    const Range own = strip.own_cells();
    for (std::uint64_t first = own.first; first < own.last; first += cells_a_piece) {
      const Range some{first, std::min(first + cells_a_piece, own.last)};
      const std::vector<std::size_t> places = places_of(starts, some, 0, execution);
      if (places.back() > walls.capacity()) execution.reserve(places.back() * sizeof(Wall));
      walls.resize(places.back());
      write_walls(starts, some, places, walls.data(), {execution.threads, execution.deadline});
      take(std::span<const Wall>(walls));
    }
  });
}

void WallStrips::write(const std::function<void(std::string_view)>& take, const Execution& execution) const {
  if (execution.progress != nullptr) execution.progress->begin("write", cells_.tile_count());
  const auto take_bytes = [&](auto walls) {
    take({reinterpret_cast<const char*>(walls.data()), walls.size_bytes()});  // NOLINT: the walls' bytes
  };
  holds_floats() ? for_each_piece<FloatWall>(take_bytes, execution) : for_each_piece<DoubleWall>(take_bytes, execution);
}

std::optional<std::size_t> first_wall_off_grid(const WallSet& walls, MazeHint hint, const Execution& execution) {
  return walls.visit([&](auto span) -> std::optional<std::size_t> {
    const std::size_t first = first_in_chunks(span.size(), flood_grain, execution, [&](Range r) {
      if (all_on_grid_exactly(span.subspan(r.first, r.size()), hint)) return r.last;
      std::size_t i = r.first;
      while (all_on_grid_exactly(span.subspan(i, 1), hint)) ++i;
      return i;
    });
    return first == span.size() ? std::nullopt : std::optional(first);
  });
}

MazeCells cells_of_walls(const WallSet& walls, MazeHint hint, const Execution& execution) {
  if (const auto off = first_wall_off_grid(walls, hint, execution)) {
    const Segment s = walls.segment(*off);
    throw InputError("maze", fmt::format("wall {} is not on the unit grid of a {}x{} maze", *off, hint.rows, hint.cols),
                     fmt::format("{} {} {} {}", s.a.x, s.a.y, s.b.x, s.b.y));
  }
  MazeCells cells(hint.rows, hint.cols, execution);
  open_all(cells, execution);
  walls.visit([&](auto span) {  // serial: neighbours share bytes, and the bytes are what takes the time
    std::int64_t since_look = 0;
    for (const auto& wall : span) {
      since_look += 1 + raise(grid_wall(wall), hint, cells);
      if (since_look < units_per_look) continue;
      execution.check();
      since_look = 0;
    }
  });
  return cells;
}

bool flood_connects(const MazeCells& cells, std::pair<std::uint32_t, std::uint32_t> a,
                    std::pair<std::uint32_t, std::uint32_t> b, const Execution& execution) {
  for (const auto& [col, row] : {a, b}) {
    if (col >= cells.cols() || row >= cells.rows()) {
      throw InputError("maze", fmt::format("the cell must lie in the {}x{} maze", cells.rows(), cells.cols()),
                       fmt::format("column {}, row {}", col, row));
    }
  }
  const std::span<const std::uint8_t> walls = cells.bytes();
  const std::size_t stride = cells.stride();
  const std::size_t goal = cells.index(b.first, b.second);
  execution.reserve(walls.size());
  RawVector<std::uint8_t> reached(walls.size(), 0);
  std::vector<std::size_t> frontier;
  std::vector<std::size_t> next;
  const auto reach = [&](std::size_t to, unsigned wall) {
    if (wall != 0 || std::exchange(reached[to], std::uint8_t{1}) != 0) return;
    push_asked(next, to, execution);
  };
  reach(cells.index(a.first, a.second), 0);
  for (std::uint64_t steps = 0; !next.empty() && reached[goal] == 0;) {
    frontier.swap(next);
    next.clear();
    for (const std::size_t i : frontier) {  // which is no first byte, and gap bytes have all walls
      execution.poll(++steps);
      reach(i + stride, walls[i] & MazeCells::right_wall);
      reach(i + 1, walls[i] & MazeCells::upper_wall);
      if (i > stride) reach(i - stride, walls[i - stride] & MazeCells::right_wall);
      reach(i - 1, walls[i - 1] & MazeCells::upper_wall);
    }
  }
  return reached[goal] != 0;
}

}  // namespace warren
