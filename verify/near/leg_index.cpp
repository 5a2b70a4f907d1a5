// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/leg_index.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/chunks.hpp"

namespace warren {
namespace {

// Cells of the grid, and cells that all legs together pass: so many a leg, and at least so many for a path of few legs,
// where that many walls pay for them.
constexpr double cells_per_leg = 128;
constexpr double pieces_per_leg = 4;
constexpr double free_cells = 262144;
constexpr double free_pieces = 65536;
constexpr std::size_t row_grain = 256;

/// The even bits of x, side by side.
std::uint64_t even_bits(std::uint64_t x) {
  x &= 0x5555555555555555U;
  x = (x | (x >> 1)) & 0x3333333333333333U;
  x = (x | (x >> 2)) & 0x0f0f0f0f0f0f0f0fU;
  x = (x | (x >> 4)) & 0x00ff00ff00ff00ffU;
  x = (x | (x >> 8)) & 0x0000ffff0000ffffU;
  return (x | (x >> 16)) & 0x00000000ffffffffU;
}

std::uint64_t pairs(std::uint64_t x) { return even_bits(x | (x >> 1)); }

/// Bits of the row moved up and down by 1 .. cells places, joined; `cells` < 64.
void widen_row(const std::uint64_t* from, std::uint64_t* to, std::size_t words, std::size_t cells) {
  for (std::size_t w = 0; w < words; ++w) {
    const std::uint64_t here = from[w];
    const std::uint64_t below = w > 0 ? from[w - 1] : 0;
    const std::uint64_t above = w + 1 < words ? from[w + 1] : 0;
    if ((here | below | above) == 0) continue;
    std::uint64_t wide = here;
    for (std::size_t s = 1; s <= cells; ++s) {
      wide |= (here << s) | (below >> (64 - s)) | (here >> s) | (above << (64 - s));
    }
    to[w] |= wide;
  }
}

}  // namespace

LegIndex::LegIndex(const LegBoxes& legs, const Plan& plan, const Execution& execution)
    : legs_(legs), path_(legs.path()), box_(legs.box()) {
  choose_cell(plan);
  // Half a cell more, because paths like to run on a lattice, and better through the middle of cells than between two.
  const double before = (static_cast<double>(margin) + 0.5) * cell_;
  origin_ = box_.min - Vec2{before, before};
  const auto count = [this](double extent) { return bounded_whole<std::size_t>(extent * per_cell_) + 2 + 2 * margin; };
  levels_.push_back(empty_level(count(box_.width()), count(box_.height()), execution));
  mark_cells(execution);
  gather_runs(execution);
  for (std::size_t rows = count(box_.height()); levels_.back().columns > 1 || rows > 1; rows = (rows + 1) / 2) {
    levels_.push_back(halved(levels_.back(), execution));
  }
  for (std::size_t k = 0; k < levels_.size(); ++k) scale_.push_back(std::ldexp(1.0, -as_whole<int>(k)));
}

void LegIndex::choose_cell(const Plan& plan) {
  const auto legs = static_cast<double>(legs_.leg_count());
  const auto walls = static_cast<double>(plan.walls);
  const double cells = std::max(std::min(free_cells, walls), cells_per_leg * legs);
  const double pieces = std::max(std::min(free_pieces, 0.25 * walls), pieces_per_leg * legs);
  cell_ = std::max(legs_.length() / pieces, 1.02 * plan.clearance);
  cell_ = std::max(cell_, std::sqrt(box_.width()) * std::sqrt(box_.height()) / std::sqrt(cells));
  const double wall_cell = 1.00001 * plan.typical_wall;  // half a wall just fits: the common wall takes one lookup
  if (cell_ < wall_cell && (wall_cell < 4.0 * cell_ || cell_ == 0.0)) cell_ = wall_cell;
  if (cell_ == 0.0) cell_ = 1.0;
  per_cell_ = 1.0 / cell_;
}

LegIndex::Level LegIndex::empty_level(std::size_t columns, std::size_t rows, const Execution& execution) {
  Level level{columns, (rows + 7) / 8 * 8, (columns + 63) / 64, {}};
  execution.reserve(level.words * level.rows * sizeof(std::uint64_t));
  level.bits.assign(level.words * level.rows, 0);
  return level;
}

template <class Visit>
void LegIndex::for_each_cell_of_leg(std::size_t leg, const Visit& visit) const {
  const Level& cells = levels_[0];
  const Point a = cells_of(path_[leg]);
  const Point b = cells_of(path_[leg + 1]);
  const double pieces = std::max(1.0, std::ceil(std::max(std::abs(b.u - a.u), std::abs(b.v - a.v))));
  Point p = a;
  for (double piece = 1.0; piece <= pieces; piece += 1.0) {
    const double t = piece / pieces;
    const Point q{a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)};
    const std::size_t column_last = clamped(std::max(p.u, q.u) + slack, cells.columns);
    const std::size_t row_last = clamped(std::max(p.v, q.v) + slack, cells.rows);
    for (std::size_t row = clamped(std::min(p.v, q.v) - slack, cells.rows); row <= row_last; ++row) {
      for (std::size_t c = clamped(std::min(p.u, q.u) - slack, cells.columns); c <= column_last; ++c) {
        visit(c, row);
      }
    }
    p = q;
  }
}

