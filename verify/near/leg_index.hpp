// SPDX-License-Identifier: BSD-3-Clause
// Which legs of a path are near this wall? Made for one path and a stream of very many walls, most of them far away.
//
// A grid over the path's box (cells about as large as a leg): one bit a cell says whether a leg passes, a rank over the
// bits leads to runs of consecutive legs. A pyramid of coarser copies, widened by the reach, answers "nothing near"
// with one lookup for a wall of any length: the level is chosen so that half the wall fits a cell, and where the bit is
// set the wall is halved and asked again one level below. Long runs are searched by verify/near/leg_boxes.
//
// Memory: at most 128 bits a leg four times over, 12 to 80 bytes a leg for the runs (a path of few legs among
// many walls: 2^18 bits). A leg costs about its length in cells; the cell is chosen so that this is some 5 a
// leg on average (65536 in all for a path of few legs). A wall costs one lookup, plus the legs that are near.
// Conservative throughout: walls nearer than the reach always find their legs (cell numbers are exact to 2^-20 cells,
// and every test is wider than that).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "parallel/execution.hpp"
#include "verify/near/leg_boxes.hpp"

namespace warren {

/// Refers to the legs, which must outlive it. After set_reach any number of threads may ask.
class LegIndex {
 public:
  /// What is to come; it only decides on the cells.
  struct Plan {
    double clearance = 0.0;     ///< the least reach that will be set
    std::size_t walls = 0;      ///< how many will be asked for
    double typical_wall = 0.0;  ///< half their extent, 0 if not known
  };

  /// At most 500 million legs (verify_path sees to it).
  LegIndex(const LegBoxes& legs, const Plan& plan, const Execution& execution);

  double cell() const { return cell_; }

  /// for_each_near will find every leg nearer than this to a wall. At most 4 cells.
  void set_reach(double reach, const Execution& execution);

  /// Calls visit(first, last) for runs of legs: every leg nearer than the reach to the wall is in one of them; so are
  /// others, and some come again and again.
  template <class Visit>
  void for_each_near(const Segment& wall, const Visit& visit) const {
    const Point a = cells_of(wall.a);
    const Point b = cells_of(wall.b);
    const double half = 0.5 * std::max(std::abs(b.u - a.u), std::abs(b.v - a.v));
    if (half <= 1.0) {
      if (passes(0, middle(a, b))) visit_cells(a, b, visit);
    } else {
      visit_long(a, b, visit);
    }
  }

 private:
  /// A place in cells, from the grid's lower corner.
  struct Point {
    double u, v;
  };
  struct Run {
    std::uint32_t first, last;
  };
  /// Bits of one level. rows is a multiple of 8.
  struct Level {
    std::size_t columns = 0, rows = 0, words = 0;  ///< words: a row's
    RawVector<std::uint64_t> bits;
  };
  /// The same in tiles: a word holds 8 x 8 cells, row by row, so what is near in the plane is near in memory.
  struct Tiles {
    std::size_t columns = 0, rows = 0, words = 0;  ///< columns and rows of cells; words: of a row of tiles
    RawVector<std::uint64_t> bits;
    std::size_t word(std::size_t column, std::size_t row) const { return row / 8 * words + column / 8; }
    static int bit(std::size_t column, std::size_t row) { return as_whole<int>(row % 8 * 8 + column % 8); }
  };

  static constexpr std::size_t margin = 7;  ///< empty cells around the path's box: walls outside fall on these
  static constexpr double slack = 1e-6;     ///< cells; far above the rounding of cell numbers
  static constexpr double far_away = 1e9;   ///< cells; beyond this their numbers are no longer good to the slack

  static Point middle(Point a, Point b) { return {0.5 * (a.u + b.u), 0.5 * (a.v + b.v)}; }
  Point cells_of(Vec2 p) const { return {(p.x - origin_.x) * per_cell_, (p.y - origin_.y) * per_cell_}; }
  static std::size_t clamped(double u, std::size_t count) {
    return bounded_whole<std::size_t>(u, 0.0, static_cast<double>(count - 1));
  }
  bool passes(std::size_t level, Point p) const {
    const Tiles& near = near_[level];
    const double scale = scale_[level];
    const std::size_t column = clamped(p.u * scale, near.columns);
    const std::size_t row = clamped(p.v * scale, near.rows);
    return ((near.bits[near.word(column, row)] >> Tiles::bit(column, row)) & 1U) != 0;
  }

