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

void FrontUnpacking::write(std::span<const FrontStep> steps, CellId* cells) {
  todo_.clear();
  hops_.clear();
  for (const FrontStep& step : steps) {
    Entry whole = half(index_.front(step.front), std::min(step.from, step.to), std::max(step.from, step.to));
    whole.downwards = step.from > step.to;
    whole.cells = cells;
    cells += step.length;
    for (todo_.assign(1, whole); !todo_.empty();) {
      const Entry entry = todo_.back();
      todo_.pop_back();
      open(entry);
    }
  }
  write_hops(index_, hops_);
}

/// Lengths become less, so each entry ends in hops.
void FrontUnpacking::open(const Entry& entry) {
  const std::uint64_t way = front_way(fronts_, *entry.front, entry.place);
  if ((way & 1U) != 0) {
    hops_.push_back({index_.gate_place(entry.low), index_.gate_place(entry.high), entry.length,
                     entry.downwards ? -1 : 1, way / 2, entry.downwards ? entry.cells + entry.length : entry.cells});
    return;
  }
  const std::uint64_t below = way / 2;
  if (below == 0 || below > entry.low) refuse_front();
  const GateRank middle = entry.low - static_cast<GateRank>(below);
  const Front& front = index_.front(index_.front_of(middle));
  Entry to_low = half(front, middle, entry.low);
  Entry to_high = half(front, middle, entry.high);
  if (to_low.length + to_high.length != entry.length) refuse_front();
  Entry& first = entry.downwards ? to_high : to_low;
  Entry& last = entry.downwards ? to_low : to_high;
  first.downwards = true;
  first.cells = entry.cells;
  last.downwards = false;
  last.cells = entry.cells + first.length;
  todo_.push_back(last);
  todo_.push_back(first);
}

FrontUnpacking::Entry FrontUnpacking::half(const Front& front, GateRank middle, GateRank other) const {
  const std::uint64_t column = front_column(fronts_, front, other);
  if (column == std::uint64_t{front.gates} + front.bounds) refuse_front();
  const std::uint64_t place = front_place(front, middle - front.first, column);
  return {&front, place, middle, other, front_entry(fronts_, front, place), false, nullptr};
}

}  // namespace warren
