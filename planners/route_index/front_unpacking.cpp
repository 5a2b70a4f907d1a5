// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/front_unpacking.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace warren {
namespace {

[[noreturn]] void refuse_front() {
  throw InputError("route index", "its fronts contradict each other: build it again");
}

}  // namespace

void FrontUnpacking::write(std::span<const FrontStep> steps, CellId* cells, const Execution& execution) {
  todo_.clear();
  hops_.clear();
  for (const FrontStep& step : steps) {
    const auto [low, high] = std::minmax(step.from, step.to);
    const Front& front = index_.front(step.front);
    todo_.push_back({&front, place_in(front, low, high), low, high, step.length, step.from > step.to, cells});
    cells += step.length;
  }
  if (!steps.empty()) *cells = index_.places().cell_of(index_.gate_place(steps.back().to));
  while (!todo_.empty()) {  // ranks become less
    read_ways();
    find_halves();
    open_halves();
  }
  // Along the path neighbours share tiles.
  std::sort(hops_.begin(), hops_.end(), [](const Hop& a, const Hop& b) { return a.first < b.first; });
  write_hops(index_, hops_, execution);
}

/// What goes over a gate becomes a middle.
void FrontUnpacking::read_ways() {
  middles_.clear();
  for (const Entry& entry : todo_) {
    if (entry.length == 0) refuse_front();  // a hop without steps would write beside its cells
    const std::uint64_t way = front_way(fronts_, *entry.front, entry.place);
    if ((way & 1U) != 0) {
      hops_.push_back({index_.gate_place(entry.low), index_.gate_place(entry.high), entry.length,
                       entry.downwards ? -1 : 1, way / 2, entry.downwards ? entry.cells + entry.length : entry.cells});
      continue;
    }
    const std::uint64_t below = way / 2;
    if (below == 0 || below > entry.low) refuse_front();
    const GateRank gate = entry.low - static_cast<GateRank>(below);
    index_.prefetch_front_of(gate);
    middles_.push_back({entry, gate, nullptr, 0, 0});
  }
}

void FrontUnpacking::find_halves() {
  for (Middle& middle : middles_) {
    middle.front = &index_.front(index_.front_of(middle.gate));
    __builtin_prefetch(fronts_.bounds.data() + middle.front->first_bound);
  }
  for (Middle& middle : middles_) {
    middle.low = place_in(*middle.front, middle.gate, middle.whole.low);
    middle.high = place_in(*middle.front, middle.gate, middle.whole.high);
    for (const std::uint64_t place : {middle.low, middle.high}) {
      const std::uint64_t length = middle.front->first_length() + place;
      if (middle.front->is_short()) {
        __builtin_prefetch(fronts_.short_lengths.data() + length);
      } else {
        __builtin_prefetch(fronts_.lengths.data() + length);
      }
      __builtin_prefetch(fronts_.ways.data() + middle.front->first_way() + place * middle.front->way_elements());
    }
  }
}

void FrontUnpacking::open_halves() {
  todo_.clear();
  for (const Middle& middle : middles_) {
    const Entry& whole = middle.whole;
    const std::uint32_t to_low = front_entry(fronts_, *middle.front, middle.low);
    const std::uint32_t to_high = front_entry(fronts_, *middle.front, middle.high);
    if (to_low + to_high != whole.length) refuse_front();
    CellId* const low_cells = whole.downwards ? whole.cells + to_high : whole.cells;
    CellId* const high_cells = whole.downwards ? whole.cells : whole.cells + to_low;
    todo_.push_back({middle.front, middle.low, middle.gate, whole.low, to_low, !whole.downwards, low_cells});
    todo_.push_back({middle.front, middle.high, middle.gate, whole.high, to_high, whole.downwards, high_cells});
  }
}

/// Of the entry between a gate of the front and a gate of higher rank.
std::uint64_t FrontUnpacking::place_in(const Front& front, GateRank gate, GateRank other) const {
  const std::uint64_t column = front_column(fronts_, front, other);
  if (column == std::uint64_t{front.gates} + front.bounds) refuse_front();
  return front_place(front, gate - front.first, column);
}

}  // namespace warren
