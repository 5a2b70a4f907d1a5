// SPDX-License-Identifier: BSD-3-Clause
// The free points of a lattice in tile order, without sorting: columns and rows fall into the cells of the order's
// frame independently of each other, so strip by strip the points can be written down where they belong. The same
// milestones in the same order as filtering, joining and sorting the samples gives
// (tests/planners/roadmap/lattice_milestones_test.cpp), in a third of the time and a quarter of the memory. One pass
// marks the free points, a bit each; one counts them strip by strip; one writes. 16 bytes a milestone and a bit a
// point.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "spatial/points/tile_order.hpp"

namespace warren {
namespace detail {

/// A wall near the border of two chunks is looked at by both, so a chunk has some rows at least.
inline std::size_t lattice_rows_a_chunk(LatticeSize size) {
  constexpr std::size_t points = std::size_t{1} << 15;
  constexpr std::size_t least = 32;
  return points / size.cols + least;
}

/// Which points of the lattice are free: rows of whole words.
class LatticeBits {
 public:
  /// The free ones of the first `count` points, row by row.
  template <World W>
  LatticeBits(const W& world, LatticeSize size, std::uint64_t count, const Execution& execution);

  LatticeSize size() const { return size_; }
  std::uint64_t count() const { return count_; }
  const Box& box() const { return box_; }  ///< of the free points; empty if there are none

  bool operator()(std::uint32_t row, std::uint32_t col) const { return (word(row, col / 64) >> (col % 64) & 1) != 0; }
  /// Calls visit(col) for the free points of a row in the columns first .. last - 1, ascending.
  template <class Visit>
  void for_each_in_row(std::uint32_t row, std::uint32_t first, std::uint32_t last, const Visit& visit) const {
    for (std::uint32_t w = first / 64; w * 64 < last; ++w) {
      for (std::uint64_t rest = word(row, w) & columns_mask(w, first, last); rest != 0; rest &= rest - 1) {
        visit(w * 64 + static_cast<std::uint32_t>(std::countr_zero(rest)));
      }
    }
  }
  std::uint64_t count_in_row(std::uint32_t row, std::uint32_t first, std::uint32_t last) const {
    std::uint64_t sum = 0;
    for (std::uint32_t w = first / 64; w * 64 < last; ++w) {
      sum += static_cast<std::uint64_t>(std::popcount(word(row, w) & columns_mask(w, first, last)));
    }
    return sum;
  }

 private:
  /// Columns of a row that are among the first `count` points.
  std::uint64_t cols_of(std::size_t row, std::uint64_t count) const {
    const std::uint64_t first = row * size_.cols;
    return std::min<std::uint64_t>(size_.cols, count - std::min(count, first));
  }
  /// Sets the bits of the free ones of the first `count` points in some rows.
  template <World W>
  void fill_rows(const W& world, Range rows, std::uint64_t count);
  /// The box of a row's free points; empty where there are none.
  Box box_of_row(std::size_t row) const;
  /// The bits of word w that stand for columns first .. last - 1.
  static std::uint64_t columns_mask(std::uint32_t w, std::uint32_t first, std::uint32_t last) {
    std::uint64_t mask = ~std::uint64_t{0};
    if (first > w * 64) mask <<= first - w * 64;
    if (last < w * 64 + 64) mask &= (std::uint64_t{1} << (last - w * 64)) - 1;
    return mask;
  }
  std::uint64_t word(std::uint32_t row, std::uint32_t w) const { return words_[std::size_t{row} * words_a_row_ + w]; }

  LatticeSize size_;
  std::size_t words_a_row_;
  RawVector<std::uint64_t> words_;
  std::uint64_t count_ = 0;
  Box box_;
};

template <World W>
LatticeBits::LatticeBits(const W& world, LatticeSize size, std::uint64_t count, const Execution& execution)
    : size_(size), words_a_row_((std::size_t{size.cols} + 63) / 64), words_(words_a_row_ * size.rows) {
  const std::size_t grain = lattice_rows_a_chunk(size);
  struct Part {
    std::uint64_t count = 0;
    Box box;
  };
  std::vector<Part> parts(chunk_count(size.rows, grain));
  for_chunks(size.rows, grain, execution, [&](Range r) {
    fill_rows(world, r, count);
    Part part;
    for (std::size_t row = r.first; row < r.last; ++row) {
      part.count += count_in_row(static_cast<std::uint32_t>(row), 0, size.cols);
      part.box.include(box_of_row(row));
    }
    parts[r.first / grain] = part;
  });
  for (const Part& part : parts) {
    count_ += part.count;
    box_.include(part.box);
  }
}

inline Box LatticeBits::box_of_row(std::size_t row) const {
  const std::span<const std::uint64_t> words(&words_[row * words_a_row_], words_a_row_);
  const auto is_set = [](std::uint64_t word) { return word != 0; };
  const auto first = std::find_if(words.begin(), words.end(), is_set);
  if (first == words.end()) return {};
  const auto last = std::find_if(words.rbegin(), words.rend(), is_set);
  const auto low = (first - words.begin()) * 64 + std::countr_zero(*first);
  const auto high = (words.rend() - last) * 64 - 1 - std::countl_zero(*last);
  const double y = static_cast<double>(row) + 1.0;
  return {{static_cast<double>(low) + 1.0, y}, {static_cast<double>(high) + 1.0, y}};
}

template <World W>
void LatticeBits::fill_rows(const W& world, Range rows, std::uint64_t count) {
  const std::span<std::uint64_t> words(&words_[rows.first * words_a_row_], rows.size() * words_a_row_);
  std::fill(words.begin(), words.end(), std::uint64_t{0});
  auto query = world.make_query();
  for (std::size_t row = rows.first; row < rows.last; ++row) {
    const std::uint64_t cols = cols_of(row, count);
    std::uint64_t* const its_words = &words_[row * words_a_row_];
    for (std::uint64_t col = 0; col < cols; ++col) {
      const Vec2 point{static_cast<double>(col + 1), static_cast<double>(row) + 1.0};
      its_words[col / 64] |= std::uint64_t{world.is_free(point, query)} << (col % 64);
    }
  }
}

/// The free points in tile order: strips of the frame's columns, in a strip rows of cells, in a row cells, in a cell
/// the points row by row.
class LatticeInTileOrder {
 public:
  LatticeInTileOrder(const LatticeBits& free, const Execution& execution)
      : free_(free), execution_(execution), frame_(free.box(), free.count()) {
    for (std::uint32_t col = 0; col < free.size().cols; ++col) {
      const std::uint32_t strip = cell_column(col) / CellFrame::strip_width;
      while (strip_begin_.size() <= strip) strip_begin_.push_back(col);
    }
    strip_begin_.push_back(free.size().cols);
  }

