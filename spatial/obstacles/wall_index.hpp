// SPDX-License-Identifier: BSD-3-Clause
// Where the walls are. A uniform grid over any segments: crossing, overlapping, collinear, of length zero, long and
// short, in any order.
//
// Cell size h, chosen from the data: the mean gap between walls (area / total length) or the square root of area a
// wall, whichever is smaller, and the walls' median length where that is near. Each wall is cut into pieces of at most
// h an axis, each piece is filed under the cell of its midpoint, and a query grows its box by half a piece. Bounds,
// for N walls: h is raised until the pieces are at most 5 N + 65536 and the cells at most 2 N + 65536, so long walls in
// a fine grid can't blow up memory; a cell with more than 64 short pieces gets a finer grid of its own, at most
// 16 deep and only where that shrinks them, so short walls in a coarse grid can't blow up time.
//
// Build: two passes of counting sort, first into bands of rows, then within each band in cache; no atomics, the same
// arrays for any thread count. 16 bytes a piece (32 for walls that are not exact in float) and 4 a cell.
// Measured in bench/wall_index_bench.cpp. Lost: one entry in each cell that a wall meets (faster queries by a third,
// twice the memory and three times the build), packed R-tree (queries 10 times slower).
//
// Up to sixteen motions near each other as boxes side by side, and the walls that may matter to each of them. Every
// wall near the bunch is held against all boxes at once, without a branch; each motion remembers how many walls meet
// its box, and the first and the last of them. Most motions are left with none or one, which the caller puts to the
// exact test. A motion of a roadmap costs 8 to 20 ns this way, 40 to 75 alone (connect in bench/connection_bench.cpp).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/base/instruction_set.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"

namespace warren {
// Does a wall's box meet a query's box? The question that nine of ten walls near a motion fail, asked of all four
// coordinates at once and with one branch (keeps_clearance in bench/wall_index_bench.cpp). Exact for walls in double;
// for walls in float the query's box is rounded outward once, so that no wall is missed.

namespace detail {
/// Four coordinates as one vector of the compiler's own kind (g++ and clang++ have them for every machine), what its
/// comparisons give, and the same bits as words of 64.
template <class T>
struct FourOf {
  using Ends [[gnu::vector_size(4 * sizeof(T))]] = T;
  using Flags [[gnu::vector_size(4 * sizeof(T))]] = std::conditional_t<std::is_same_v<T, float>, int, long long>;
  using Words [[gnu::vector_size(4 * sizeof(T))]] = long long;
};
}  // namespace detail

template <class T>
class BoxScreen {
 public:
  using Four = typename detail::FourOf<T>::Ends;
  using FourDoubles = typename detail::FourOf<double>::Ends;

  explicit BoxScreen(const Box& box) {
    Four corners{};
    outward(FourDoubles{box.min.x, box.min.y, box.max.x, box.max.y}, Four{-1, -1, 1, 1}, corners);
    low_ = Four{corners[0], corners[1], corners[0], corners[1]};
    high_ = Four{corners[2], corners[3], corners[2], corners[3]};
  }

  /// Four coordinates in T, moved down where the direction is -1 and up where it is 1: by less than two units in the
  /// last place and half a one of the smallest numbers, from wherever rounding, or the end of the range, had put them.
  static void outward(const FourDoubles& given, const Four& directions, Four& moved) noexcept {
    if constexpr (std::is_same_v<T, double>) {
      moved = given;
    } else {
      constexpr T largest = std::numeric_limits<T>::max();
      Four near = __builtin_convertvector(given, Four);
      near = near > largest ? Four{} + largest : near;
      near = near < -largest ? Four{} - largest : near;
      const Four sizes = near < 0 ? -near : near;
      moved = near + directions * (sizes * std::numeric_limits<T>::epsilon() + std::numeric_limits<T>::min());
    }
  }

  bool meets(const WallOf<T>& wall) const noexcept {
    Four ends;
    std::memcpy(&ends, &wall, sizeof ends);
    const Flags left = ends < low_;  // -1 where it holds: both ends left of, or both below, the box
    const Flags right = ends > high_;
    return (both(left) | both(right)) == 0;
  }

 private:
  using Flags = typename detail::FourOf<T>::Flags;
  using Words = typename detail::FourOf<T>::Words;