void LegIndex::mark_cells(const Execution& execution) {
  Level& cells = levels_[0];
  for (std::size_t leg = 0; leg < legs_.leg_count(); ++leg) {
    if (leg % 4096 == 0) execution.check();
    for_each_cell_of_leg(leg, [&](std::size_t column, std::size_t row) {
      cells.bits[row * cells.words + column / 64] |= std::uint64_t{1} << (column % 64);
    });
  }
  marked_ = tiled(cells, execution);
  const RawVector<std::uint64_t>& bits = marked_.bits;
  execution.reserve(bits.size() * sizeof(std::uint32_t));
  rank_.resize(bits.size() + 1);
  std::uint32_t marked = 0;
  for (std::size_t w = 0; w < bits.size(); ++w) {
    rank_[w] = marked;
    marked += as_whole<std::uint32_t>(std::popcount(bits[w]));
  }
  rank_[bits.size()] = marked;
}

void LegIndex::gather_runs(const Execution& execution) {
  const std::size_t marked = rank_.back();
  execution.reserve(2 * marked * sizeof(std::uint32_t));
  RawVector<std::uint32_t> latest;  // a marked cell: 1 + the leg that came last, 0 before the first
  // The same walk twice: first it counts the runs of each cell, then it writes them.
  const auto walk = [&](const auto& new_run, const auto& same_run) {
    latest.assign(marked, 0);
    for (std::uint32_t leg = 0; leg < legs_.leg_count(); ++leg) {
      if (leg % 4096 == 0) execution.check();
      for_each_cell_of_leg(leg, [&](std::size_t column, std::size_t row) {
        const std::uint32_t slot = slot_of(marked_.word(column, row), Tiles::bit(column, row));
        if (latest[slot] == leg + 1) return;
        if (leg > 0 && latest[slot] == leg) {
          same_run(slot, leg);
        } else {
          new_run(slot, leg);
        }
        latest[slot] = leg + 1;
      });
    }
  };
  first_run_.assign(marked + 1, 0);
  walk([&](std::uint32_t slot, std::uint32_t) { ++first_run_[slot]; }, [](std::uint32_t, std::uint32_t) {});
  std::uint32_t runs = 0;
  for (std::uint32_t& first : first_run_) {
    runs += first;
    first = runs;  // the end of the slot's runs: writing them moves it down to their beginning
  }
  execution.reserve(runs * sizeof(Run));
  runs_.resize(runs);
  walk(
      [&](std::uint32_t slot, std::uint32_t leg) {
        runs_[--first_run_[slot]] = {leg, leg};
      },
      [&](std::uint32_t slot, std::uint32_t leg) { runs_[first_run_[slot]].last = leg; });
}

