// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/core_search.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace warren {

void CoreSearch::begin(LatticePlace start) {
  if (++search_ == 0) {  // after 2^32 searches
    std::fill(slots_.begin(), slots_.end(), Slot{});
    search_ = 1;
  }
  seen_.clear();
  gates_.clear();
  seen_.push_back({start, index_.places().col(start), index_.places().row(start), 0, 0});
  enter(start, 0);
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
  const auto apart = [](std::uint32_t a, std::uint32_t b) { return a < b ? b - a : a - b; };
  for (std::uint32_t i = 0; i < seen_.size(); ++i) {
    const SeenCell& cell = seen_[i];
    if (cell.place == goal) return cell.steps <= most_steps;
    const std::uint64_t at_least = std::uint64_t{cell.steps} + apart(cell.col, col) + apart(cell.row, row);
    if (at_least <= most_steps && (i == 0 || !marks.is_gate(cell.place))) expand(i);
  }
  return false;
}

void CoreSearch::expand(std::uint32_t number) {
  constexpr std::array<std::uint32_t, 4> right{1, 0, ~std::uint32_t{0}, 0};
  constexpr std::array<std::uint32_t, 4> up{0, 1, 0, ~std::uint32_t{0}};
  const SeenCell at = seen_[number];
  for (unsigned open = index_.passages().open_at(at.col, at.row); open != 0; open &= open - 1) {
    const auto d = static_cast<unsigned>(std::countr_zero(open));
    const LatticePlace next = index_.places().step(at.place, d);
    if (next == seen_[at.from].place || !index_.marks().is_core(next)) continue;
    if (!enter(next, static_cast<std::uint32_t>(seen_.size()))) continue;
    seen_.push_back({next, at.col + right[d], at.row + up[d], at.steps + 1, number});
  }
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

void CoreSearch::append_way(std::uint32_t to, RawVector<LatticePlace>& cells) const {
  const std::size_t first = cells.size();
  for (; to != 0; to = seen_[to].from) cells.push_back(seen_[to].place);
  std::reverse(cells.begin() + static_cast<std::ptrdiff_t>(first), cells.end());
}

}  // namespace warren
