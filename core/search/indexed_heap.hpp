// SPDX-License-Identifier: BSD-3-Clause
// A d-ary heap of vertices with decrease-key: each vertex stands at most once, its place is kept in an array. Keys are
// kept beside the vertices so that sifting touches one cache line a level; order is (key, vertex), so that ties break
// by number and every queue of search_queues.hpp pops in the same order. push, decrease and pop are O(Arity log_Arity
// n).
#pragma once

#include <cassert>
#include <cstddef>
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

/// 16 bytes a vertex in the heap, 4 a vertex of the graph.
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

}  // namespace warren