  /// Nonzero where the flags of x, or those of y, are set for both ends.
  static long long both(const Flags& flags) noexcept {
    const auto words = reinterpret_cast<Words>(flags);
    if constexpr (std::is_same_v<T, float>) {
      return words[0] & words[1];
    } else {
      return (words[0] & words[2]) | (words[1] & words[3]);
    }
  }
  Four low_;
  Four high_;
};

/// Walls filed by the midpoint of each piece of at most one cell's length, copied into cell order, rows of cells
/// contiguous. A query reads, for each row of cells that its box grown by half a cell meets, one contiguous run of
/// walls. A cell that stays crowded is given a finer grid of its own.
template <class T>
class WallGrid {
 public:
  /// Calls visit(const Segment&) for every wall whose box meets `box` (walls in float: the box rounded outward), some
  /// twice, rows upwards, until it returns false. Returns false if it was stopped.
  template <class Visit>
  bool for_each_near(const Box& box, const Visit& visit) const {
    const BoxScreen<T> screen(box);
    const auto first_row = row_of(box.min.y - reach_.y);
    const auto last_row = row_of(box.max.y + reach_.y);
    const auto first_col = col_of(box.min.x - reach_.x);
    const auto last_col = col_of(box.max.x + reach_.x);
    for (std::uint32_t row = first_row; row <= last_row; ++row) {
      if (!visit_run(row, first_col, last_col, box, screen, visit)) return false;
    }
    return true;
  }

  /// The same for the walls near the segment a-b grown by r: in each row only the cells that the segment passes.
  template <class Visit>
  bool for_each_along(const Segment& s, double r, const Visit& visit) const {
    const Box box = box_of(s).grown(r);
    if (box.height() <= 4 * cell_ || box.width() <= 4 * cell_) return for_each_near(box, visit);
    const BoxScreen<T> screen(box);
    const std::uint32_t last_row = row_of(box.max.y + reach_.y);
    const double slope = (s.b.x - s.a.x) / (s.b.y - s.a.y);
    for (std::uint32_t row = row_of(box.min.y - reach_.y); row <= last_row; ++row) {
      const double low = origin_.y + row * cell_ - reach_.y - r;
      const double high = low + cell_ + 2 * (reach_.y + r);
      const double x1 = s.a.x + slope * (low - s.a.y);
      const double x2 = s.a.x + slope * (high - s.a.y);
      const double margin = reach_.x + r + 1e-9 * (cell_ + std::abs(x1) + std::abs(x2));
      const std::uint32_t first_col = col_of(std::max(box.min.x - reach_.x, std::min(x1, x2) - margin));
      const std::uint32_t last_col = col_of(std::min(box.max.x + reach_.x, std::max(x1, x2) + margin));
      if (!visit_run(row, first_col, last_col, box, screen, visit)) return false;
    }
    return true;
  }

  /// Copies to `out` the walls of all cells that for_each_near would look at, in its order, and returns how many;
  /// no_room if they are more than `room`, or if the cells around the box have finer grids.
  std::size_t copy_near(const Box& box, WallOf<T>* out, std::size_t room) const noexcept {
    if (!child_of_.empty()) return no_room;
    const std::size_t last_row = row_of(box.max.y + reach_.y);
    const std::size_t first_col = col_of(box.min.x - reach_.x);
    const std::size_t last_col = col_of(box.max.x + reach_.x);
    std::size_t count = 0;
    for (std::size_t row = row_of(box.min.y - reach_.y); row <= last_row; ++row) {
      const std::uint32_t first = offsets_[row * cols_ + first_col];
      const std::uint32_t last = offsets_[row * cols_ + last_col + 1];
      if (count + (last - first) > room) return no_room;
      std::copy(walls_.data() + first, walls_.data() + last, out + count);
      count += last - first;
    }
    fetch_rows_above(last_row, first_col, last_col);
    return count;
  }
  static constexpr std::size_t no_room = std::numeric_limits<std::size_t>::max();

  double cell() const { return cell_; }
  /// Walls in cell order, long ones once a piece.
  std::size_t filed_count() const { return walls_.size(); }
  Segment filed(std::size_t i) const { return walls_[i].segment(); }
  std::size_t bytes() const {
    std::size_t total = offsets_.size() * sizeof(std::uint32_t) + walls_.size() * sizeof(WallOf<T>) +
                        child_of_.size() * sizeof(std::uint32_t);
    for (const WallGrid& child : children_) total += child.bytes();
    return total;
  }

