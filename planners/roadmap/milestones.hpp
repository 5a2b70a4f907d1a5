// SPDX-License-Identifier: BSD-3-Clause
// Draws the milestones of a roadmap: samples are pure functions of (seed, index), the free ones are kept and numbered
// tile by tile, which is worth 3 to 6 times in neighbour queries and 5 to 8 in search. O(samples); in the plane 16
// bytes a milestone, and 40 a sample while sorting.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/roadmap/sampler.hpp"
#include "spatial/points/point_grid.hpp"

namespace warren {

/// The index-th point of the lattice (1..cols) x (1..rows), row by row.
constexpr Vec2 lattice_point(LatticeSize size, std::uint64_t index) {
  return {static_cast<double>(index % size.cols + 1), static_cast<double>(index / size.cols + 1)};
}

/// The unit square cut into `count` strata: rows of equal height, as many as make the strata of a box of this height
/// over width about square; each row cut evenly, so that there are exactly `count`.
class Strata {
 public:
  /// The strata first .. next - 1 are a row.
  struct Row {
    std::uint64_t number = 0;
    std::uint64_t first = 0;
    std::uint64_t next = 0;
  };
  Strata(std::uint64_t count, double height_over_width) : count_(count) {
    const auto n = static_cast<double>(count);
    rows_ = static_cast<std::uint64_t>(std::clamp(std::round(std::sqrt(n * height_over_width)), 1.0, n));
  }
  Row row_of(std::uint64_t index) const {
    const std::uint64_t row = std::min(index * rows_ / count_, rows_ - 1);
    return {row, (row * count_ + rows_ - 1) / rows_, ((row + 1) * count_ + rows_ - 1) / rows_};
  }
  /// A random point in a stratum of this row.
  std::array<double, 2> point(std::uint64_t seed, std::uint64_t index, const Row& row) const {
    return {
        (static_cast<double>(index - row.first) + uniform(seed, index, 0)) / static_cast<double>(row.next - row.first),
        (static_cast<double>(row.number) + uniform(seed, index, 1)) / static_cast<double>(rows_)};
  }

 private:
  std::uint64_t count_;
  std::uint64_t rows_;
};

namespace detail {

/// A wall near the border of two chunks is looked at by both, so a chunk has some rows at least.
inline std::size_t lattice_rows_a_chunk(LatticeSize size) {
  constexpr std::size_t points = std::size_t{1} << 15;
  constexpr std::size_t least = 32;
  return points / size.cols + least;
}

/// The free ones of some points of the lattice.
struct FreeLattice {
  Bitmap points;  ///< a bit a point, row by row
  Box box;        ///< of those that are set; empty if there are none
};

/// Of the first `count` points, row by row.
template <World W>
FreeLattice free_lattice(const W& world, LatticeSize size, std::uint64_t count, const Execution& execution) {
  FreeLattice free{Bitmap(size.cols, size.rows, false, [&] { execution.check(); }), {}};
  const std::vector<Box> boxes = parts_of_chunks(size.rows, lattice_rows_a_chunk(size), execution, [&](Range rows) {
    auto query = world.make_query();
    std::array<Vec2, bunch_size> bunch;
    Box box;
    for (std::size_t row = rows.first; row < rows.last; ++row) {
      const std::span<std::uint64_t> words = free.points.row(static_cast<std::uint32_t>(row));
      const double y = static_cast<double>(row) + 1.0;
      const std::uint64_t cols = std::min<std::uint64_t>(size.cols, count - std::min(count, row * size.cols));
      std::uint64_t first = cols;  // of the free ones of the row
      std::uint64_t last = 0;
      for (std::uint64_t col = 0; col < cols; col += bunch_size) {
        const auto held = static_cast<std::size_t>(std::min<std::uint64_t>(bunch_size, cols - col));
        for (std::size_t i = 0; i < held; ++i) bunch[i] = {static_cast<double>(col + i + 1), y};
        const std::uint64_t bits = world.free_states({bunch.data(), held}, query);
        if (bits == 0) continue;
        words[col / 64] |= bits << (col % 64);
        first = std::min(first, col + static_cast<std::uint64_t>(std::countr_zero(bits)));
        last = col + static_cast<std::uint64_t>(63 - std::countl_zero(bits));
      }
      if (first < cols) box.include({{static_cast<double>(first) + 1.0, y}, {static_cast<double>(last) + 1.0, y}});
    }
    return box;
  });
  for (const Box& box : boxes) free.box.include(box);
  return free;
}

/// The free points in tile order: strips of the frame's columns, in a strip rows of cells, in a row cells, in a cell
/// the points row by row.
class LatticeInTileOrder {
 public:
  LatticeInTileOrder(const FreeLattice& free, const Execution& execution)
      : free_(free.points), execution_(execution), frame_(free.box, free.points.count()) {
    for (std::uint32_t col = 0; col < free_.width(); ++col) {
      const std::uint32_t strip = cell_column(col) / CellFrame::strip_width;
      while (strip_begin_.size() <= strip) strip_begin_.push_back(col);
    }
    strip_begin_.push_back(free_.width());
  }

