// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/path_screen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/base/instruction_set.hpp"
#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"

namespace warren {
// The cells of a PathScreen that walls cover once they are grown: a block of walls at a time, as columns of numbers, by
// the widest instructions that this processor has.

/// The least and largest coordinates of walls, eight apart side by side.
template <class T>
struct WallLanes {
  static constexpr std::size_t count = 8;
  std::array<T, count> x_min, y_min, x_max, y_max;
};

/// Of a block of walls: the first and last column and row of each.
struct CoveredCells {
  static constexpr std::size_t block_size = 128;
  alignas(64) std::array<std::int32_t, block_size> column_first, column_last, row_first, row_last;

  /// Finds the cells of block_size walls, and widens the lanes by them: the same with every instruction set.
  template <class Wall, class Scale, class T>
  [[gnu::always_inline]] static inline void work(const Wall* walls, const Scale& x, const Scale& y, CoveredCells& cells,
                                                 WallLanes<T>& lanes) {
    Boxes<T> boxes;
    find_boxes(walls, boxes);
    widen(boxes, lanes);
    find_cells(boxes.x_min, boxes.x_max, x, cells.column_first, cells.column_last);
    find_cells(boxes.y_min, boxes.y_max, y, cells.row_first, cells.row_last);
  }

 private:
  template <class T>
  struct Boxes {
    alignas(64) std::array<T, block_size> x_min, y_min, x_max, y_max;
  };

  template <class T>
  [[gnu::always_inline]] static inline WallOf<T> ends_of(const WallOf<T>& wall) {
    return wall;
  }
  [[gnu::always_inline]] static inline PackedWall::Ends ends_of(const PackedWall& wall) { return wall.ends(); }

  template <class Wall, class T>
  [[gnu::always_inline]] static inline void find_boxes(const Wall* walls, Boxes<T>& boxes) {
    for (std::size_t i = 0; i < block_size; ++i) {
      const auto w = ends_of(walls[i]);
      boxes.x_min[i] = w.x1 < w.x2 ? w.x1 : w.x2;
      boxes.x_max[i] = w.x1 < w.x2 ? w.x2 : w.x1;
      boxes.y_min[i] = w.y1 < w.y2 ? w.y1 : w.y2;
      boxes.y_max[i] = w.y1 < w.y2 ? w.y2 : w.y1;
    }
  }

  template <class T>
  [[gnu::always_inline]] static inline void widen(const Boxes<T>& boxes, WallLanes<T>& lanes) {
    for (std::size_t i = 0; i < block_size; i += WallLanes<T>::count) {
      for (std::size_t k = 0; k < WallLanes<T>::count; ++k) {
        lanes.x_min[k] = boxes.x_min[i + k] < lanes.x_min[k] ? boxes.x_min[i + k] : lanes.x_min[k];
        lanes.y_min[k] = boxes.y_min[i + k] < lanes.y_min[k] ? boxes.y_min[i + k] : lanes.y_min[k];
        lanes.x_max[k] = boxes.x_max[i + k] > lanes.x_max[k] ? boxes.x_max[i + k] : lanes.x_max[k];
        lanes.y_max[k] = boxes.y_max[i + k] > lanes.y_max[k] ? boxes.y_max[i + k] : lanes.y_max[k];
      }
    }
  }

  [[gnu::always_inline]] static inline std::int32_t cell(double units, double before, double end) {
    const double at = units - before;
    return bounded_whole<std::int32_t>(at, 0.0, end) >> cell_quantum_bits;
  }

  [[gnu::always_inline]] static inline std::int32_t cell(std::int32_t units, std::int32_t before, std::int32_t end) {
    const std::int32_t at = units - before;
    const std::int32_t above = at > 0 ? at : 0;
    return (above < end ? above : end) >> cell_quantum_bits;
  }
  [[gnu::always_inline]] static inline void find_cells(const std::array<std::int32_t, block_size>& low,
                                                       const std::array<std::int32_t, block_size>& high,
                                                       const CellStepAxis& axis,
                                                       std::array<std::int32_t, block_size>& first,
                                                       std::array<std::int32_t, block_size>& last) {
    for (std::size_t i = 0; i < block_size; ++i) {
      first[i] = cell(low[i] << axis.shift, axis.before_first, axis.end);
      last[i] = cell(high[i] << axis.shift, axis.before_last, axis.end);
    }
  }

