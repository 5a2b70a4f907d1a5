// SPDX-License-Identifier: BSD-3-Clause
// The queues that users compare with the indexed heap. All pop in the order (key, vertex), so that the search takes the
// same steps with each; those without decrease-key keep stale entries, which the search skips because their vertex is
// settled already.
//   LazyHeap        binary heap, duplicates allowed: push and pop O(log n)
//   BucketQueue     circular buckets of keys, the first one in order: push O(1), pop O(log of a bucket)
//   SortedArray     kept sorted by insertion: push O(n) moves, pop O(1)
//   ResortedArray   sorted again after every push, as the course reports do: push O(n log n)
//   LinearScan      an unordered array, searched for its least entry: push O(1), pop O(n)
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/search/indexed_heap.hpp"

namespace warren {

inline constexpr auto later = [](const QueueEntry& a, const QueueEntry& b) { return b < a; };

namespace detail {

/// What all queues that are one array share.
class QueueArray {
 public:
  template <class Poll = NoPoll>
  void resize(std::size_t, const Poll& = {}) {}
  bool empty() const { return entries_.empty(); }
  void clear() { entries_.clear(); }

 protected:
  QueueEntry pop_back() {
    const QueueEntry last = entries_.back();
    entries_.pop_back();
    return last;
  }

  std::vector<QueueEntry> entries_;
};

}  // namespace detail

class LazyHeap : public detail::QueueArray {
 public:
  void push(VertexId v, double key) {
    entries_.push_back({key, v});
    std::push_heap(entries_.begin(), entries_.end(), later);
  }
  const QueueEntry& top() const { return entries_.front(); }
  QueueEntry pop() {
    std::pop_heap(entries_.begin(), entries_.end(), later);
    return pop_back();
  }
};

class SortedArray : public detail::QueueArray {  // least at the back
 public:
  void push(VertexId v, double key) {
    const QueueEntry e{key, v};
    entries_.insert(std::upper_bound(entries_.begin(), entries_.end(), e, later), e);
  }
  const QueueEntry& top() const { return entries_.back(); }
  QueueEntry pop() { return pop_back(); }
};

class ResortedArray : public SortedArray {
 public:
  void push(VertexId v, double key) {
    entries_.push_back({key, v});
    std::sort(entries_.begin(), entries_.end(), later);
  }
};

class LinearScan : public detail::QueueArray {
 public:
  void push(VertexId v, double key) { entries_.push_back({key, v}); }
  QueueEntry pop() {
    std::swap(*std::min_element(entries_.begin(), entries_.end()), entries_.back());
    return pop_back();
  }
};

/// Keys of [i·width, (i + 1)·width) lie in bucket i modulo 1024; the bucket that is being emptied is a small binary
/// heap, all others are unordered, so the order is exact for any width. Keys a whole turn ahead wait in a heap of their
/// own; a key below the current bucket (rounding, or an inconsistent heuristic) joins the current one. Fastest with a
/// width of about the median edge: bench/heap_bench.cpp.
class BucketQueue {
 public:
  /// width: units of the keys, > 0.
  explicit BucketQueue(double width = 1.0) : per_width_(1.0 / width) { assert(width > 0.0); }
  template <class Poll = NoPoll>
  void resize(std::size_t, const Poll& = {}) {}
  bool empty() const { return size_ == 0; }
  void clear() {
    for (auto& bucket : buckets_) bucket.clear();
    is_used_.fill(0);
    far_.clear();
    size_ = 0;
  }

  void push(VertexId v, double key) {
    const std::uint64_t number = number_of(key);
    if (size_++ == 0) current_ = number;
    if (number <= current_) {
      add(current_, {key, v});
      std::push_heap(bucket(current_).begin(), bucket(current_).end(), later);
    } else if (number - current_ < count) {
      add(number, {key, v});
    } else {
      far_.push(v, key);
    }
  }

  QueueEntry pop() {
    if (bucket(current_).empty()) advance();
    auto& entries = bucket(current_);
    std::pop_heap(entries.begin(), entries.end(), later);
    const QueueEntry top = entries.back();
    entries.pop_back();
    if (entries.empty()) is_used_[current_ % count / 64] &= ~(std::uint64_t{1} << current_ % 64);
    --size_;
    return top;
  }

 private:
  static constexpr std::uint64_t count = 1024;
  /// Numbers of keys beyond 2^62 widths are all the same: they share the last bucket, which is a heap.
  std::uint64_t number_of(double key) const {
    constexpr double last = 0x1.0p62;
    return static_cast<std::uint64_t>(std::min(last, std::max(0.0, key * per_width_)));
  }
  std::vector<QueueEntry>& bucket(std::uint64_t number) { return buckets_[number % count]; }
  void add(std::uint64_t number, const QueueEntry& e) {
    bucket(number).push_back(e);
    is_used_[number % count / 64] |= std::uint64_t{1} << number % 64;
  }
  /// Makes the next bucket with entries the current one and orders it.
  void advance() {
    std::uint64_t next = next_used();
    if (!far_.empty()) next = std::min(next, number_of(far_.top().key));
    current_ = next;
    while (!far_.empty() && number_of(far_.top().key) - current_ < count) {
      const QueueEntry e = far_.pop();
      add(number_of(e.key), e);
    }
    std::make_heap(bucket(current_).begin(), bucket(current_).end(), later);
  }
  /// The first number after current_ whose bucket has entries; the largest number if there is none.
  std::uint64_t next_used() const {
    for (std::uint64_t ahead = 1; ahead < count;) {
      const std::uint64_t slot = (current_ + ahead) % count;
      const std::uint64_t word = is_used_[slot / 64] >> slot % 64;
      if (word != 0) return current_ + ahead + static_cast<std::uint64_t>(std::countr_zero(word));
      ahead += 64 - slot % 64;
    }
    return ~std::uint64_t{0};
  }

  double per_width_;
  std::array<std::vector<QueueEntry>, count> buckets_;
  std::array<std::uint64_t, count / 64> is_used_{};  // one bit a bucket
  LazyHeap far_;
  std::uint64_t current_ = 0;
  std::size_t size_ = 0;
};

}  // namespace warren
