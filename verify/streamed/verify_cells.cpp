// SPDX-License-Identifier: BSD-3-Clause
#include "verify/streamed/verify_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"
#include "verify/exact/exact_segments.hpp"

namespace warren {

class LookedUpWalls::Reader : public CellWallReader {
 public:
  explicit Reader(const LookedUpWalls& walls) : walls_(walls) {}
  ~Reader() override {
    if (rows_.first < rows_.last) walls_.forget_rows(rows_);
  }
  void read(std::size_t number, CellTile& tile) override {
    walls_.place(number, tile);
    rows_ = {std::min<std::size_t>(rows_.first, tile.first_row),
             std::max(rows_.last, std::size_t{tile.first_row} + tile.height)};
    for (std::ptrdiff_t row = -1; row < std::ptrdiff_t{tile.height}; ++row) {
      walls_.read_row(std::ptrdiff_t{tile.first_col} - 1, tile.first_row + row,
                      std::span(tile.walls).subspan(tile.index(-1, row), std::size_t{tile.width} + 1));
    }
  }

 private:
  const LookedUpWalls& walls_;
  Range rows_{std::numeric_limits<std::size_t>::max(), 0};  // looked at
};

std::unique_ptr<CellWallReader> LookedUpWalls::reader() const { return std::make_unique<Reader>(*this); }

void LookedUpWalls::read_row(std::ptrdiff_t col, std::ptrdiff_t row, std::span<std::uint8_t> walls) const {
  for (std::uint8_t& cell : walls) cell = as_whole<std::uint8_t>(walls_at(col++, row));
}

namespace {

bool bit(const RawVector<std::uint64_t>& bits, std::uint64_t at) { return (bits[at / 64] >> at % 64 & 1U) != 0; }
void set_bit(RawVector<std::uint64_t>& bits, std::uint64_t at) { bits[at / 64] |= std::uint64_t{1} << at % 64; }

constexpr std::size_t first_cell = 64;  // bytes before it
constexpr unsigned tile_side_log2 = 8;

std::uint64_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t i = size; i > 0; --i) number = number << 8U | as_whole<unsigned char>(bytes[at + i - 1]);
  return number;
}

std::uint64_t row_bytes(std::uint64_t cols) { return (2 * cols + 7) / 8; }

/// Rows at byte 16, columns at byte 24.
std::uint32_t side_at(const std::string& name, std::string_view bytes, std::size_t at) {
  const bool is_known = bytes.size() >= first_cell && bytes.starts_with("\x89WRMAZE\n") && number_at(bytes, 8, 4) == 1;
  const std::uint64_t side = is_known ? number_at(bytes, at, 8) : 0;
  if (side < 1 || side >= std::uint64_t{1} << 27U) throw InputError(name, "is no .maze file that can be judged");
  return as_whole<std::uint32_t>(side);
}

/// Where the numbers begin: behind a header whose length stands at byte 8, in 2 bytes in version 1, in 4 in others.
std::size_t begin_of_numbers(const std::string& name, std::string_view bytes) {
  if (bytes.size() < 12 || !bytes.starts_with("\x93NUMPY"))
    throw InputError(name, "is no .npy file that can be judged");
  const std::size_t begin = bytes[6] == 1 ? 10 + number_at(bytes, 8, 2) : 12 + number_at(bytes, 8, 4);
  if (begin > bytes.size()) throw InputError(name, "is no .npy file that can be judged");
  return begin;
}

static_assert(std::endian::native == std::endian::little, "eight cells are copied as one number");
/// The low eight bits, from the lowest, as the low bits of eight bytes.
constexpr std::uint64_t spread(std::uint64_t bits) {
  const std::uint64_t one_a_byte = (bits & 0xffU) * 0x0101010101010101U & 0x8040201008040201U;
  return (one_a_byte + 0x7f7f7f7f7f7f7f7fU) >> 7U & 0x0101010101010101U;
}

