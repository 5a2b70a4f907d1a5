// SPDX-License-Identifier: BSD-3-Clause
// The queues that users compare with the indexed heap. All pop in the order (key, vertex); those without decrease-key
// keep stale entries, which the search skips because their vertex is settled already.
//   LazyHeap        binary heap, duplicates allowed: push and pop O(log n)
//   SortedArray     kept sorted by insertion: push O(n) moves, pop O(1)
//   ResortedArray   sorted again after every push, as the course reports do: push O(n log n)
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "core/indexed_heap.hpp"

namespace warren {

inline constexpr auto later = [](const QueueEntry& a, const QueueEntry& b) { return b < a; };

class LazyHeap {
 public:
  void resize(std::size_t) {}
  bool empty() const { return entries_.empty(); }
  void clear() { entries_.clear(); }
  void push(VertexId v, double key) {
    entries_.push_back({key, v});
    std::push_heap(entries_.begin(), entries_.end(), later);
  }
  QueueEntry pop() {
    std::pop_heap(entries_.begin(), entries_.end(), later);
    const QueueEntry top = entries_.back();
    entries_.pop_back();
    return top;
  }

 private:
  std::vector<QueueEntry> entries_;
};

class SortedArray {
 public:
  void resize(std::size_t) {}
  bool empty() const { return entries_.empty(); }
  void clear() { entries_.clear(); }
  void push(VertexId v, double key) {
    const QueueEntry e{key, v};
    entries_.insert(std::upper_bound(entries_.begin(), entries_.end(), e, later), e);
  }
  QueueEntry pop() {
    const QueueEntry last = entries_.back();
    entries_.pop_back();
    return last;
  }

 private:
  std::vector<QueueEntry> entries_;  // least at the back
};

class ResortedArray {
 public:
  void resize(std::size_t) {}
  bool empty() const { return entries_.empty(); }
  void clear() { entries_.clear(); }
  void push(VertexId v, double key) {
    entries_.push_back({key, v});
    std::sort(entries_.begin(), entries_.end(), later);
  }
  QueueEntry pop() {
    const QueueEntry last = entries_.back();
    entries_.pop_back();
    return last;
  }

 private:
  std::vector<QueueEntry> entries_;  // least at the back
};

}  // namespace warren
