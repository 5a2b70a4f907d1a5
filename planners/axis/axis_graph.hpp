// SPDX-License-Identifier: BSD-3-Clause
// What of a medial axis may be travelled with a clearance, as a graph between two places on it: the edges that are wide
// enough, and the wide enough parts of the edges on which the two places lie. O(edges) to build, O(edges log edges) to
// find the widest way.
#pragma once

#include <array>
#include <vector>

#include "core/search/graph.hpp"
#include "core/search/search.hpp"
#include "planners/axis/medial_axis.hpp"
#include "planners/axis/retraction.hpp"
#include "planners/roadmap/roadmap_options.hpp"

namespace warren {

/// A stretch of one of the axis' edges between two vertices of the graph.
struct AxisLink {
  VertexId from, to;
  std::uint32_t edge;
  double first, last;  ///< parameters on the edge's curve, at `from` and at `to`
  double length;
  double clearance;
};

/// The axis' vertices, behind them the start and the goal. Refers to the axis and the execution; what takes longer than
/// a path throws Stopped.
class AxisGraph {
 public:
  /// Keeps what has at least this clearance and more than the axis' resolution.
  AxisGraph(const MedialAxis& axis, const AxisPlace& start, const AxisPlace& goal, double clearance,
            const Execution& execution);

  std::size_t vertex_count() const { return axis_.vertices().size() + 2; }
  VertexId start() const { return static_cast<VertexId>(axis_.vertices().size()); }
  VertexId goal() const { return start() + 1; }
  Vec2 place(VertexId v) const { return v < start() ? axis_.vertices()[v] : ends_[v - start()].at; }
  const std::vector<AxisLink>& links() const { return links_; }
  Graph graph() const;

  /// The largest clearance with which start and goal are joined; negative where they aren't at all.
  double widest() const;
  /// Drops links with less clearance.
  void narrow_to(double clearance);
  /// Start to goal; lengths are the curves' for A* and Dijkstra, numbers of links else.
  SearchResult search(SearchKind search, QueueKind queue) const;
  /// The link between two vertices that follow each other in a path: the shortest one, where several do.
  const AxisLink& link_between(VertexId v, VertexId w) const;
  /// The polyline along a search's path, both ends included.
  std::vector<Vec2> polyline(std::span<const VertexId> path) const;

 private:
  void add(VertexId from, VertexId to, std::uint32_t edge, double first, double last, double clearance);
  void join(VertexId v, double clearance);
  void index_links();

  const MedialAxis& axis_;
  const Execution& execution_;
  std::array<AxisPlace, 2> ends_;
  std::vector<AxisLink> links_;
  std::vector<std::uint32_t> first_, at_;  // the links at vertex v are at_[first_[v]] .. at_[first_[v + 1] - 1]
};

}  // namespace warren
