// SPDX-License-Identifier: BSD-3-Clause
// Neighbours in the plane by a uniform grid: the index of choice for points that are not badly clustered (six to ten
// times nanoflann, see bench/neighbours_bench.cpp). Points are kept in cell order; a query reads, for each row of cells
// near it, one run of consecutive points. Points that come in tile order (below) are already sorted, are read where
// they are, and are visited in ascending id. Memory 2 bytes a point in tile order, 26 otherwise. A query costs O(points
// in the square of cells around its disc); points that crowd in few cells make that O(n): use KdTree there
// (neighbours.hpp chooses).
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/instruction_set.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"
#include "spatial/points/neighbour.hpp"

#if defined(__x86_64__) && !defined(WARREN_PLAIN)
#include <emmintrin.h>
#endif

namespace warren::detail {
// Which of some points, up to 64, lie in a disc, as bits: with SSE2 two at a time, else one by one; the same bits.

/// Bit i is set where the squared distance from p to (x[i], y[i]) is at most `square`. There are 1 to 64 points; where
/// their number is odd, one more may be read.
inline std::uint64_t near_bits_plain(const double* x, const double* y, std::uint32_t count, Vec2 p, double square) {
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double dx = x[i] - p.x;
    const double dy = y[i] - p.y;
    bits |= as_whole<std::uint64_t>(dx * dx + dy * dy <= square) << i;
  }
  return bits;
}

/// The same as fast as the machine allows.
inline std::uint64_t near_bits(const double* x, const double* y, std::uint32_t count, Vec2 p, double square) {
#if defined(__x86_64__) && !defined(WARREN_PLAIN)
  const __m128d px = _mm_set1_pd(p.x);
  const __m128d py = _mm_set1_pd(p.y);
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < count; i += 2) {
    const __m128d dx = _mm_sub_pd(_mm_loadu_pd(x + i), px);
    const __m128d dy = _mm_sub_pd(_mm_loadu_pd(y + i), py);
    const __m128d sum = _mm_add_pd(_mm_mul_pd(dx, dx), _mm_mul_pd(dy, dy));
    const int near = _mm_movemask_pd(_mm_cmple_pd(sum, _mm_set1_pd(square)));
    bits |= as_whole<std::uint64_t>(near) << i;
  }
  return bits & (~std::uint64_t{0} >> (64 - count));
#else
  return near_bits_plain(x, y, count, p, square);
#endif
}

/// The k nearest of the few points of a disc, without branches on their distances: gather, then count for each point
/// how many are nearer. Counting compares 32-bit keys, which are all different: the leading bits of the squared
/// distance as a float, and the point's index below them. What such keys cannot tell apart the caller decides in
/// double, so the answer does not depend on them, nor on the instruction set. For 12 points (k = 8) counting costs 40
/// ns, sorting 200 ns.
struct DiscPoints {
  static constexpr std::size_t capacity = 128;
  static constexpr std::uint32_t index_mask = capacity - 1;
  static constexpr std::size_t padding = 16;

  std::size_t count = 0;
  double square[capacity + padding];
  std::uint32_t place[capacity + padding];
  alignas(64) std::int32_t key[capacity + padding];
  alignas(64) std::int32_t rank[capacity + padding];
  std::uint32_t by_rank[capacity];

  /// Adds the points first .. last - 1 but `skip` with squared distances <= limit. There must be room for all.
  void add_run(Vec2 p, double limit, std::span<const Vec2> points, std::uint32_t first, std::uint32_t last,
               std::uint32_t skip) noexcept {
    std::size_t end = count;
    for (std::uint32_t i = first; i < last; ++i) {
      const double dx = points[i].x - p.x;
      const double dy = points[i].y - p.y;
      const double sum = dx * dx + dy * dy;
      square[end] = sum;
      place[end] = i;
      end += as_whole<std::size_t>(sum <= limit) & as_whole<std::size_t>(i != skip);
    }
    count = end;
  }