  template <class T>
  [[gnu::always_inline]] static inline void find_cells(const std::array<T, block_size>& low,
                                                       const std::array<T, block_size>& high, const CellAxis& axis,
                                                       std::array<std::int32_t, block_size>& first,
                                                       std::array<std::int32_t, block_size>& last) {
    for (std::size_t i = 0; i < block_size; ++i) {
      first[i] = cell(whole_below(static_cast<double>(low[i]) * axis.per_unit), axis.before_first, axis.end);
    }
    for (std::size_t i = 0; i < block_size; ++i) {
      last[i] = cell(whole_above(static_cast<double>(high[i]) * axis.per_unit), axis.before_last, axis.end);
    }
  }
};

namespace {

constexpr double screen_cells_per_leg = 64;
constexpr double screen_pieces_per_leg = 4;
constexpr double most_free_cells = 1 << 20;  // for a path of few legs among many walls
constexpr double cells_a_reach = 4.0;        // more make a wall's window wide
constexpr unsigned up = 0;
constexpr unsigned right = 1;

/// The largest power of two that is at most x > 0.
double power_of_two_below(double x) { return std::ldexp(1.0, std::ilogb(x)); }
double power_of_two_above(double x) {
  const double below = power_of_two_below(x);
  return below < x ? 2.0 * below : below;
}

/// Do most of the path's points lie on the corners of the cells?
bool on_lattice(std::span<const Vec2> path, double cell) {
  const std::size_t step = path.size() / 64 + 1;
  std::size_t asked = 0;
  std::size_t found = 0;
  for (std::size_t i = 0; i < path.size(); i += step) {
    ++asked;
    if (std::fmod(path[i].x, cell) == 0.0 && std::fmod(path[i].y, cell) == 0.0) ++found;
  }
  return 4 * found >= 3 * asked;
}

}  // namespace

PathScreen::PathScreen(const LegBoxes& legs, const Plan& plan, const Execution& execution) : plain_(plan.plain) {
  choose_cell(legs, plan);
  const Box box = legs.box();
  const double largest =
      std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)}) * per_cell_;
  constexpr double most_units = 1125899906842624.0;  // 2^50
  usable_ = largest * (1 << cell_quantum_bits) < most_units;
  if (!usable_) return;
  first_column_ = whole_below(box.min.x * per_cell_) - margin;
  first_row_ = whole_below(box.min.y * per_cell_) - margin;
  columns_ = place(box.max.x, first_column_).cell + 1 + margin;
  rows_ = place(box.max.y, first_row_).cell + 1 + margin;
  stride_ = as_whole<std::size_t>(rows_) / 4 + 1;
  const std::size_t bytes = as_whole<std::size_t>(columns_) * stride_ + sizeof(std::uint64_t);
  execution.reserve(bytes);
  bits_.resize(bytes);
  const auto columns = as_whole<std::size_t>(columns_);
  const std::size_t stripe = std::max<std::size_t>(64, chunk_count(columns, 64));
  for_chunks(columns, stripe, execution, [&](Range r) {
    const bool is_last = r.last == columns;
    std::fill(&bits_[r.first * stride_], &bits_[0] + (is_last ? bytes : r.last * stride_), std::uint8_t{0});
    execution.check();
    const Stripe marked{as_whole<std::int32_t>(r.first), as_whole<std::int32_t>(r.last)};
    const double left = (first_column_ + marked.first - 2) * cell_;
    const double right_end = (first_column_ + marked.last + 2) * cell_;
    const auto mark = [&](std::size_t leg) { mark_leg(legs.leg(leg), marked); };
    legs.for_each_block([&](const Box& around) { return around.max.x < left || around.min.x > right_end; },
                        [&](std::size_t block) { legs.for_each_in(block, mark); });
  });
}

