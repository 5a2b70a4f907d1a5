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
#include "core/search/search.hpp"
#include "parallel/execution.hpp"
#include "planners/contraction/hierarchy.hpp"
#include "planners/contraction/hierarchy_climb.hpp"

namespace warren {

/// A vertex that start or goal is joined to, and how far it is.
struct HierarchyEnd {
  VertexId vertex;
  double length;
};

/// An edge of a way, or an arc that stands for two of them.
struct PartOfWay {
  VertexId from;
  VertexId to;
  VertexId middle;      // no_vertex: an edge
  std::uint32_t first;  // of its two parts, which follow each other
};

/// What one thread keeps from one question to the next: as much as the largest of them touched.
struct HierarchyScratch {
  std::array<HierarchyClimb, 2> sides;
  std::vector<PartOfWay> parts;
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
  void begin(HierarchyClimb& side, std::span<const HierarchyEnd> ends);
  bool goes_on(const HierarchyClimb& side) const { return !side.empty() && side.top().key < best_; }
  void settle(std::size_t side);
  void fetch_row(VertexId v) const;
  void add_part(VertexId from, VertexId to, VertexId low, VertexId high);
  void take_apart();
  void append_edges(std::uint32_t part, RawVector<VertexId>& way);

  const Hierarchy& hierarchy_;
  HierarchyScratch& scratch_;
  const Execution& execution_;
  double best_ = 0.0;
  VertexId meeting_ = no_vertex;
  std::uint64_t settled_ = 0;
  std::uint64_t looks_ = 0;
  std::vector<std::uint32_t> todo_;  // parts
};

}  // namespace warren