  RawVector<Vec2> points(std::size_t spare) const {
    const std::vector<std::size_t> first = places();
    execution_.reserve((first.back() + spare) * sizeof(Vec2));
    RawVector<Vec2> points;
    points.reserve(first.back() + spare);
    points.resize(first.back());
    for_chunks(strips(), 1, execution_,
               [&](Range r) { write_strip(static_cast<std::uint32_t>(r.first), points.data() + first[r.first]); });
    return points;
  }

 private:
  std::size_t strips() const { return strip_begin_.size() - 1; }
  std::uint32_t cell_column(std::uint32_t col) const { return frame_.column(static_cast<double>(col) + 1.0); }
  std::uint32_t cell_row(std::uint32_t row) const { return frame_.row(static_cast<double>(row) + 1.0); }
  /// Where each strip's points begin, and how many there are.
  std::vector<std::size_t> places() const {
    std::vector<std::size_t> first(strips() + 1, 0);
    for_chunks(strips(), 1, execution_, [&](Range r) {
      std::size_t sum = 0;
      for (std::uint32_t row = 0; row < free_.height(); ++row) {
        for_each_word(row, strip_begin_[r.first], strip_begin_[r.first + 1],
                      [&](std::uint32_t, std::uint64_t word) { sum += static_cast<std::size_t>(std::popcount(word)); });
      }
      first[r.first + 1] = sum;
    });
    for (std::size_t strip = 0; strip < strips(); ++strip) first[strip + 1] += first[strip];
    return first;
  }
  Vec2* write_strip(std::uint32_t strip, Vec2* out) const {
    const std::uint32_t rows = free_.height();
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
  Vec2* write_cells(std::uint32_t strip, std::uint32_t first_row, std::uint32_t last_row, Vec2* out) const {
    const std::uint32_t end = strip_begin_[strip + 1];
    for (std::uint32_t col = strip_begin_[strip]; col < end;) {
      std::uint32_t last = col + 1;
      while (last < end && cell_column(last) == cell_column(col)) ++last;
      for (std::uint32_t row = first_row; row < last_row; ++row) out = write_row(row, col, last, out);
      col = last;
    }
    return out;
  }
  Vec2* write_row(std::uint32_t row, std::uint32_t first, std::uint32_t last, Vec2* out) const {
    for_each_word(row, first, last, [&](std::uint32_t begin, std::uint64_t rest) {
      for (; rest != 0; rest &= rest - 1) {
        const std::uint32_t col = begin + static_cast<std::uint32_t>(std::countr_zero(rest));
        *out++ = {static_cast<double>(col) + 1.0, static_cast<double>(row) + 1.0};
      }
    });
    return out;
  }
  /// Calls visit(begin, word) for the words of a row that have columns first .. last - 1: bit i is column begin + i,
  /// and those of other columns are 0.
  template <class Visit>
  void for_each_word(std::uint32_t row, std::uint32_t first, std::uint32_t last, const Visit& visit) const {
    const std::span<const std::uint64_t> words = free_.row(row);
    for (std::uint32_t begin = first / 64 * 64; begin < last; begin += 64) {
      std::uint64_t mask = ~std::uint64_t{0};
      if (first > begin) mask <<= first - begin;
      if (last < begin + 64) mask &= (std::uint64_t{1} << (last - begin)) - 1;
      visit(begin, words[begin / 64] & mask);
    }
  }

  const Bitmap& free_;
  const Execution& execution_;
  CellFrame frame_;
  std::vector<std::uint32_t> strip_begin_;  // first column of each strip, and the number of columns
};

}  // namespace detail

/// The free points of a lattice in tile order, without sorting: columns and rows fall into the cells of the order's
/// frame independently of each other, so strip by strip the points can be written down where they belong. The same
/// milestones in the same order as filtering, joining and sorting the samples gives, in a third of the time and a
/// quarter of the memory. One pass marks the free points, a bit each; one counts them strip by strip; one writes. 16
/// bytes a milestone and a bit a point.
///
/// The free ones of the first `count` points of the lattice, in tile order; room for `spare` more. Throws InputError
/// for a lattice with more points than milestones can be numbered, and Stopped.
template <World W>
RawVector<Vec2> lattice_milestones(const W& world, LatticeSize size, std::uint64_t count, const Execution& execution,
                                   std::size_t spare) {
  if (std::uint64_t{size.rows} * size.cols > std::uint64_t{1} << 31) {
    throw InputError("lattice", "has more than 2^31 cells; use the tiled pipeline");
  }
  execution.reserve(std::size_t{size.rows} * (size.cols / 8 + 8));
  const detail::FreeLattice free = detail::free_lattice(world, size, count, execution);
  return detail::LatticeInTileOrder(free, execution).points(spare);
}

namespace detail {

/// Calls visit(sample) for the samples of a range, of `count` in all: a pure function of options, index and count. In
/// the plane uniform ones are stratified; a row of strata is found once. Not for lattices.
template <World W, class Visit>
void for_each_sample(const W& world, const RoadmapOptions& options, Range range, std::uint64_t count,
                     const Visit& visit) {
  if constexpr (std::same_as<typename W::State, Vec2>) {
    if (options.sampler == SamplerKind::uniform) {
      const Box box = world.box();
      const Strata strata(count, box.width() > 0.0 ? box.height() / box.width() : 1.0);
      Strata::Row row;
      std::array<std::array<double, 2>, bunch_size> units;
      std::array<Vec2, bunch_size> states;
      for (std::size_t first = range.first; first < range.last; first += bunch_size) {
        const std::size_t held = std::min(bunch_size, range.last - first);
        for (std::size_t i = 0; i < held; ++i) {
          if (first + i >= row.next) row = strata.row_of(first + i);
          units[i] = strata.point(options.seed, first + i, row);
        }
        world.at_units({units.data(), held}, states.data());
        std::for_each_n(states.begin(), held, visit);
      }
      return;
    }
  }
  for (std::size_t i = range.first; i < range.last; ++i) visit(plain_sample(world, options.sampler, options.seed, i));
}

/// The free ones of a range of samples.
template <World W>
void append_free_samples(const W& world, const RoadmapOptions& options, Range range, std::uint64_t count,
                         RawVector<typename W::State>& free) {
  auto query = world.make_query();
  std::array<typename W::State, bunch_size> bunch;
  std::size_t held = 0;
  const auto flush = [&] {
    std::uint32_t bits = world.free_states({bunch.data(), held}, query);
    for (; bits != 0; bits &= bits - 1) free.push_back(bunch[static_cast<std::size_t>(std::countr_zero(bits))]);
    held = 0;
  };
  for_each_sample(world, options, range, count, [&](const typename W::State& state) {
    bunch[held++] = state;
    if (held == bunch_size) flush();
  });
  flush();
}

/// The first two coordinates of the embeddings; the states themselves where they are points of the plane.
template <World W>
auto plane_positions(const W& world, const RawVector<typename W::State>& states, const Execution& execution) {
  if constexpr (std::same_as<typename W::State, Vec2>) {
    return std::span<const Vec2>(states);
  } else {
    constexpr std::size_t grain = std::size_t{1} << 14;
    RawVector<Vec2> positions(states.size());
    for_each_index(states.size(), grain, execution, [&](std::size_t i) {
      const auto point = world.embed(states[i]);
      positions[i] = {point[0], point[1]};
    });
    return positions;
  }
}

template <World W>
RawVector<typename W::State> in_tile_order(const W& world, const RawVector<typename W::State>& states,
                                           const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  execution.reserve(states.size() * (sizeof(Vec2) + 16 + sizeof(typename W::State)));
  const RawVector<std::uint32_t> order = tile_order(plane_positions(world, states, execution), execution);
  RawVector<typename W::State> sorted;
  sorted.reserve(states.size() + 2);  // start and goal will follow
  sorted.resize(states.size());
  for_each_index(states.size(), grain, execution, [&](std::size_t i) { sorted[i] = states[order[i]]; });
  return sorted;
}

/// The middles of a map's cells, in tile order.
template <World W>
RawVector<typename W::State> cell_centre_milestones(const W& world, const Execution& execution) {
  constexpr std::size_t rows = 32;
  const Bitmap& cells = *world.milestone_cells();
  execution.reserve(cells.count() * sizeof(typename W::State));
  auto parts = parts_of_chunks(cells.height(), rows, execution, [&](Range r) {
    RawVector<typename W::State> part;
    for (auto y = static_cast<std::uint32_t>(r.first); y < r.last; ++y) {
      cells.for_each_in_row(y, [&](std::uint32_t x) { part.push_back(world.cell_state(x, y)); });
    }
    return part;
  });
  const RawVector<typename W::State> states = joined_parts(parts, execution);
  parts.clear();
  return in_tile_order(world, states, execution);
}

}  // namespace detail

/// The free ones of samples 0 .. count - 1, in tile order.
template <World W>
RawVector<typename W::State> draw_milestones(const W& world, const RoadmapOptions& options, std::uint64_t count,
                                             const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 12;
  if constexpr (std::same_as<typename W::State, Vec2>) {
    if (options.sampler == SamplerKind::lattice) {
      return lattice_milestones(world, options.lattice, count, execution, 2);  // start and goal will follow
    }
  }
  if (options.sampler == SamplerKind::cell_centres && world.milestone_cells() != nullptr)
    return detail::cell_centre_milestones(world, execution);
  execution.reserve(count * sizeof(typename W::State));
  auto parts = parts_of_chunks(count, grain, execution, [&](Range r) {
    RawVector<typename W::State> part;
    part.reserve(r.size());
    if (!looks_at_obstacles(options.sampler)) {
      detail::append_free_samples(world, options, r, count, part);
      return part;
    }
    auto query = world.make_query();
    for (std::size_t i = r.first; i < r.last; ++i) {
      if (const auto state = obstacle_sample(world, options.sampler, options.seed, i, query)) part.push_back(*state);
    }
    return part;
  });
  RawVector<typename W::State> states = joined_parts(parts, execution);
  parts.clear();
  return detail::in_tile_order(world, states, execution);
}

}  // namespace warren
