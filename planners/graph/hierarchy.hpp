// SPDX-License-Identifier: BSD-3-Clause
// A contraction hierarchy of a roadmap's free edges (Geisberger, Sanders, Schultes, Delling 2008): vertices were taken
// out one after the other, and each keeps arcs to those alone that were left, edges or shortcuts over earlier ones. So
// between any two vertices some shortest way climbs by arcs from both ends and meets. Plain arrays, as a file may hold
// them: 4 bytes a vertex and 16 an arc. Rows stand in the order of the roadmap's vertices, which follows the plane, not
// in that of taking out: taking a way apart reads rows that lie together.
#pragma once

#include <span>
#include <string>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"

namespace warren {

struct HierarchyArc {
  VertexId to;      ///< a vertex taken out later; they ascend in each row
  VertexId middle;  ///< the vertex, taken out earlier, that it leads over; no_vertex: an edge
  double length;
  friend bool operator==(const HierarchyArc&, const HierarchyArc&) = default;
};

/// Any number of threads may read.
struct Hierarchy {
  RawVector<EdgeEnd> first;      ///< one more than vertices: where the arcs of each begin
  RawVector<HierarchyArc> arcs;  ///< whole: a row is read at once, and so costs one look into the memory

  bool empty() const { return first.empty(); }
  std::size_t vertex_count() const { return first.empty() ? 0 : first.size() - 1; }
  std::span<const HierarchyArc> row(VertexId v) const { return {arcs.data() + first[v], arcs.data() + first[v + 1]}; }
  /// The arc in the row of `low` that leads to `high`; the number of all arcs where there is none.
  std::size_t arc_to(VertexId low, VertexId high) const;
};

/// Holds every number against its range and each shortcut against the arcs that it stands for, so that nobody who asks
/// afterwards looks beyond an array, whoever made them; what is wrong nevertheless makes ways longer, or of motions
/// that are none. Throws InputError, which names the array as part of `where`, and Stopped. O(arcs log degree).
void check_hierarchy(const Hierarchy& hierarchy, std::size_t vertex_count, const std::string& where,
                     const Execution& execution);

}  // namespace warren