 private:
  template <class U>
  friend class WallGridBuilder;

  static constexpr std::uint32_t no_child = 0xffffffffU;

  std::uint32_t clamped(double cell, std::uint32_t count) const {
    return bounded_whole<std::uint32_t>(cell, 0.0, count - 1.0);
  }
  std::uint32_t col_of(double x) const { return clamped((x - origin_.x) * inverse_cell_, cols_); }
  std::uint32_t row_of(double y) const { return clamped((y - origin_.y) * inverse_cell_, rows_); }

  /// Asks for the cells above, which motions in tile order come to next: their walls, and further up their offsets,
  /// without which their walls can't be asked for.
  void fetch_rows_above(std::size_t row, std::size_t first_col, std::size_t last_col) const noexcept {
    constexpr std::size_t line = 64 / sizeof(WallOf<T>);
    if (row + 4 >= rows_) return;
    for (std::size_t above = row + 1; above <= row + 2; ++above) {
      const std::uint32_t last = offsets_[above * cols_ + last_col];
      for (std::uint32_t i = offsets_[above * cols_ + first_col]; i <= last; i += line)
        __builtin_prefetch(walls_.data() + i);
    }
    __builtin_prefetch(offsets_.data() + (row + 3) * cols_ + first_col);
    __builtin_prefetch(offsets_.data() + (row + 4) * cols_ + first_col);
  }

  template <class Visit>
  bool visit_run(std::uint32_t row, std::uint32_t first_col, std::uint32_t last_col, const Box& box,
                 const BoxScreen<T>& screen, const Visit& visit) const {
    const std::size_t base = std::size_t{row} * cols_;
    if (child_of_.empty()) return visit_walls(base + first_col, base + last_col, screen, visit);
    for (std::size_t cell = base + first_col; cell <= base + last_col; ++cell) {
      const std::uint32_t child = child_of_[cell];
      const bool goes_on =
          child == no_child ? visit_walls(cell, cell, screen, visit) : children_[child].for_each_near(box, visit);
      if (!goes_on) return false;
    }
    return true;
  }

  template <class Visit>
  bool visit_walls(std::size_t first_cell, std::size_t last_cell, const BoxScreen<T>& screen,
                   const Visit& visit) const {
    for (std::uint32_t i = offsets_[first_cell], end = offsets_[last_cell + 1]; i < end; ++i) {
      if (screen.meets(walls_[i]) && !visit(walls_[i].segment())) return false;
    }
    return true;
  }

  Vec2 origin_;
  Vec2 reach_;  ///< no piece's midpoint is farther than this from any point of the piece, an axis
  double cell_ = 1.0;
  double inverse_cell_ = 1.0;
  std::uint32_t cols_ = 1;
  std::uint32_t rows_ = 1;
  RawVector<std::uint32_t> offsets_;   ///< cols * rows + 1
  RawVector<WallOf<T>> walls_;         ///< in cell order
  RawVector<std::uint32_t> child_of_;  ///< a cell's finer grid, or no_child; empty if no cell has one
  std::vector<WallGrid> children_;
};

/// Immutable after construction; any number of threads may query.
class WallIndex {
 public:
  /// Copies what it keeps; `more` are further walls (the bounds). Throws Stopped at the deadline or before memory would
  /// pass its limit, InputError for more than 2^31 walls. O(N).
  WallIndex(const WallSet& walls, std::span<const Segment> more, const Execution& execution);
  WallIndex(const WallSet& walls, const Execution& execution) : WallIndex(walls, {}, execution) {}

  std::size_t wall_count() const { return wall_count_; }
  /// Box of all walls; empty if there are none.
  const Box& box() const { return box_; }
  std::size_t bytes() const;
  /// At most `most` walls, spread evenly over the index; long ones come more often.
  std::vector<Segment> some_walls(std::size_t most) const;

