// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/core_search.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "core/base/error.hpp"

namespace warren {
namespace {

// What a motion adds to column and row, modulo 2^32.
constexpr std::array<std::uint32_t, 4> right{1, 0, ~std::uint32_t{0}, 0};
constexpr std::array<std::uint32_t, 4> up{0, 1, 0, ~std::uint32_t{0}};

std::uint32_t between(std::uint32_t a, std::uint32_t b) { return a < b ? b - a : a - b; }

unsigned ways_towards(std::uint32_t col, std::uint32_t row, const SeenCell& goal) {
  return unsigned{col < goal.col} | unsigned{row < goal.row} << 1 | unsigned{col > goal.col} << 2 |
         unsigned{row > goal.row} << 3;
}

}  // namespace

void CoreSearch::begin(LatticePlace start) {
  if (++search_ == 0) {  // after 2^32 searches
    std::fill(slots_.begin(), slots_.end(), Slot{});
    search_ = 1;
  }
  seen_.clear();
  gates_.clear();
  seen_.push_back(first_cell(start));
  enter(start, 0);
}

SeenCell CoreSearch::first_cell(LatticePlace start) const {
  const SeenCell first{start, index_.places().col(start), index_.places().row(start), 0, 0};
  const LatticeSize size = index_.places().size();
  if (first.col >= size.cols || first.row >= size.rows) {
    throw InputError("route index", "a cell of it lies outside the lattice: build it again");
  }
  index_.look_at_tile(start);
  return first;
}

void CoreSearch::search(LatticePlace start) {
  begin(start);
  const CellMarks marks = index_.marks();
  for (std::uint32_t i = 0; i < seen_.size(); ++i) {
    if (marks.is_gate(seen_[i].place)) {
      gates_.push_back({index_.gate_at(seen_[i].place), seen_[i].steps, i});
    } else {
      expand(i);
    }
  }
}

bool CoreSearch::search_for(LatticePlace start, LatticePlace goal, std::uint32_t most_steps) {
  begin(start);
  const CellMarks marks = index_.marks();
  const std::uint32_t col = index_.places().col(goal);
  const std::uint32_t row = index_.places().row(goal);
  for (std::uint32_t i = 0; i < seen_.size(); ++i) {
    const SeenCell& cell = seen_[i];
    if (cell.place == goal) return cell.steps <= most_steps;
    const std::uint64_t at_least = std::uint64_t{cell.steps} + between(cell.col, col) + between(cell.row, row);
    if (at_least <= most_steps && (i == 0 || !marks.is_gate(cell.place))) expand(i);
  }
  return false;
}

bool CoreSearch::is_core(LatticePlace next, LatticePlace from) const {
  if (LatticePlaces::tile_of(next) != LatticePlaces::tile_of(from)) {
    index_.look_at_tile(next);
    index_.marks().prefetch_tile(LatticePlaces::tile_of(next));
  }
  return index_.marks().is_core(next);
}

void CoreSearch::expand(std::uint32_t number) {
  const SeenCell at = seen_[number];
  for (unsigned open = index_.passages().open_at(at.col, at.row); open != 0; open &= open - 1) {
    const auto d = static_cast<unsigned>(std::countr_zero(open));
    const LatticePlace next = index_.places().step(at.place, d);
    if (next == seen_[at.from].place || !is_core(next, at.place)) continue;
    if (!enter(next, static_cast<std::uint32_t>(seen_.size()))) continue;
    seen_.push_back({next, at.col + right[d], at.row + up[d], at.steps + 1, number});
  }
}

/// Ways that come nearer to the goal are tried first.
bool CoreSearch::append_walk(LatticePlace start, LatticePlace goal, std::uint32_t steps, RawVector<CellId>& cells) {
  const LatticePassages& passages = index_.passages();
  const SeenCell first = first_cell(start);
  const SeenCell last = first_cell(goal);
  walk_.assign(1, {first.place, first.col, first.row, passages.open_at(first.col, first.row)});
  for (std::size_t tries = 4 * std::size_t{steps} + 16; tries > 0 && !walk_.empty(); --tries) {
    WalkedCell& at = walk_.back();
    if (at.left == 0) {
      walk_.pop_back();
      continue;
    }
    const unsigned nearer = at.left & ways_towards(at.col, at.row, last);
    const auto d = static_cast<unsigned>(std::countr_zero(nearer != 0 ? nearer : at.left));
    at.left &= ~(1U << d);
    const WalkedCell next{index_.places().step(at.place, d), at.col + right[d], at.row + up[d], 0};
    const std::uint64_t apart = std::uint64_t{between(next.col, last.col)} + between(next.row, last.row);
    if (apart + walk_.size() > steps || !is_core(next.place, at.place)) continue;
    const bool arrived = walk_.size() == steps;
    walk_.push_back(next);
    if (!arrived) {
      walk_.back().left = passages.open_at(next.col, next.row) & ~(1U << (d ^ 2U));
      continue;
    }
    for (auto cell = walk_.begin() + 1; cell != walk_.end(); ++cell) {
      cells.push_back(cell->row * index_.places().size().cols + cell->col);
    }
    return true;
  }
  return false;
}

bool CoreSearch::enter(LatticePlace p, std::uint32_t number) {
  if (2 * seen_.size() > slots_.size()) grow();
  std::size_t slot = slot_of(p);
  for (; slots_[slot].search == search_; slot = (slot + 1) & (slots_.size() - 1)) {
    if (seen_[slots_[slot].number].place == p) return false;
  }
  slots_[slot] = {search_, number};
  return true;
}

std::uint32_t CoreSearch::number_of(LatticePlace p) const {
  for (std::size_t slot = slot_of(p); slots_[slot].search == search_; slot = (slot + 1) & (slots_.size() - 1)) {
    if (seen_[slots_[slot].number].place == p) return slots_[slot].number;
  }
  return none;
}

void CoreSearch::grow() {
  slots_.assign(2 * slots_.size(), Slot{});
  for (std::uint32_t i = 0; i < seen_.size(); ++i) {
    std::size_t slot = slot_of(seen_[i].place);
    while (slots_[slot].search == search_) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = {search_, i};
  }
}

void CoreSearch::append_way(std::uint32_t to, RawVector<CellId>& cells) const {
  const std::size_t first = cells.size();
  const std::uint32_t cols = index_.places().size().cols;
  for (; to != 0; to = seen_[to].from) cells.push_back(seen_[to].row * cols + seen_[to].col);
  std::reverse(cells.begin() + static_cast<std::ptrdiff_t>(first), cells.end());
}

}  // namespace warren