  /// Fills by_rank with the indices of the points, ordered by the first 16 bits of the mantissa of square * scale,
  /// which is at most about one; returns how many of them may be among the k nearest by (distance, id): all whose key
  /// is at most one step above the k-th, since the roots of squares that are further apart differ. 1 <= k <= count.
  std::size_t sort_roughly(std::size_t k, double scale, InstructionSet set = best_instruction_set()) noexcept;
};

}  // namespace warren::detail

namespace warren {

// The spatial order of milestones. Points are filed in square cells of about two points each; cells are numbered strip
// by strip (a tile is 32 cells wide and as tall as the grid), row by row inside a strip, so that neighbours in the
// plane are mostly neighbours in memory: k-NN queries run 3 to 6 times and searches 5 to 8 times faster than in random
// order. Square tiles and Hilbert order were measured to bring nothing more. Points of one cell keep their input order,
// so the order is a pure function of the points. Cost: two counting-sort passes, about 10 ns a point.

/// The order of points in the plane: the numbers of the first, the second and so on. Coordinates within
/// +-largest_coordinate; below 2^32 points. Throws Stopped.
RawVector<std::uint32_t> tile_order(std::span<const Vec2> positions, const Execution& execution);

/// The cells over a set of points: a pure function of their box and number. Which cell a coordinate falls in never
/// decreases with the coordinate, rounding included; that is all that exact queries need.
class CellFrame {
 public:
  static constexpr std::uint32_t strip_width = 32;

  static constexpr double usual_load = 2.0;

  CellFrame() = default;  ///< one cell
  /// About `usual_load` points a cell if they were spread evenly; at most 3 count / usual_load + 1 cells whatever the
  /// box's shape.
  CellFrame(const Box& box, std::size_t count);

  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }
  std::size_t cell_count() const { return std::size_t{columns_} * rows_; }
  double cell_size() const { return cell_size_; }

  /// Column and row of a coordinate; outside the grid, the nearest one.
  std::uint32_t column(double x) const { return index((x - origin_.x) * scale_, columns_); }
  std::uint32_t row(double y) const { return index((y - origin_.y) * scale_, rows_); }
  /// Number of the first cell of a strip, cells in a row of it, and the number of a cell.
  std::uint32_t strip_begin(std::uint32_t strip) const { return strip * strip_width * rows_; }
  std::uint32_t width_of_strip(std::uint32_t strip) const {
    return std::min(strip_width, columns_ - strip * strip_width);
  }
  std::uint32_t cell(std::uint32_t column, std::uint32_t row) const {
    const std::uint32_t strip = column / strip_width;
    return strip_begin(strip) + row * width_of_strip(strip) + column % strip_width;
  }
  std::uint32_t cell_of(Vec2 p) const { return cell(column(p.x), row(p.y)); }

 private:
  static std::uint32_t index(double t, std::uint32_t count) {
    return bounded_whole<std::uint32_t>(t, 0.0, static_cast<double>(count - 1));
  }

  Vec2 origin_;
  double cell_size_ = 1.0;
  double scale_ = 1.0;
  std::uint32_t columns_ = 1;
  std::uint32_t rows_ = 1;
};

/// Box of the points; empty if there are none.
Box bounding_box(std::span<const Vec2> positions, const Execution& execution);

/// Immutable after construction; any number of threads may query. All answers are exact: the same neighbours, distances
/// and order as brute force over core's distance().
class PointGrid : public NeighboursByVisits<PointGrid, 2> {
 public:
  PointGrid() = default;  ///< no points
  /// Points in tile order, which is best, are not copied: they must outlive the grid. Coordinates finite; below 2^32
  /// points. Throws Stopped.
  PointGrid(std::span<const Vec2> points, const Execution& execution);
  PointGrid(PointGrid&&) = default;
  PointGrid& operator=(PointGrid&&) = default;

  std::size_t size() const { return points_.size(); }
  /// Did the points come in tile order?
  bool in_tile_order() const { return id_.empty(); }

  /// Point `id`, as it came.
  Vec2 point(VertexId id) const { return points_[place_of_.empty() ? id : place_of_[id]]; }
  /// Mean number of points in the cell of a point, itself included: about 3 if they are spread evenly, size() if all
  /// share one cell. What a query costs grows with it. Counted on construction, exactly.
  double crowding() const { return crowding_; }

