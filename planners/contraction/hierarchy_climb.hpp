// SPDX-License-Identifier: BSD-3-Clause
// What one end of a question has reached of a hierarchy: a few thousand vertices of millions. They stand in a table of
// their own, by a hash of their numbers, so that a question touches some hundred kilobytes that stay in the nearest
// caches, and a thread needs no array as long as the roadmap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/search/indexed_heap.hpp"

namespace warren {

/// One end's distances, parents and queue. Vertices leave the queue by distance, then by number.
class HierarchyClimb {
 public:
  /// Before each question: forgets all. O(vertices that were reached).
  void clear();
  /// Of the way to v; infinity: not reached.
  double length(VertexId v) const { return slots_[slot_of(v)].length; }
  /// Is this the shortest way to v so far? Then it is kept, and v waits in the queue.
  void reach(VertexId v, double length, VertexId parent);

  bool empty() const { return queue_.empty(); }
  const QueueEntry& top() const { return queue_.front(); }
  /// Takes the top, and what waits behind it for ways that are no longer the shortest.
  QueueEntry pop();
  /// The vertices from v back to where the climb began.
  RawVector<VertexId> back_from(VertexId v) const;

 private:
  struct Slot {
    VertexId vertex = no_vertex;  // none: the slot is empty
    VertexId parent = no_vertex;
    double length = std::numeric_limits<double>::infinity();
  };
  static constexpr unsigned first_bits = 13;

  /// Where v stands; the empty slot for it where it doesn't.
  std::size_t slot_of(VertexId v) const {
    std::size_t slot = v * std::uint64_t{0x9e3779b97f4a7c15U} >> shift_;
    while (slots_[slot].vertex != v && slots_[slot].vertex != no_vertex) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow();

  std::vector<Slot> slots_;  // open addressing, at most half full
  unsigned shift_ = 64 - first_bits;
  std::vector<std::uint32_t> used_;  // slots
  std::vector<QueueEntry> queue_;    // a heap, with entries of ways that were longer
};

}  // namespace warren