  /// Does the closed segment a-b touch a wall? Exact.
  bool blocks(Vec2 a, Vec2 b) const noexcept;
  /// Distance from p to the nearest wall, or at_most if none is nearer.
  double clearance(Vec2 p, double at_most = std::numeric_limits<double>::infinity()) const noexcept;
  /// Is every point of a-b at least r from every wall? r > 0: distance >= r, in double. r = 0: same as !blocks(a, b).
  bool keeps_clearance(Vec2 a, Vec2 b, double r) const noexcept;
  /// The same for up to most_motions motions: bit i is set if the i-th keeps its distance. Best for motions near each
  /// other: the walls around all of them are looked up once, and held against all of them at once.
  std::uint32_t keep_clearance(std::span<const Segment> motions, double r) const noexcept;
  static constexpr std::size_t most_motions = 16;

  /// Calls visit(const Segment&) -> bool for each wall whose own box meets `box`, some more than once, and perhaps for
  /// others nearby, in an order that depends on the walls alone; stops when visit returns false.
  template <class Visit>
  void for_each_near(const Box& box, const Visit& visit) const {
    std::visit([&](const auto& grid) { grid.for_each_near(box, visit); }, grid_);
  }

 private:
  std::size_t wall_count_ = 0;
  Box box_;
  std::variant<WallGrid<float>, WallGrid<double>> grid_;
};

/// Is the distance between the segments at least r? r > 0. The plain double test that every faster one must agree with.
bool segments_keep_distance(const Segment& s, const Segment& t, double r) noexcept;

namespace detail {

/// Scratch of one thread. The same answers as one BoxScreen a motion, with any instruction set.
template <class T>
class MotionBunch {
 public:
  static constexpr std::size_t most = 16;
  using Index = std::conditional_t<std::is_same_v<T, float>, std::int32_t, std::int64_t>;

  /// The motions' boxes, each grown by r; at most `most`.
  MotionBunch(std::span<const Segment> motions, double r) {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    std::array<double, most> left, bottom, right, top;
    left.fill(nowhere);
    bottom.fill(nowhere);
    right.fill(-nowhere);
    top.fill(-nowhere);
    const Two growth = Two{} + r;
    Two low = Two{} + nowhere;
    Two high = Two{} - nowhere;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      Two from;
      Two to;
      std::memcpy(&from, &motions[i].a, sizeof from);
      std::memcpy(&to, &motions[i].b, sizeof to);
      const Two min = (from < to ? from : to) - growth;
      const Two max = (from > to ? from : to) + growth;
      left[i] = min[0];
      bottom[i] = min[1];
      right[i] = max[0];
      top[i] = max[1];
      low = low < min ? low : min;
      high = high > max ? high : max;
    }
    around_ = {{low[0], low[1]}, {high[0], high[1]}};
    round_outward(left, -1, left_);
    round_outward(bottom, -1, bottom_);
    round_outward(right, 1, right_);
    round_outward(top, 1, top_);
  }

  /// The box of all the motions' boxes.
  const Box& around() const { return around_; }

  /// Holds the walls against all boxes.
  void sift(std::span<const WallOf<T>> walls, InstructionSet set = best_instruction_set()) noexcept;

  /// How many of the walls meet the box of motion i, and which is the first and the last of them.
  std::size_t count(std::size_t i) const { return as_whole<std::size_t>(count_[i]); }
  std::size_t first(std::size_t i) const { return as_whole<std::size_t>(first_[i]); }
  std::size_t last(std::size_t i) const { return as_whole<std::size_t>(last_[i]); }

 private:
  using Ends = std::array<T, most>;
  using Two = double __attribute__((vector_size(16)));

  static void round_outward(const std::array<double, most>& given, T direction, Ends& ends) {
    using Screen = BoxScreen<T>;
    for (std::size_t i = 0; i < most; i += 4) {
      typename Screen::Four rounded{};
      Screen::outward(typename Screen::FourDoubles{given[i], given[i + 1], given[i + 2], given[i + 3]},
                      typename Screen::Four{} + direction, rounded);
      std::memcpy(&ends[i], &rounded, sizeof rounded);
    }
  }

  template <std::size_t bytes>
  static void sift_with(MotionBunch& bunch, std::span<const WallOf<T>> walls);

  Box around_;
  alignas(64) Ends left_, bottom_, right_, top_;
  alignas(64) std::array<Index, most> count_, first_, last_;
};

}  // namespace detail

}  // namespace warren