/// Walls have numbers by their place: the cell left of or below them, and on which side of it they stand.
std::size_t number_of(std::uint32_t col_and_one, std::uint32_t row_and_one, bool is_upper) {
  return std::size_t{row_and_one} << 33U | std::size_t{col_and_one} << 1U | (is_upper ? 1U : 0U);
}
Segment wall_of(std::size_t number) {
  const double x = static_cast<double>(number >> 1U & 0xffffffffU) + 0.5;
  const double y = static_cast<double>(number >> 33U) + 0.5;
  return (number & 1U) != 0 ? Segment{{x - 1, y}, {x, y}} : Segment{{x, y - 1}, {x, y}};
}

/// A rectangle of cells or tiles: low .. high, both counted.
struct Cells {
  std::uint32_t low_col, low_row, high_col, high_row;
};

/// Legs first .. last, in a row, that come near a tile.
struct Run {
  std::size_t tile, first, last;
};

/// The cells up to `reach` around a leg.
Cells cells_around(const CellWallSource& cells, const Segment& leg, double reach) {
  const Box box = box_of(leg).grown(reach);
  const auto cell = [](double x, std::uint32_t count) {
    return bounded_whole<std::uint32_t>(x - 0.5, 0.0, count - 1.0);
  };
  return {cell(box.min.x, cells.cols()), cell(box.min.y, cells.rows()), cell(box.max.x, cells.cols()),
          cell(box.max.y, cells.rows())};
}

/// A leg lengthens the runs of the leg before it where both come near few tiles; where they come near many, each has
/// runs of its own.
void add_runs(const CellWallSource& cells, Range tiles, const Cells& near, std::size_t leg, RawVector<Run>& runs,
              const Execution& execution) {
  constexpr std::size_t few = 4;
  const unsigned shift = cells.side_log2();
  const std::size_t recent = runs.size() - std::min(runs.size(), few);
  for (std::size_t row = near.low_row >> shift; row <= near.high_row >> shift; ++row) {
    for (std::size_t col = near.low_col >> shift; col <= near.high_col >> shift; ++col) {
      const std::size_t tile = row * cells.tile_cols() + col;
      if (tile < tiles.first || tile >= tiles.last) continue;
      std::size_t i = runs.size();
      while (i > recent && !(runs[i - 1].tile == tile && runs[i - 1].last + 1 == leg)) --i;
      if (i > recent) {
        runs[i - 1].last = leg;
      } else {
        push_asked(runs, Run{tile, leg, leg}, execution);
      }
    }
  }
}

void compare_leg(const CellTile& tile, const BoxedSegment& leg, const Cells& near, Comparison& comparison) {
  const auto local = [](std::uint32_t x, std::uint32_t first, std::uint32_t size) {
    return std::clamp(std::ptrdiff_t{x} - std::ptrdiff_t{first}, std::ptrdiff_t{-1}, std::ptrdiff_t{size} - 1);
  };
  const std::ptrdiff_t last_row = local(near.high_row, tile.first_row, tile.height);
  const std::ptrdiff_t last_col = local(near.high_col, tile.first_col, tile.width);
  for (std::ptrdiff_t row = local(near.low_row, tile.first_row, tile.height) - 1; row <= last_row; ++row) {
    for (std::ptrdiff_t col = local(near.low_col, tile.first_col, tile.width) - 1; col <= last_col; ++col) {
      if (row < -1 || col < -1) continue;
      const unsigned walls = tile.walls[tile.index(col, row)];
      const auto with = [&](bool is_upper) {
        const std::size_t wall = number_of(as_whole<std::uint32_t>(std::ptrdiff_t{tile.first_col} + col + 1),
                                           as_whole<std::uint32_t>(std::ptrdiff_t{tile.first_row} + row + 1), is_upper);
        comparison.with_leg(leg, {wall_of(wall), wall});
      };
      if ((walls & CellTile::right_wall) != 0 && row >= 0) with(false);
      if ((walls & CellTile::upper_wall) != 0 && col >= 0) with(true);
    }
  }
}

