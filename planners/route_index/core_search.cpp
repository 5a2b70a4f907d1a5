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
  for (std::uint32_t i = 0; i < seen_.size(); ++i) {
    if (index_.is_gate(seen_[i].place)) {
      gates_.push_back({index_.gate_at(seen_[i].place), seen_[i].steps, i});
    } else {
      expand(i);
    }
  }
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

void CoreSearch::write_way(std::uint32_t to, CellId* start, int direction) const {
  const std::uint32_t cols = index_.places().size().cols;
  for (; to != 0; to = seen_[to].from) {
    start[std::ptrdiff_t{direction} * seen_[to].steps] = seen_[to].row * cols + seen_[to].col;
  }
}

}  // namespace warren