  /// The k points nearest to p (fewer if there are not so many) but `except`, ascending by (distance, id).
  void nearest(Vec2 p, std::size_t k, VertexId except, std::vector<Neighbour>& out) const;
  /// Calls visit(id, distance) for all points at a distance <= radius from p; ascending by id if in tile order.
  template <class Visit>
  void for_each_within(Vec2 p, const SearchRadius& radius, const Visit& visit) const {
    if (points_.empty() || radius.square() < 0.0) return;
    // Gathered run by run without a branch on their distance, and visited when there are many.
    constexpr std::uint32_t room = 64;
    std::array<std::uint32_t, room> places;
    std::array<double, room> squares;
    std::uint32_t count = 0;
    const auto visit_all = [&] {
      for (std::uint32_t i = 0; i < count; ++i) visit(id_at(places[i]), std::sqrt(squares[i]));
      count = 0;
    };
    for_each_run(window(p, radius.reach()), [&, square = radius.square()](std::uint32_t first, std::uint32_t last) {
      while (first < last) {
        if (count + (last - first) > room) visit_all();
        const std::uint32_t end = first + std::min(room, last - first);
        for (; first < end; ++first) {
          const Vec2 along = points_[first] - p;
          const double sum = along.x * along.x + along.y * along.y;
          places[count] = first;
          squares[count] = sum;
          count += as_whole<std::uint32_t>(sum <= square);
        }
      }
    });
    visit_all();
  }
  /// Calls visit(i, j) for each point i of the range, ascending, and all points j > i at a distance <= radius from it:
  /// over all points, each pair once. Ascending by j if in tile order, where it costs least: a few
  /// cells are looked around once for all of their points.
  template <class Visit>
  void for_each_later_pair(Range ids, const SearchRadius& radius, const Visit& visit) const {
    if (radius.square() < 0.0) return;
    if (!in_tile_order()) return NeighboursByVisits::for_each_later_pair(ids, radius, visit);
    constexpr std::uint32_t cells_together = 4;  // looked around once: fewer looks, but more points for each to compare
    CellCandidates candidates(*this);
    auto i = as_whole<VertexId>(ids.first);
    while (i < ids.last) {
      VertexId end = last_of(i, ids, cells_together);
      bool few = candidates.gather(i, end, radius.reach());
      if (!few) {
        end = last_of(i, ids, 1);
        few = candidates.gather(i, end, radius.reach());
      }
      if (!few) NeighboursByVisits::for_each_later_pair({i, end}, radius, visit);
      for (VertexId v = i; few && v < end; ++v) candidates.visit_later(v, radius.square(), visit);
      i = end;
    }
  }

 private:
  struct Window {  // columns and rows, both ends included
    std::uint32_t left, right, bottom, top;
    bool operator==(const Window&) const = default;
  };
  Window window(Vec2 p, double reach) const {
    return {frame_.column(p.x - reach), frame_.column(p.x + reach), frame_.row(p.y - reach), frame_.row(p.y + reach)};
  }
  Window whole() const { return {0, frame_.columns() - 1, 0, frame_.rows() - 1}; }
  VertexId id_at(std::uint32_t place) const { return id_.empty() ? place : id_[place]; }

  /// Calls run(first, last) for the places of each row of the window, ascending.
  template <class Run>
  void for_each_run(const Window& w, const Run& run) const {
    for (std::uint32_t strip = w.left / CellFrame::strip_width; strip <= w.right / CellFrame::strip_width; ++strip) {
      const std::uint32_t column = strip * CellFrame::strip_width;
      const std::uint32_t width = frame_.width_of_strip(strip);
      const std::uint32_t left = w.left > column ? w.left - column : 0;
      const std::uint32_t right = std::min(w.right - column, width - 1);
      const std::uint32_t* row = begin_.data() + frame_.strip_begin(strip) + std::size_t{w.bottom} * width;
      for (std::uint32_t y = w.bottom; y <= w.top; ++y, row += width) run(row[left], row[right + 1]);
    }
  }

  /// Some points of one cell or of a few, and all later ones that may be within reach of any of them.
  class CellCandidates {
   public:
    explicit CellCandidates(const PointGrid& grid) : grid_(grid) {}