/// One look at all legs, as far as `reach` around each.
Tally compare_cells(const CellWallSource& cells, Range tiles, const LegBoxes& legs, const VerifyOptions& options,
                    double reach, const Execution& execution) {
  constexpr std::size_t legs_a_chunk = std::size_t{1} << 14;
  constexpr std::size_t tiles_a_chunk = 4;  // a reader's scratch is large
  const auto near = [&](std::size_t leg) { return cells_around(cells, legs.leg(leg), reach); };
  const auto runs_in = [&](Range r) {
    RawVector<Run> runs;
    for (std::size_t leg = r.first; leg < r.last; ++leg) add_runs(cells, tiles, near(leg), leg, runs, execution);
    return runs;
  };
  auto parts = parts_of_chunks(legs.leg_count(), legs_a_chunk, execution.quiet(), runs_in);
  std::size_t total = 0;
  for (const RawVector<Run>& part : parts) total += part.size();
  execution.reserve(total * sizeof(Run));
  RawVector<Run> runs;
  runs.reserve(total);
  for (RawVector<Run>& part : parts) {
    runs.insert(runs.end(), part.begin(), part.end());
    let_go(part);
  }
  // By tile, in the order of the path within each.
  polled_sort(runs.begin(), runs.end(), execution,
              [](const Run& a, const Run& b) { return std::tie(a.tile, a.first) < std::tie(b.tile, b.first); });
  std::vector<Range> passed;  // the runs of each tile that has some
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i == 0 || runs[i].tile != runs[i - 1].tile) push_asked(passed, {i, i}, execution);
    passed.back().last = i + 1;
  }
  const auto compare = [&](Range r, Comparison& comparison) {
    const auto reader = cells.reader();
    CellTile tile;
    for (std::size_t i = r.first; i < r.last; ++i) {
      execution.check();
      reader->read(runs[passed[i].first].tile, tile);
      for (std::size_t run = passed[i].first; run < passed[i].last; ++run) {
        for (std::size_t leg = runs[run].first; leg <= runs[run].last; ++leg) {
          compare_leg(tile, {legs.leg(leg), leg}, near(leg), comparison);
        }
      }
    }
  };
  constexpr double boundless = std::numeric_limits<double>::infinity();
  return tally_chunks(passed.size(), tiles_a_chunk, options, boundless, execution, compare);
}

Violation described(const LegContact& found, const LegBoxes& legs, const Box& box) {
  if (found.obstacle == box_number) {
    return {found.leg, 0.0, fmt::format("box: {} {} {} {}", box.min.x, box.min.y, box.max.x, box.max.y)};
  }
  const Segment wall = wall_of(found.obstacle);
  return {found.leg, exact::distance(legs.leg(found.leg), wall),
          fmt::format("wall: {} {} {} {}", wall.a.x, wall.a.y, wall.b.x, wall.b.y)};
}

constexpr double half = 0.5;  // from the middle of a cell to its walls

/// A cell by its column and row from 0.
struct Cell {
  std::ptrdiff_t col, row;
};

/// The cell whose middle this is.
std::optional<Cell> cell_at(const LookedUpWalls& walls, Vec2 p) {
  if (!(p.x >= 1.0 && p.y >= 1.0 && p.x <= walls.cols() && p.y <= walls.rows())) return std::nullopt;
  const Cell cell{bounded_whole<std::ptrdiff_t>(p.x) - 1, bounded_whole<std::ptrdiff_t>(p.y) - 1};
  const bool is_middle = static_cast<double>(cell.col + 1) == p.x && static_cast<double>(cell.row + 1) == p.y;
  return is_middle ? std::optional(cell) : std::nullopt;
}

/// Are they neighbours with no wall between them?
bool is_open(const LookedUpWalls& walls, Cell a, Cell b) {
  const Cell low{std::min(a.col, b.col), std::min(a.row, b.row)};
  const std::ptrdiff_t way = a.col + b.col - 2 * low.col + a.row + b.row - 2 * low.row;
  const unsigned between = a.row == b.row ? CellTile::right_wall : CellTile::upper_wall;
  return way == 1 && (walls.walls_at(low.col, low.row) & between) == 0;
}