LegIndex::Level LegIndex::halved(const Level& fine, const Execution& execution) {
  Level coarse = empty_level((fine.columns + 1) / 2, fine.rows / 2, execution);
  for_chunks(fine.rows / 2, row_grain, execution, [&](Range r) {
    for (std::size_t row = r.first; row < r.last; ++row) {
      const std::uint64_t* lower = &fine.bits[2 * row * fine.words];
      const std::uint64_t* upper = lower + fine.words;
      for (std::size_t w = 0; w < fine.words; ++w) {
        coarse.bits[row * coarse.words + w / 2] |= pairs(lower[w] | upper[w]) << (32 * (w % 2));
      }
    }
  });
  return coarse;
}

LegIndex::Level LegIndex::widened(const Level& level, std::size_t cells, const Execution& execution) {
  Level wide = empty_level(level.columns, level.rows, execution);
  for_chunks(level.rows, row_grain, execution, [&](Range r) {
    for (std::size_t row = r.first; row < r.last; ++row) {
      const std::size_t last = std::min(row + cells, level.rows - 1);
      for (std::size_t from = row - std::min(row, cells); from <= last; ++from) {
        widen_row(&level.bits[from * level.words], &wide.bits[row * level.words], level.words, cells);
      }
    }
  });
  return wide;
}

LegIndex::Tiles LegIndex::tiled(const Level& level, const Execution& execution) {
  Tiles tiles{level.columns, level.rows, 8 * level.words, {}};
  execution.reserve(level.bits.size() * sizeof(std::uint64_t));
  tiles.bits.resize(level.bits.size());
  for_chunks(level.rows / 8, row_grain / 8, execution, [&](Range r) {
    for (std::size_t tile_row = r.first; tile_row < r.last; ++tile_row) {
      for (std::size_t tile = 0; tile < tiles.words; ++tile) {
        std::uint64_t cells = 0;
        for (std::size_t row = 0; row < 8; ++row) {
          const std::uint64_t word = level.bits[(8 * tile_row + row) * level.words + tile / 8];
          cells |= ((word >> (8 * (tile % 8))) & 0xffU) << (8 * row);
        }
        tiles.bits[tile_row * tiles.words + tile] = cells;
      }
    }
  });
  return tiles;
}

void LegIndex::set_reach(double reach, const Execution& execution) {
  reach_cells_ = std::min(reach * per_cell_, 4.0);
  near_.clear();
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    // A wall's half fits one cell of its level, so its legs pass within 1 + reach of its middle.
    const auto cells = bounded_whole<std::size_t>(std::ceil(1.0 + reach_cells_ * scale_[k] + 4.0 * slack));
    near_.push_back(tiled(widened(levels_[k], cells, execution), execution));
  }
}

bool LegIndex::clip(Point& a, Point& b) const {
  double enter = 0.0;
  double leave = 1.0;
  const auto keep = [&](double from, double to, double most) {  // 0 <= from + t * (to - from) <= most
    const double run = to - from;
    if (run == 0.0) return from >= 0.0 && from <= most;
    const double at_low = -from / run;
    const double at_most = (most - from) / run;
    enter = std::max(enter, std::min(at_low, at_most));
    leave = std::min(leave, std::max(at_low, at_most));
    return enter <= leave;
  };
  if (!keep(a.u, b.u, static_cast<double>(levels_[0].columns))) return false;
  if (!keep(a.v, b.v, static_cast<double>(levels_[0].rows))) return false;
  const Point from = a;
  const Point run{b.u - a.u, b.v - a.v};
  if (leave < 1.0) b = {from.u + leave * run.u, from.v + leave * run.v};
  if (enter > 0.0) a = {from.u + enter * run.u, from.v + enter * run.v};
  return true;
}

}  // namespace warren