void PathScreen::choose_cell(const LegBoxes& legs, const Plan& plan) {
  const Box box = legs.box();
  const auto count = static_cast<double>(legs.leg_count());
  const double free = std::min(static_cast<double>(plan.walls), most_free_cells) + 1024.0;
  const double by_length = legs.length() / (screen_pieces_per_leg * count + 0.25 * free);
  const double by_area =
      std::sqrt(box.width()) * std::sqrt(box.height()) / std::sqrt(screen_cells_per_leg * count + free);
  const double by_reach = plan.reach / cells_a_reach;
  const double least = std::max({by_length, by_area, by_reach, std::max(box.width(), box.height()) / most_side});
  cell_ = plan.typical_wall > 0.0 ? power_of_two_below(plan.typical_wall) : 0.0;
  if (cell_ < least) cell_ = power_of_two_above(least);
  if (cell_ == 0.0) cell_ = 1.0;
  const bool halves = !on_lattice(legs.path(), cell_) && on_lattice(legs.path(), 0.5 * cell_);
  if (halves && cell_ >= least) cell_ = 0.5 * cell_;
  per_cell_ = 1.0 / cell_;
}

PathScreen::Place PathScreen::place(double x, double first_cell) const {
  const double u = x * per_cell_;
  const double whole = whole_below(u);
  return {bounded_whole<std::int32_t>(whole - first_cell), whole == u};
}

void PathScreen::mark_leg(const Segment& leg, const Stripe& stripe) {
  const auto& [a, b] = leg;
  if (a.x == b.x || a.y == b.y) return mark_box(box_of(leg), stripe);
  const double extent = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)) * per_cell_;
  const double pieces = std::max(1.0, std::ceil(extent));
  // Rounding of the cuts: three roundings of a difference and one of the sum, generously.
  const Vec2 error{4e-15 * std::max(std::abs(a.x), std::abs(b.x)), 4e-15 * std::max(std::abs(a.y), std::abs(b.y))};
  const Box whole = box_of(leg);
  Vec2 p = a;
  for (double piece = 1.0; piece <= pieces; piece += 1.0) {
    const Vec2 q = piece == pieces ? b : a + (piece / pieces) * (b - a);
    const Box box = box_of({p, q});
    mark_box({{std::max(box.min.x - error.x, whole.min.x), std::max(box.min.y - error.y, whole.min.y)},
              {std::min(box.max.x + error.x, whole.max.x), std::min(box.max.y + error.y, whole.max.y)}},
             stripe);
    p = q;
  }
}

/// Marks what meets the box, which lies within the path's.
void PathScreen::mark_box(const Box& box, const Stripe& stripe) {
  const Place left = place(box.min.x, first_column_);
  const Place end = place(box.max.x, first_column_);
  const Place low = place(box.min.y, first_row_);
  const Place high = place(box.max.y, first_row_);
  // The last open cell that it meets; where it ends on a line and is no line itself, that is the one before.
  const std::int32_t column_last = std::max(left.cell, end.cell - (end.on_line ? 1 : 0));
  const std::int32_t row_last = std::max(low.cell, high.cell - (high.on_line ? 1 : 0));
  const bool along_row = low.on_line && box.min.y == box.max.y && box.min.x < box.max.x;
  const bool along_column = left.on_line && box.min.x == box.max.x && box.min.y < box.max.y;
  const std::int32_t column_end = std::min(column_last + 1, stripe.last + 1);
  for (std::int32_t column = std::max(left.cell, stripe.first); column < column_end; ++column) {
    for (std::int32_t row = low.cell; row <= row_last; ++row) {
      if (along_row) {
        set(column, row - 1, up, stripe);
      } else if (along_column) {
        set(column - 1, row, right, stripe);
      } else {
        set(column, row, up, stripe);
        set(column, row - 1, up, stripe);
        set(column, row, right, stripe);
        set(column - 1, row, right, stripe);
      }
    }
  }
}

