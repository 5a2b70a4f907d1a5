// SPDX-License-Identifier: BSD-3-Clause
#include "planners/contraction/witness_search.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace warren {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();
constexpr double unwanted = -1.0;
constexpr auto later_entry = [](const QueueEntry& a, const QueueEntry& b) { return b < a; };

}  // namespace

/// Where v stands; an empty slot where it doesn't.
WitnessSearch::Slot& WitnessSearch::slot_of(VertexId v) {
  std::size_t slot = v * std::uint64_t{0x9e3779b97f4a7c15U} >> 32 & (slots_.size() - 1);
  while (slots_[slot].search == search_ && slots_[slot].vertex != v) slot = (slot + 1) & (slots_.size() - 1);
  return slots_[slot];
}

/// A new search for the targets, over what is `before` them.
void WitnessSearch::begin(std::span<const ShrinkingArc> targets, double before) {
  const std::size_t size = std::bit_ceil(2 * (targets.size() + most_reached + 1));
  if (slots_.size() < size || ++search_ == 0) {
    slots_.assign(std::max(size, slots_.size()), {});
    search_ = 1;
  }
  queue_.clear();
  for (const ShrinkingArc& target : targets) slot_of(target.to) = {search_, target.to, nowhere, before + target.length};
  used_ = targets.size();
  missing_ = targets.size();
}

void WitnessSearch::reach(VertexId v, double length) {
  Slot& slot = slot_of(v);
  if (slot.search != search_) {
    if (used_ == slots_.size() / 2) return;
    ++used_;
    slot = {search_, v, nowhere, unwanted};
  }
  if (slot.length <= length) return;
  slot.length = length;
  if (length <= slot.wanted) {
    slot.wanted = unwanted;
    --missing_;
  }
  queue_.push_back({length, v});
  std::push_heap(queue_.begin(), queue_.end(), later_entry);
}

/// Until all targets have their witnesses.
void WitnessSearch::search(VertexId from, double longest) {
  reach(from, 0.0);
  for (std::size_t settled = 0; missing_ > 0 && !queue_.empty() && settled < most_settled;) {
    std::pop_heap(queue_.begin(), queue_.end(), later_entry);
    const QueueEntry next = queue_.back();
    queue_.pop_back();
    if (next.key > slot_of(next.vertex).length) continue;
    ++settled;
    for (const ShrinkingArc& arc : graph_.row(next.vertex)) {
      const double length = next.key + arc.length;
      if (length <= longest && taken_[arc.to] == 0) reach(arc.to, length);
    }
  }
}

void WitnessSearch::append_shortcuts(VertexId v, RawVector<Shortcut>& shortcuts) {
  const auto row = graph_.row(v);
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    const auto later = row.subspan(i + 1);
    if (i % 16 == 0) execution_.check();
    begin(later, row[i].length);
    double longest = 0.0;
    for (const ShrinkingArc& arc : later) longest = std::max(longest, row[i].length + arc.length);
    search(row[i].to, longest);
    for (const ShrinkingArc& arc : later) {
      const double length = slot_of(arc.to).wanted;
      if (length != unwanted) shortcuts.push_back({row[i].to, arc.to, graph_.vertex[v], length});
    }
  }
}

}  // namespace warren
