// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/front_unpacking.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace warren {
namespace {

constexpr std::uint32_t few_steps = 16;  // a search so far costs less than looking through the fronts below

}  // namespace

void FrontUnpacking::append(const FrontStep& whole, RawVector<CellId>& cells) {
  todo_.assign(1, whole);
  while (!todo_.empty()) {
    const FrontStep step = todo_.back();
    todo_.pop_back();
    if (step.length <= few_steps && append_short(step, cells)) continue;
    if (const std::optional<Middle> middle = middle_of(step)) {
      const bool up = step.from < step.to;
      todo_.push_back({middle->front, middle->gate, step.to, up ? middle->to_high : middle->from_low});
      todo_.push_back({middle->front, step.from, middle->gate, up ? middle->from_low : middle->to_high});
    } else if (!append_short(step, cells)) {
      throw InputError("route index", "its fronts contradict its passages: build it again");
    }
  }
}

bool FrontUnpacking::append_short(const FrontStep& step, RawVector<CellId>& cells) {
  const LatticePlace from = index_.gate_place(step.from);
  const LatticePlace to = index_.gate_place(step.to);
  if (search_.append_walk(from, to, step.length, cells)) return true;
  if (!search_.search_for(from, to, step.length)) return false;
  search_.append_way(search_.number_of(to), cells);
  return true;
}

/// The front itself first, then those below that have both ends as bounds.
std::optional<FrontUnpacking::Middle> FrontUnpacking::middle_of(const FrontStep& step) {
  const GateRank low = std::min(step.from, step.to);
  const GateRank high = std::max(step.from, step.to);
  const Front& top = index_.front(step.front);
  const std::uint64_t own = front_column(fronts_, top, low);
  if (auto middle = middle_in(step.front, own, own, front_column(fronts_, top, high), step.length)) return middle;
  below_.assign(1, top.last_child);
  while (!below_.empty()) {
    const FrontId front = below_.back();
    below_.pop_back();
    if (front == no_front) continue;
    const Front& f = index_.front(front);
    below_.push_back(f.sibling);
    const std::uint64_t width = std::uint64_t{f.gates} + f.bounds;
    const std::uint64_t low_column = front_column(fronts_, f, low);
    if (low_column == width) continue;
    const std::uint64_t high_column = front_column(fronts_, f, high);
    if (high_column == width) continue;
    if (auto middle = middle_in(front, f.gates, low_column, high_column, step.length)) return middle;
    below_.push_back(f.last_child);
  }
  return std::nullopt;
}

/// Of the first `end` gates of a front.
std::optional<FrontUnpacking::Middle> FrontUnpacking::middle_in(FrontId front, std::uint64_t end, std::uint64_t low,
                                                                std::uint64_t high, std::uint32_t length) const {
  const Front& f = fronts_.fronts[front];
  for (std::uint64_t i = 0; i < end; ++i) {
    const std::uint32_t from_low = front_entry(fronts_, f, i, low);
    if (from_low >= length) continue;
    const std::uint32_t to_high = front_entry(fronts_, f, i, high);
    if (from_low + to_high != length) continue;
    return Middle{front, f.first + static_cast<GateRank>(i), from_low, to_high};
  }
  return std::nullopt;
}

}  // namespace warren
