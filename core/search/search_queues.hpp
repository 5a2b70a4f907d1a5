// SPDX-License-Identifier: BSD-3-Clause
// The queues of a search: an indexed heap, and what users compare with it. All pop in the order (key, vertex), so that
// the search takes the same steps with each; those without decrease-key keep stale entries, which the search skips
// because their vertex is settled already.
//   IndexedHeap     d-ary heap with decrease-key: push and pop O(log n); the usual one
//   LazyHeap        binary heap, duplicates allowed: push and pop O(log n)
//   BucketQueue     circular buckets of keys, the first one in order: push O(1), pop O(log of a bucket); of maps
//   SortedArray     kept sorted by insertion: push O(n) moves, pop O(1); these three for `compare` alone
//   ResortedArray   sorted again after every push, as the course reports do: push O(n log n)
//   LinearScan      an unordered array, searched for its least entry: push O(1), pop O(n)
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"

namespace warren {

struct QueueEntry {
  double key;
  VertexId vertex;
  friend constexpr bool operator<(const QueueEntry& a, const QueueEntry& b) {
    return a.key < b.key || (a.key == b.key && a.vertex < b.vertex);
  }
};

/// A d-ary heap of vertices with decrease-key: each vertex stands at most once, its place is kept in an array. Keys are
/// kept beside the vertices so that sifting touches one cache line a level. push, decrease and pop are O(Arity
/// log_Arity n). 16 bytes a vertex in the heap, 4 a vertex of the graph.
template <unsigned Arity = 4>
class IndexedHeap {
 public:
  /// Ready for vertices 0 .. vertex_count - 1. The heap must be empty. O(vertex_count) only where it grows.
  template <class Poll = NoPoll>
  void resize(std::size_t vertex_count, const Poll& poll = {}) {
    assert(empty());
    if (vertex_count > place_.size()) assign_polled(place_, vertex_count, VertexId{0}, poll);
  }
  /// Asks for what push(v) reads first, ahead of time.
  void fetch(VertexId v) const { __builtin_prefetch(place_.data() + v); }
  bool empty() const { return entries_.empty(); }
  std::size_t size() const { return entries_.size(); }
  void clear() { entries_.clear(); }

  /// Is v in the heap? Places are checked against the entries, so they need no clearing.
  bool contains(VertexId v) const { return place_[v] < entries_.size() && entries_[place_[v]].vertex == v; }

  /// Inserts v, or lowers its key; a key that is not lower changes nothing.
  void push(VertexId v, double key) {
    if (contains(v)) {
      if (key < entries_[place_[v]].key) sift_up(place_[v], {key, v});
      return;
    }
    entries_.push_back({key, v});
    sift_up(static_cast<VertexId>(entries_.size() - 1), {key, v});
  }

  const QueueEntry& top() const { return entries_.front(); }

  QueueEntry pop() {
    const QueueEntry top = entries_.front();
    const QueueEntry last = entries_.back();
    entries_.pop_back();
    if (!entries_.empty()) sift_down(last);
    return top;
  }

 private:
  void put(std::size_t at, const QueueEntry& e) {
    entries_[at] = e;
    place_[e.vertex] = static_cast<VertexId>(at);
  }
  void sift_up(std::size_t at, const QueueEntry e) {
    while (at > 0) {
      const std::size_t parent = (at - 1) / Arity;
      if (!(e < entries_[parent])) break;
      put(at, entries_[parent]);
      at = parent;
    }
    put(at, e);
  }
  void sift_down(const QueueEntry e) {
    std::size_t at = 0;
    const std::size_t n = entries_.size();
    for (;;) {
      const std::size_t first = Arity * at + 1;
      if (first >= n) break;
      const std::size_t end = first + Arity < n ? first + Arity : n;
      std::size_t least = first;
      for (std::size_t child = first + 1; child < end; ++child) {
        if (entries_[child] < entries_[least]) least = child;
      }
      if (!(entries_[least] < e)) break;
      put(at, entries_[least]);
      at = least;
    }
    put(at, e);
  }

  std::vector<QueueEntry> entries_;
  RawVector<VertexId> place_;
};

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

/// Keys of [i·width, (i + 1)·width) lie in bucket i modulo 1024; the bucket that is being emptied is sorted, what joins
/// it meanwhile lies in a small binary heap, all others are unordered, so the order is exact for any width. Keys a
/// whole turn ahead wait in a heap of their own; a key below the current bucket (rounding, or an inconsistent
/// heuristic) joins the current one. Fastest with a width of about the median edge: bench/heap_bench.cpp.
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
    late_.clear();
    far_.clear();
    size_ = 0;
  }

  void push(VertexId v, double key) {
    const std::uint64_t number = number_of(key);
    if (size_++ == 0) current_ = number;
    if (number <= current_) {
      late_.push(v, key);
    } else if (number - current_ < count) {
      add(number, {key, v});
    } else {
      far_.push(v, key);
    }
  }

  QueueEntry pop() {
    if (late_.empty() && bucket(current_).empty()) advance();
    auto& entries = bucket(current_);
    --size_;
    if (!late_.empty() && (entries.empty() || late_.top() < entries.back())) return late_.pop();
    const QueueEntry top = entries.back();
    entries.pop_back();
    if (entries.empty()) is_used_[current_ % count / 64] &= ~(std::uint64_t{1} << current_ % 64);
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
    std::sort(bucket(current_).begin(), bucket(current_).end(), later);
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
  LazyHeap late_;                                    // joined the current bucket, which is sorted
  LazyHeap far_;
  std::uint64_t current_ = 0;
  std::size_t size_ = 0;
};

}  // namespace warren
