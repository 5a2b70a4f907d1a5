// SPDX-License-Identifier: BSD-3-Clause
// The grid behind WallIndex: walls filed by the midpoint of each piece of at most one cell's length, copied into cell
// order, rows of cells contiguous. A query reads, for each row of cells that its box grown by half a cell meets, one
// contiguous run of walls. A cell that stays crowded is given a finer grid of its own.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "core/plane/wall_set.hpp"

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

}  // namespace warren