bool has_wall(const LookedUpWalls& walls, Cell cell) {
  return walls.walls_at(cell.col, cell.row) != 0 ||
         (walls.walls_at(cell.col - 1, cell.row) & CellTile::right_wall) != 0 ||
         (walls.walls_at(cell.col, cell.row - 1) & CellTile::upper_wall) != 0;
}

/// What some legs in a row come to.
struct Steps {
  bool are_open = true;        ///< all are steps that no wall is in the way of
  bool pass_by_walls = false;  ///< a wall stands beside one of them
  double length = 0.0;         ///< added leg by leg, as LegBoxes does
};

/// Legs of the path; of its first and last leg the length alone, where these are no steps.
Steps look_at(const LookedUpWalls& walls, std::span<const Vec2> path, Range legs) {
  Steps steps;
  std::optional<Cell> from = cell_at(walls, path[legs.first]);
  for (std::size_t leg = legs.first; leg < legs.last; ++leg) {
    const std::optional<Cell> to = cell_at(walls, path[leg + 1]);
    const bool is_end = leg == 0 || leg + 2 == path.size();
    if (from && to && is_open(walls, *from, *to)) {
      steps.length += 1.0;
      steps.pass_by_walls = steps.pass_by_walls || has_wall(walls, *from);
    } else {
      steps.length += norm(path[leg + 1] - path[leg]);
      if (!is_end) return {.are_open = false};
    }
    from = to;
  }
  return steps;
}

/// The length where all legs but the first and the last are such steps.
std::optional<double> length_of_steps(const LookedUpWalls& walls, std::span<const Vec2> path,
                                      const Execution& execution) {
  constexpr std::size_t grain = LegBoxes::legs_a_sum;
  const auto steps_in = [&](Range legs) { return look_at(walls, path, legs); };
  Steps all;
  for (const Steps& part : parts_of_chunks(path.size() - 1, grain, execution, steps_in)) {
    all.are_open = all.are_open && part.are_open;
    all.pass_by_walls = all.pass_by_walls || part.pass_by_walls;
    all.length += part.length;
  }
  return all.are_open && all.pass_by_walls ? std::optional(all.length) : std::nullopt;
}

}  // namespace

JudgedGridLines::JudgedGridLines(std::uint32_t rows, std::uint32_t cols, unsigned side_log2, Range held,
                                 const Execution& execution)
    : LookedUpWalls(rows, cols, side_log2), held_(held) {
  const std::size_t upright = ((cols + std::size_t{1}) * held.size() + 63) / 64;
  const std::size_t level = ((held.size() + 1) * cols + 63) / 64;
  execution.reserve((upright + level) * sizeof(std::uint64_t));
  const auto poll = [&] { execution.check(); };
  assign_polled(upright_, upright, std::uint64_t{0}, poll);
  assign_polled(level_, level, std::uint64_t{0}, poll);
}

JudgedGridLines::JudgedGridLines(const WallSet& walls, std::uint32_t rows, std::uint32_t cols,
                                 const Execution& execution)
    : JudgedGridLines(rows, cols, usual_side_log2, {0, rows}, execution) {
  constexpr std::size_t polled = std::size_t{1} << 16;
  Box around;
  walls.visit([&](auto held) {
    for (std::size_t i = 0; i < held.size(); ++i) {
      if (i % polled == 0) execution.check();
      const Segment s = held[i].segment();
      take("walls", s.a.x, s.a.y, s.b.x, s.b.y, execution);
      around.include(box_of(s));
    }
  });
  if (around.min != box().min || around.max != box().max) throw InputError("walls", "do not reach around their maze");
}