void PathScreen::set(std::int32_t column, std::int32_t row, unsigned which, const Stripe& stripe) {
  if (column < stripe.first || column >= stripe.last) return;
  const auto bit = 2 * as_whole<std::size_t>(row) + which;
  std::uint8_t& byte = bits_[as_whole<std::size_t>(column) * stride_ + bit / 8];
  byte = as_whole<std::uint8_t>(byte | (1U << (bit % 8)));
}

void PathScreen::set_reach(double least, double r) {
  const double units = std::ceil(std::max(least, r * (1.0 + 1e-12)) * per_cell_ * (1 << cell_quantum_bits));
  constexpr double most = 1 << 20;        // beyond the slow
  reach_ = std::clamp(units, 1.0, most);  // at least 1, because touching is never clear
  if (!(units <= most)) usable_ = false;
}

/// Takes the words that it looks at from the budget; false where that doesn't do.
bool PathScreen::is_clear(const Window& w, std::size_t& budget) const {
  constexpr std::int32_t word_rows = 28;  // two bits each, from any bit of a word's first byte
  const std::size_t words = as_whole<std::size_t>(w.column_last - w.column_first + 1) *
                            (as_whole<std::size_t>(w.row_last - w.row_first) / word_rows + 1);
  if (words > budget) return false;
  budget -= words;
  const bool one_row = w.row_first == w.row_last;
  for (std::int32_t column = w.column_first; column <= w.column_last; ++column) {
    const bool last_column = column == w.column_last;
    if (one_row && last_column && w.column_first < w.column_last) break;  // it was right of the one before
    for (std::int32_t row = w.row_first; row <= w.row_last; row += word_rows) {
      const auto bit = 2 * as_whole<std::size_t>(row);
      std::uint64_t bits = 0;
      std::memcpy(&bits, &bits_[as_whole<std::size_t>(column) * stride_ + bit / 8], sizeof(bits));
      bits >>= bit % 8;
      const std::int32_t rows = std::min(w.row_last - row + 1, word_rows);
      const bool to_the_end = row + rows > w.row_last;
      constexpr std::uint64_t ups = 0x5555555555555555;
      std::uint64_t mask = last_column ? 0 : (ups << right) & ((std::uint64_t{1} << (2 * rows)) - 1);
      const std::int32_t ups_asked = to_the_end && !(one_row && last_column) ? rows - 1 : rows;
      mask |= ups & ((std::uint64_t{1} << (2 * ups_asked)) - 1);
      if ((bits & mask) != 0) return false;
    }
  }
  return true;
}

CellAxis PathScreen::axis(double first_cell, std::int32_t count) const {
  constexpr double units = 1 << cell_quantum_bits;
  return {per_cell_ * units, first_cell * units + reach_, first_cell * units - reach_ + 1.0,
          static_cast<double>(count) * units - 1.0};
}

/// Of packed walls, where nothing is rounded and nothing overflows.
std::optional<CellStepAxis> PathScreen::step_axis(double first_cell, std::int32_t count) const {
  constexpr double most = 1 << 29;
  const CellAxis by_units = axis(first_cell, count);
  const double per_step = by_units.per_unit / PackedWall::per_unit;
  const bool fits = std::max({std::abs(by_units.before_first), std::abs(by_units.before_last), by_units.end,
                              2.0 * PackedWall::most * per_step}) <= most;
  if (!fits || per_step < 1.0) return std::nullopt;
  const auto whole = [](double x) { return bounded_whole<std::int32_t>(x); };
  return CellStepAxis{std::ilogb(per_step), whole(by_units.before_first), whole(by_units.before_last),
                      whole(by_units.end)};
}