  RawVector<Vec2> points(std::size_t spare) const;

 private:
  std::size_t strips() const { return strip_begin_.size() - 1; }
  std::uint32_t cell_column(std::uint32_t col) const { return frame_.column(static_cast<double>(col) + 1.0); }
  std::uint32_t cell_row(std::uint32_t row) const { return frame_.row(static_cast<double>(row) + 1.0); }
  std::vector<std::size_t> places() const;
  Vec2* write_strip(std::uint32_t strip, Vec2* out) const;
  Vec2* write_cells(std::uint32_t strip, std::uint32_t first_row, std::uint32_t last_row, Vec2* out) const;
  Vec2* write_row(std::uint32_t row, std::uint32_t first, std::uint32_t last, Vec2* out) const;

  const LatticeBits& free_;
  const Execution& execution_;
  CellFrame frame_;
  std::vector<std::uint32_t> strip_begin_;  // first column of each strip, and the number of columns
};

/// Where each strip's points begin, and how many there are.
inline std::vector<std::size_t> LatticeInTileOrder::places() const {
  std::vector<std::size_t> first(strips() + 1, 0);
  for_chunks(strips(), 1, execution_, [&](Range r) {
    std::uint64_t sum = 0;
    for (std::uint32_t row = 0; row < free_.size().rows; ++row) {
      sum += free_.count_in_row(row, strip_begin_[r.first], strip_begin_[r.first + 1]);
    }
    first[r.first + 1] = sum;
  });
  for (std::size_t strip = 0; strip < strips(); ++strip) first[strip + 1] += first[strip];
  return first;
}

inline RawVector<Vec2> LatticeInTileOrder::points(std::size_t spare) const {
  const std::vector<std::size_t> first = places();
  execution_.reserve((first.back() + spare) * sizeof(Vec2));
  RawVector<Vec2> points;
  points.reserve(first.back() + spare);
  points.resize(first.back());
  for_chunks(strips(), 1, execution_,
             [&](Range r) { write_strip(static_cast<std::uint32_t>(r.first), points.data() + first[r.first]); });
  return points;
}

inline Vec2* LatticeInTileOrder::write_strip(std::uint32_t strip, Vec2* out) const {
  const std::uint32_t rows = free_.size().rows;
  for (std::uint32_t row = 0; row < rows;) {
    std::uint32_t last = row + 1;
    while (last < rows && cell_row(last) == cell_row(row)) ++last;
    out = last == row + 1 ? write_row(row, strip_begin_[strip], strip_begin_[strip + 1], out)
                          : write_cells(strip, row, last, out);
    row = last;
  }
  return out;
}

/// Rows that share their cells: cell by cell.
inline Vec2* LatticeInTileOrder::write_cells(std::uint32_t strip, std::uint32_t first_row, std::uint32_t last_row,
                                             Vec2* out) const {
  const std::uint32_t end = strip_begin_[strip + 1];
  for (std::uint32_t col = strip_begin_[strip]; col < end;) {
    std::uint32_t last = col + 1;
    while (last < end && cell_column(last) == cell_column(col)) ++last;
    for (std::uint32_t row = first_row; row < last_row; ++row) out = write_row(row, col, last, out);
    col = last;
  }
  return out;
}

inline Vec2* LatticeInTileOrder::write_row(std::uint32_t row, std::uint32_t first, std::uint32_t last,
                                           Vec2* out) const {
  free_.for_each_in_row(row, first, last, [&](std::uint32_t col) {
    *out++ = {static_cast<double>(col) + 1.0, static_cast<double>(row) + 1.0};
  });
  return out;
}

}  // namespace detail

/// The free ones of the first `count` points of the lattice, in tile order; room for `spare` more. Throws InputError
/// for a lattice with more points than milestones can be numbered, and Stopped.
template <World W>
RawVector<Vec2> lattice_milestones(const W& world, LatticeSize size, std::uint64_t count, const Execution& execution,
                                   std::size_t spare) {
  if (std::uint64_t{size.rows} * size.cols > std::uint64_t{1} << 31) {
    throw InputError("lattice", "has more than 2^31 cells; use the tiled pipeline");
  }
  execution.reserve(std::size_t{size.rows} * (size.cols / 8 + 8));
  const detail::LatticeBits free(world, size, count, execution);
  return detail::LatticeInTileOrder(free, execution).points(spare);
}

}  // namespace warren