void JudgedGridLines::take(const std::string& where, double x1, double y1, double x2, double y2,
                           const Execution& execution) {
  constexpr std::uint64_t units_per_poll = std::uint64_t{1} << 16;  // walls may be as long as the maze is wide
  const double dx = x2 > x1 ? 1 : x2 < x1 ? -1 : 0;
  const double dy = y2 > y1 ? 1 : y2 < y1 ? -1 : 0;
  const auto is_inside = [](double x, double side) {
    return x >= 0.5 && x <= side + 0.5 && static_cast<double>(bounded_whole<std::uint64_t>(x)) + 0.5 == x;
  };
  if ((dx == 0) == (dy == 0) || !is_inside(x1, cols()) || !is_inside(x2, cols()) || !is_inside(y1, rows()) ||
      !is_inside(y2, rows())) {
    throw InputError(where, "holds walls off the grid of its maze, which can't be judged");
  }
  for (; x1 != x2 || y1 != y2; x1 += dx, y1 += dy) {
    if (++units_ % units_per_poll == 0) execution.check();
    const auto col = bounded_whole<std::uint64_t>(dx < 0 ? x1 - 1 : x1);  // of the unit's lower or left end, from 0
    const auto row = bounded_whole<std::uint64_t>(dy < 0 ? y1 - 1 : y1);
    if (row < held_.first || row > held_.last) continue;
    if (dx != 0) {
      set_bit(level_, (row - held_.first) * cols() + col);
    } else if (row < held_.last) {
      set_bit(upright_, col * held_.size() + row - held_.first);
    }
  }
}

/// The lines right of and above the cell.
unsigned JudgedGridLines::walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const {
  const auto x = as_whole<std::uint64_t>(col + 1);
  const auto y = as_whole<std::uint64_t>(row + 1);
  assert(y >= held_.first && y <= held_.last);
  const bool right = y > held_.first && bit(upright_, x * held_.size() + y - 1 - held_.first);
  const bool above = x > 0 && bit(level_, (y - held_.first) * cols() + x - 1);
  return (right ? CellTile::right_wall : 0U) | (above ? CellTile::upper_wall : 0U);
}

JudgedMazeFile::JudgedMazeFile(const std::string& name, std::string_view bytes, Forget forget)
    : LookedUpWalls(side_at(name, bytes, 16), side_at(name, bytes, 24), tile_side_log2),
      bytes_(bytes),
      forget_(std::move(forget)) {
  const std::uint64_t bands = (std::uint64_t{rows()} + 255) / 256;
  if (bytes.size() != first_cell + rows() * row_bytes(cols()) + 4 * bands) {
    throw InputError(name, "has another size than its header says");
  }
}

/// Left of and below the maze its outline stands, but for the door of the first row. Of a cell the file's lower bit is
/// its right wall, the other one its upper wall.
unsigned JudgedMazeFile::walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const {
  if (col < 0) return row == 0 ? 0U : CellTile::right_wall;
  if (row < 0) return CellTile::upper_wall;
  const std::uint64_t bit = 2 * as_whole<std::uint64_t>(col);
  const std::uint64_t row_begin = first_cell + as_whole<std::uint64_t>(row) * row_bytes(cols());
  static_assert(CellTile::right_wall == 1 && CellTile::upper_wall == 2);
  return unsigned{as_whole<unsigned char>(bytes_[row_begin + bit / 8])} >> bit % 8 & 3U;
}

void JudgedMazeFile::read_row(std::ptrdiff_t col, std::ptrdiff_t row, std::span<std::uint8_t> walls) const {
  for (std::uint8_t& cell : walls) cell = as_whole<std::uint8_t>(JudgedMazeFile::walls_at(col++, row));
}

void JudgedMazeFile::forget_rows(Range rows) const {
  const std::uint64_t stride = row_bytes(cols());
  if (forget_) forget_(first_cell + rows.first * stride, first_cell + rows.last * stride);
}

