// SPDX-License-Identifier: BSD-3-Clause
#include "planners/contraction/hierarchy_climb.hpp"

#include <algorithm>
#include <utility>

namespace warren {
namespace {

constexpr auto later_in_queue = [](const QueueEntry& a, const QueueEntry& b) { return b < a; };

}  // namespace

void HierarchyClimb::clear() {
  if (slots_.empty()) slots_.resize(std::size_t{1} << first_bits);
  for (const std::uint32_t slot : used_) slots_[slot] = {};
  used_.clear();
  queue_.clear();
}

void HierarchyClimb::grow() {
  const std::vector<Slot> before = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
  --shift_;
  for (std::uint32_t& slot : used_) {
    const std::size_t next = slot_of(before[slot].vertex);
    slots_[next] = before[slot];
    slot = static_cast<std::uint32_t>(next);
  }
}

void HierarchyClimb::reach(VertexId v, double length, VertexId parent) {
  std::size_t slot = slot_of(v);
  if (length >= slots_[slot].length) return;
  if (slots_[slot].vertex == no_vertex) {
    if (2 * used_.size() >= slots_.size()) {
      grow();
      slot = slot_of(v);
    }
    used_.push_back(static_cast<std::uint32_t>(slot));
  }
  slots_[slot] = {v, parent, length};
  queue_.push_back({length, v});
  std::push_heap(queue_.begin(), queue_.end(), later_in_queue);
}

QueueEntry HierarchyClimb::pop() {
  const QueueEntry next = queue_.front();
  do {
    std::pop_heap(queue_.begin(), queue_.end(), later_in_queue);
    queue_.pop_back();
  } while (!queue_.empty() && queue_.front().key > length(queue_.front().vertex));
  return next;
}

RawVector<VertexId> HierarchyClimb::back_from(VertexId v) const {
  RawVector<VertexId> way;
  for (; v != no_vertex; v = slots_[slot_of(v)].parent) way.push_back(v);
  return way;
}

}  // namespace warren