template <class Wall, class Scale>
void PathScreen::sift_along(std::span<const Wall> walls, std::size_t first_number, const Scale& x, const Scale& y,
                            Rest& rest) const {
  using T = std::conditional_t<std::is_same_v<Wall, PackedWall>, std::int32_t, typename Wall::Number>;
  constexpr double unit = std::is_same_v<Wall, PackedWall> ? 1.0 / PackedWall::per_unit : 1.0;
  using Limits = std::numeric_limits<T>;
  constexpr std::size_t block_size = CoveredCells::block_size;
  CoveredCells cells;
  WallLanes<T> lanes;
  lanes.x_min.fill(Limits::has_infinity ? Limits::infinity() : Limits::max());
  lanes.y_min = lanes.x_min;
  lanes.x_max.fill(Limits::has_infinity ? -Limits::infinity() : Limits::lowest());
  lanes.y_max = lanes.x_max;
  std::size_t budget = 65536 + 64 * walls.size();  // words of cells: for many short walls and a few long ones
  const auto set = plain_ ? detail::InstructionSet::baseline : detail::best_instruction_set();
  const auto work = detail::VersionsOf<&CoveredCells::work<Wall, Scale, T>>::up_to_avx2(set);
  std::array<Wall, block_size> tail;
  for (std::size_t begin = 0; begin < walls.size(); begin += block_size) {
    const std::size_t count = std::min(block_size, walls.size() - begin);
    const Wall* block = &walls[begin];
    if (count < block_size) {
      tail.fill(walls.back());
      std::copy(walls.end() - as_whole<std::ptrdiff_t>(count), walls.end(), tail.begin());
      block = tail.data();
    }
    work(block, x, y, cells, lanes);
    std::array<std::uint32_t, block_size> doubtful;
    std::size_t found = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto column = as_whole<std::uint32_t>(cells.column_first[i]);
      const auto row = as_whole<std::uint32_t>(cells.row_first[i]);
      const std::uint32_t wide = as_whole<std::uint32_t>(cells.column_last[i]) - column;
      const std::uint32_t high = as_whole<std::uint32_t>(cells.row_last[i]) - row;
      const std::uint32_t byte = bits_[column * stride_ + row / 4];
      const std::uint32_t hit = (byte >> (2 * (row % 4) + (wide & 1))) & 1U;
      doubtful[found] = i;
      found += as_whole<std::size_t>((wide + high > 1) | (hit != 0));
    }
    for (std::size_t k = 0; k < found; ++k) {
      const std::uint32_t i = doubtful[k];
      const Window window{cells.column_first[i], cells.column_last[i], cells.row_first[i], cells.row_last[i]};
      const bool small = window.column_last - window.column_first + window.row_last - window.row_first <= 1;
      if (small || !is_clear(window, budget)) rest.doubtful.push_back(first_number + begin + i);
    }
  }
  for (std::size_t k = 0; k < lanes.count && !walls.empty(); ++k) {
    rest.box.include(unit * Vec2{static_cast<double>(lanes.x_min[k]), static_cast<double>(lanes.y_min[k])});
    rest.box.include(unit * Vec2{static_cast<double>(lanes.x_max[k]), static_cast<double>(lanes.y_max[k])});
  }
}

template <class Wall>
void PathScreen::sift(std::span<const Wall> walls, std::size_t first_number, Rest& rest) const {
  if (!usable_) {
    for (std::size_t i = 0; i < walls.size(); ++i) {
      rest.doubtful.push_back(first_number + i);
      rest.box.include(box_of(walls[i].segment()));
    }
  } else if constexpr (std::is_same_v<Wall, PackedWall>) {
    const auto x = step_axis(first_column_, columns_);
    const auto y = step_axis(first_row_, rows_);
    if (x && y) return sift_along(walls, first_number, *x, *y, rest);
    std::vector<FloatWall> floats(walls.size());
    std::transform(walls.begin(), walls.end(), floats.begin(), [](const PackedWall& wall) { return unpacked(wall); });
    sift(std::span<const FloatWall>(floats), first_number, rest);
  } else {
    sift_along(walls, first_number, axis(first_column_, columns_), axis(first_row_, rows_), rest);
  }
}

template void PathScreen::sift(std::span<const PackedWall>, std::size_t, Rest&) const;
template void PathScreen::sift(std::span<const FloatWall>, std::size_t, Rest&) const;
template void PathScreen::sift(std::span<const DoubleWall>, std::size_t, Rest&) const;

}  // namespace warren