    /// For the points first .. last - 1, which share a cell or a few. False if there are too many.
    bool gather(std::uint32_t first, std::uint32_t last, double reach) {
      first_ = first;
      count_ = 0;
      fits_ = true;
      Box box;
      for (std::uint32_t place = first; place < last; ++place) box.include(grid_.points_[place]);
      const CellFrame& frame = grid_.frame_;
      const Window all{frame.column(box.min.x - reach), frame.column(box.max.x + reach), frame.row(box.min.y - reach),
                       frame.row(box.max.y + reach)};
      // Of the points' own strip only the rows from their own one on hold later points; strips to the left hold none.
      const std::uint32_t strip_left = frame.column(box.min.x) / CellFrame::strip_width * CellFrame::strip_width;
      const std::uint32_t next_strip = strip_left + CellFrame::strip_width;
      const auto add_later = [&](std::uint32_t begin, std::uint32_t end) { add(std::max(begin, first), end); };
      grid_.for_each_run(
          {std::max(all.left, strip_left), std::min(all.right, next_strip - 1), frame.row(box.min.y), all.top},
          add_later);
      if (all.right >= next_strip) grid_.for_each_run({next_strip, all.right, all.bottom, all.top}, add_later);
      return fits_;
    }

    /// Calls visit(place, later place) for the candidates after `place` with a squared distance <= square.
    template <class Visit>
    void visit_later(std::uint32_t place, double square, const Visit& visit) const {
      for (std::uint32_t from = place - first_ + 1; from < count_; from += 64) {
        const std::uint32_t count = std::min(count_ - from, 64U);
        std::uint64_t near = detail::near_bits(&x_[from], &y_[from], count, grid_.points_[place], square);
        for (; near != 0; near &= near - 1)
          visit(place, place_[from + as_whole<std::uint32_t>(std::countr_zero(near))]);
      }
    }

   private:
    static constexpr std::uint32_t room = 256;

    void add(std::uint32_t begin, std::uint32_t end) {
      fits_ = fits_ && (begin >= end || count_ + (end - begin) <= room);
      if (!fits_) return;
      for (; begin < end; ++begin, ++count_) {
        x_[count_] = grid_.points_[begin].x;
        y_[count_] = grid_.points_[begin].y;
        place_[count_] = begin;
      }
    }

    const PointGrid& grid_;
    std::uint32_t first_ = 0;
    std::uint32_t count_ = 0;
    bool fits_ = true;
    std::array<double, room + 2> x_{}, y_{};
    std::array<std::uint32_t, room> place_;
  };

  void sort_points(std::span<const Vec2> points, const Execution& execution);
  bool in_order(std::span<const Vec2> points, const Execution& execution) const;
  void file_points(const Execution& execution);
  /// One past the last point of the range in the cell of point i, or in the group of so many cells (a power of two)
  /// that it belongs to. The points come in tile order.
  VertexId last_of(VertexId i, Range ids, std::uint32_t cells) const {
    const std::size_t cell = frame_.cell_of(point(i)) | (cells - 1);
    return as_whole<VertexId>(std::min<std::size_t>(begin_[std::min(cell + 1, begin_.size() - 1)], ids.last));
  }
  std::size_t nearest_in_disc(Vec2 p, const Window& w, double square, std::size_t k, VertexId except,
                              std::vector<Neighbour>& out) const;
  void nearest_in_window(Vec2 p, const Window& w, double square, std::size_t k, VertexId except,
                         std::vector<Neighbour>& out) const;

  double first_reach(std::size_t k) const;

  CellFrame frame_;
  double crowding_ = 0.0;
  std::array<double, 49> first_reach_{};  // by k: two roots saved in each query
  std::span<const Vec2> points_;          // in cell order
  RawVector<Vec2> sorted_;                // what points_ refers to, unless they came in tile order
  RawVector<std::uint32_t> begin_;        // place of the first point of each cell, and the number of points
  RawVector<VertexId> id_;                // of each place; empty: the place
  RawVector<std::uint32_t> place_of_;     // of each id; empty: the id
};

}  // namespace warren