JudgedNpyMaze::JudgedNpyMaze(const std::string& name, std::string_view bytes, std::uint32_t rows, std::uint32_t cols,
                             Range held, const JudgedMazeFile::Forget& forget, const Execution& execution)
    : JudgedGridLines(rows, cols, tile_side_log2, held, execution) {
  constexpr std::size_t window = std::size_t{1} << 23;  // bytes
  const std::size_t begin = begin_of_numbers(name, bytes);
  const bool is_float = bytes.substr(0, begin).find("<f4") != std::string_view::npos;
  const auto take_all = [&]<class T>(std::array<T, 4> wall, std::string_view numbers) {
    for (std::size_t at = 0; at + sizeof wall <= numbers.size(); at += sizeof wall) {
      if (at % (std::size_t{1} << 20) == 0) execution.check();
      std::memcpy(wall.data(), numbers.data() + at, sizeof wall);
      take(name, wall[0], wall[1], wall[2], wall[3], execution);
    }
  };
  for (std::size_t at = begin; at < bytes.size(); at += window) {
    const std::string_view numbers = bytes.substr(at, window);
    is_float ? take_all(std::array<float, 4>{}, numbers) : take_all(std::array<double, 4>{}, numbers);
    if (forget) forget(at, at + numbers.size());
  }
}

JudgedPassages::JudgedPassages(const std::string& where, std::uint32_t rows, std::uint32_t cols,
                               std::span<const std::uint64_t> right, std::span<const std::uint64_t> up)
    : LookedUpWalls(rows, cols, usual_side_log2), right_(right), up_(up), words_a_row_((std::size_t{cols} + 63) / 64) {
  if (right.size() == words_a_row_ * rows && up.size() == right.size()) return;
  throw InputError(where, "expected two bits for each cell of the maze");
}

/// All around stands the outline, but for the doors left of the first row and right of the last.
unsigned JudgedPassages::walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const {
  if (col < 0) return row == 0 ? 0U : CellTile::right_wall;
  if (row < 0) return CellTile::upper_wall;
  const std::size_t word = as_whole<std::size_t>(row) * words_a_row_ + as_whole<std::size_t>(col) / 64;
  const unsigned bit = as_whole<unsigned>(col) % 64;
  const bool is_last_col = col + 1 == std::ptrdiff_t{cols()};
  const bool is_last_row = row + 1 == std::ptrdiff_t{rows()};
  const bool right = is_last_col ? !is_last_row : (right_[word] >> bit & 1U) == 0;
  const bool above = is_last_row || (up_[word] >> bit & 1U) == 0;
  return (right ? CellTile::right_wall : 0U) | (above ? CellTile::upper_wall : 0U);
}

void JudgedPassages::read_row(std::ptrdiff_t col, std::ptrdiff_t row, std::span<std::uint8_t> walls) const {
  static_assert(usual_side_log2 == 6, "a tile is as wide as a word");
  if (row < 0 || row + 1 == std::ptrdiff_t{rows()}) return LookedUpWalls::read_row(col, row, walls);
  const std::size_t word = as_whole<std::size_t>(row) * words_a_row_ + as_whole<std::size_t>(col + 1) / 64;
  const std::uint64_t right = ~right_[word];
  const std::uint64_t above = ~up_[word];
  for (std::size_t i = 0; i + 1 < walls.size(); i += 8) {
    const std::uint64_t eight = spread(right >> i) | spread(above >> i) << 1U;
    std::memcpy(&walls[i + 1], &eight, std::min<std::size_t>(8, walls.size() - i - 1));
  }
  walls.front() = as_whole<std::uint8_t>(walls_at(col, row));  // these may be of the maze's rim
  walls.back() = as_whole<std::uint8_t>(walls_at(col + std::ssize(walls) - 1, row));
}

NearestWalls nearest_among_cells(const CellWallSource& cells, Range tiles, std::span<const Vec2> path,
                                 const VerifyOptions& options, double reach, const Execution& execution) {
  const LegBoxes legs(path, execution);
  const Tally tally = compare_cells(cells, tiles, legs, options, reach, execution);
  return {tally.least, tally.violation.leg, tally.violation.obstacle};
}

