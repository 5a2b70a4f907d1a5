// SPDX-License-Identifier: BSD-3-Clause
// Questions to a hierarchy: the shortest way between two places that are joined to some of its vertices. Both ends
// climb by Dijkstra's search, the one whose next vertex is nearer first; a vertex to which a way from above is shorter
// is not climbed from (stalling), and neither end goes on beyond the best way found. Then each arc is taken apart into
// the edges that it stands for. Exact but for rounding: a way that is longer by less than that may be taken.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/search/indexed_heap.hpp"
#include "core/search/search.hpp"
#include "parallel/execution.hpp"
#include "planners/contraction/hierarchy.hpp"

namespace warren {

/// A vertex that start or goal is joined to, and how far it is.
struct HierarchyEnd {
  VertexId vertex;
  double length;
};

/// What one thread keeps from one question to the next: 32 bytes a vertex.
struct HierarchyScratch {
  struct Side {
    SearchState state;
    IndexedHeap<> queue;
  };
  std::array<Side, 2> sides;
};

/// One thread's. Refers to all that it is given.
class HierarchyQuery {
 public:
  HierarchyQuery(const Hierarchy& hierarchy, HierarchyScratch& scratch, const Execution& execution)
      : hierarchy_(hierarchy), scratch_(scratch), execution_(execution) {}

  /// Is there a way shorter than `limit`? Lengths of the ends included. Throws Stopped.
  bool search(std::span<const HierarchyEnd> start, std::span<const HierarchyEnd> goal, double limit);
  /// After a search that found one: from the vertex of start that it leaves from to that of the goal. Throws Stopped,
  /// and InputError for an index whose shortcuts have no end.
  RawVector<VertexId> path();

  std::uint64_t settled() const { return settled_; }
  std::uint64_t looks() const { return looks_; }  ///< at arcs, by the last search

 private:
  using Side = HierarchyScratch::Side;
  /// An edge, or what a shortcut leads over.
  struct Step {
    VertexId from;
    VertexId to;
    VertexId middle;
  };
  void begin(Side& side, std::span<const HierarchyEnd> ends);
  bool goes_on(const Side& side) const { return !side.queue.empty() && side.queue.top().key < best_; }
  void settle(std::size_t side);
  bool is_stalled(const SearchState& state, VertexId v, double length);
  VertexId middle_of(VertexId low, VertexId high) const;
  void append_way(const Step& step, RawVector<VertexId>& way);

  const Hierarchy& hierarchy_;
  HierarchyScratch& scratch_;
  const Execution& execution_;
  double best_ = 0.0;
  VertexId meeting_ = no_vertex;
  std::uint64_t settled_ = 0;
  std::uint64_t looks_ = 0;
  std::vector<Step> todo_;
};

}  // namespace warren