  void choose_cell(const Plan& plan);
  static Level empty_level(std::size_t columns, std::size_t rows, const Execution& execution);
  template <class Visit>
  void for_each_cell_of_leg(std::size_t leg, const Visit& visit) const;
  std::uint32_t slot_of(std::size_t word, int bit) const {
    const std::uint64_t below = marked_.bits[word] & ((std::uint64_t{1} << bit) - 1);
    return rank_[word] + as_whole<std::uint32_t>(std::popcount(below));
  }
  void mark_cells(const Execution& execution);
  void gather_runs(const Execution& execution);
  static Level halved(const Level& fine, const Execution& execution);
  static Tiles tiled(const Level& level, const Execution& execution);
  static Level widened(const Level& level, std::size_t cells, const Execution& execution);
  bool clip(Point& a, Point& b) const;

  template <class Visit>
  void visit_cells(Point a, Point b, const Visit& visit) const;
  template <class Visit>
  void visit_long(Point a, Point b, const Visit& visit) const;
  template <class Visit>
  void visit_halves(std::size_t level, Point a, Point b, const Visit& visit) const;

  const LegBoxes& legs_;
  std::span<const Vec2> path_;
  Box box_;
  double cell_ = 1.0;
  double per_cell_ = 1.0;
  double reach_cells_ = 0.0;
  Vec2 origin_;
  std::vector<Level> levels_;           ///< which cells a leg passes; levels_[k] has cells of 2^k
  std::vector<Tiles> near_;             ///< the same, widened by the reach and half a wall
  Tiles marked_;                        ///< levels_[0]
  std::vector<double> scale_;           ///< 2^-k
  RawVector<std::uint32_t> rank_;       ///< a word of marked_: marked cells before it
  RawVector<std::uint32_t> first_run_;  ///< a marked cell: its runs begin here; one more at the end
  RawVector<Run> runs_;
};

template <class Visit>
void LegIndex::visit_cells(Point a, Point b, const Visit& visit) const {
  const double grow = reach_cells_ + slack;
  const std::size_t column_first = clamped(std::min(a.u, b.u) - grow, marked_.columns);
  const std::size_t column_last = clamped(std::max(a.u, b.u) + grow, marked_.columns);
  const std::size_t row_first = clamped(std::min(a.v, b.v) - grow, marked_.rows);
  const std::size_t row_last = clamped(std::max(a.v, b.v) + grow, marked_.rows);
  for (std::size_t tile_row = row_first / 8; tile_row <= row_last / 8; ++tile_row) {
    std::uint64_t rows = ~std::uint64_t{0};
    if (tile_row == row_first / 8) rows &= ~std::uint64_t{0} << (8 * (row_first % 8));
    if (tile_row == row_last / 8) rows &= ~std::uint64_t{0} >> (56 - 8 * (row_last % 8));
    for (std::size_t tile = column_first / 8; tile <= column_last / 8; ++tile) {
      std::uint64_t columns = 0xff;
      if (tile == column_first / 8) columns &= 0xffU << (column_first % 8);
      if (tile == column_last / 8) columns &= 0xffU >> (7 - column_last % 8);
      const std::size_t word = tile_row * marked_.words + tile;
      std::uint64_t mask = marked_.bits[word] & rows & (columns * 0x0101010101010101U);
      for (; mask != 0; mask &= mask - 1) {
        const std::uint32_t slot = slot_of(word, std::countr_zero(mask));
        for (std::uint32_t r = first_run_[slot]; r < first_run_[slot + 1]; ++r) visit(runs_[r].first, runs_[r].last);
      }
    }
  }
}

template <class Visit>
void LegIndex::visit_long(Point a, Point b, const Visit& visit) const {
  const double largest = std::max({std::abs(a.u), std::abs(a.v), std::abs(b.u), std::abs(b.v)});
  if (!(largest < far_away)) return visit(std::uint32_t{0}, as_whole<std::uint32_t>(legs_.leg_count() - 1));
  if (!clip(a, b)) return;
  const double half = 0.5 * std::max(std::abs(b.u - a.u), std::abs(b.v - a.v));
  std::size_t level = 0;
  while (level + 1 < near_.size() && half * scale_[level] > 1.0) ++level;
  visit_halves(level, a, b, visit);
}

template <class Visit>
void LegIndex::visit_halves(std::size_t level, Point a, Point b, const Visit& visit) const {
  const Point m = middle(a, b);
  if (!passes(level, m)) return;
  if (level == 0) return visit_cells(a, b, visit);
  visit_halves(level - 1, a, m, visit);
  visit_halves(level - 1, m, b, visit);
}

}  // namespace warren