JudgeAmongCells::JudgeAmongCells(const CellWallSource& cells, const VerifyOptions& options, const Execution& execution,
                                 JudgesElsewhere* others)
    : cells_(cells), options_(options), execution_(execution), others_(others) {
  if (options.contact == Contact::allowed)
    throw InputError("contact", "is not judged where walls are made tile by tile");
}

/// Looks farther where nothing came as near as was looked, or as something else did: the least distance, if it is below
/// that of the pieces before, is then the true one.
Tally JudgeAmongCells::compared(const LegBoxes& legs) const {
  const double farthest = static_cast<double>(cells_.rows()) + cells_.cols();
  for (double reach = std::max(1.0, std::ceil(options_.reach() + 1e-6));; reach *= 2) {
    if (others_ != nullptr) others_->begin(legs.path(), reach);
    const Range tiles = others_ != nullptr ? others_->own_tiles() : Range{0, cells_.tile_count()};
    Tally tally = compare_cells(cells_, tiles, legs, options_, reach, execution_);
    for (const NearestWalls& found : others_ != nullptr ? others_->take() : std::vector<NearestWalls>{}) {
      tally.least = std::min(tally.least, found.least);
      tally.violation = std::min(tally.violation, LegContact{found.leg, found.wall});
    }
    if (std::min(tally.least, report_.least) <= reach || reach > farthest) return tally;
  }
}

void JudgeAmongCells::add(std::span<const Vec2> piece) {
  check_judged_path(piece, options_, execution_);
  assert(points_ == 0 || piece.front() == ends_[1]);
  const Vec2 twice[] = {piece.front(), piece.front()};
  const LegBoxes legs(piece.size() > 1 ? piece : std::span<const Vec2>(twice), execution_);
  Tally tally = compared(legs);
  check_box(cells_.box(), legs, tally);
  LegReport report{.least = tally.least};
  if (tally.violation != no_violation) {
    report.violation = described(tally.violation, legs, cells_.box());
    report.violation->leg += points_ == 0 ? 0 : points_ - 1;
  }
  report_.add(report);
  length_ += legs.length();
  if (points_ == 0) ends_[0] = piece.front();
  ends_[1] = piece.back();
  points_ += piece.size() - (points_ == 0 ? 0 : 1);
}

Verification JudgeAmongCells::verdict() const {
  assert(points_ > 0);
  Verification verdict = verdict_on(report_, wrong_ends(ends_, options_, legs_of(points_)));
  verdict.length = length_;
  verdict.min_clearance -= options_.radius;
  return verdict;
}

Verification verify_among_cells(const CellWallSource& cells, std::span<const Vec2> path, const VerifyOptions& options,
                                const Execution& execution) {
  JudgeAmongCells judge(cells, options, execution);
  judge.add(path);
  return judge.verdict();
}

Verification verify_steps(const LookedUpWalls& walls, std::span<const Vec2> path, const VerifyOptions& options,
                          const Execution& execution) {
  check_judged_path(path, options, execution);
  const bool may_be_steps = path.size() > 3 && options.reach() < half && options.contact == Contact::blocked;
  const std::optional<double> length = may_be_steps ? length_of_steps(walls, path, execution) : std::nullopt;
  if (!length) return verify_among_cells(walls, path, options, execution);
  const Verification first = verify_among_cells(walls, path.first(2), {options.radius, options.clearance}, execution);
  const Verification last = verify_among_cells(walls, path.last(2), {options.radius, options.clearance}, execution);
  if (!first.verified || !last.verified) return verify_among_cells(walls, path, options, execution);
  const LegReport legs{.least = half};
  Verification verdict = verdict_on(legs, wrong_ends(path, options, legs_of(path.size())));
  verdict.length = *length;
  verdict.min_clearance = std::min({half - options.radius, first.min_clearance, last.min_clearance});
  return verdict;
}

}  // namespace warren
