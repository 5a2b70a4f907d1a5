// SPDX-License-Identifier: BSD-3-Clause
// A roadmap's milestones and free edges by place. Milestones are filed in a grid; an edge is found by its ends, which
// are no farther from a box that it meets than it is long. The few longest are in a list of their own: one of them
// would let each box look at all edges.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "parallel/execution.hpp"
#include "roadmaps/graph/roadmap_parts.hpp"

namespace warren::serve {

/// Immutable; any number of threads may look.
class PlacedRoadmap {
 public:
  struct Edge {
    VertexId from, to;
  };
  /// Refers to the arrays. Four bytes a milestone, and eight for one free edge in 256. Throws Stopped.
  PlacedRoadmap(const RoadmapParts& parts, const Execution& execution);

  Vec2 at(VertexId v) const { return {parts_.state(v)[0], parts_.state(v)[1]}; }
  std::uint64_t milestones() const { return order_.size(); }
  std::uint64_t free_edges() const { return free_edges_; }
  /// Visits milestones in the box until visit says false. Throws Stopped.
  template <class Visit>
  void for_each_milestone(const Box& box, const Execution& execution, const Visit& visit) const;
  /// Visits each free edge that may meet the box once, until visit says false. Throws Stopped.
  template <class Visit>
  void for_each_edge_near(const Box& box, const Execution& execution, const Visit& visit) const;

 private:
  bool is_edge(VertexId v, std::size_t end) const {
    return (parts_.directed || v < parts_.to[end]) && parts_.state_of_end(end) == EdgeState::free;
  }
  double length(Edge edge) const;
  std::size_t cell_at(double share) const;
  std::size_t column(double x) const { return cell_at((x - box_.min.x) / std::max(box_.width(), 1e-300)); }
  std::size_t row(double y) const { return cell_at((y - box_.min.y) / std::max(box_.height(), 1e-300)); }
  void file_milestones(const Execution& execution);
  template <class Visit>
  void for_each_edge(const Execution& execution, const Visit& visit) const;
  void part_long_edges(const Execution& execution);

  RoadmapParts parts_;
  Box box_;                           // of all milestones
  std::size_t side_ = 1;              // of the grid, in cells
  std::vector<std::uint32_t> first_;  // of each cell, in order_
  std::vector<VertexId> order_;
  std::uint64_t free_edges_ = 0;
  double reach_ = 0.0;  // the length of the longest edge that is not in long_edges_
  std::vector<Edge> long_edges_;
};

template <class Visit>
void PlacedRoadmap::for_each_milestone(const Box& box, const Execution& execution, const Visit& visit) const {
  const std::size_t right = column(box.max.x);
  const std::size_t top = row(box.max.y);
  std::size_t seen = 0;
  for (std::size_t y = row(box.min.y); y <= top; ++y) {
    for (std::size_t x = column(box.min.x); x <= right; ++x) {
      if (seen++ % 256 == 0) execution.check();
      for (std::uint32_t i = first_[y * side_ + x]; i < first_[y * side_ + x + 1]; ++i) {
        if (seen++ % 1024 == 0) execution.check();
        if (box.contains(at(order_[i])) && !visit(order_[i])) return;
      }
    }
  }
}

template <class Visit>
void PlacedRoadmap::for_each_edge_near(const Box& box, const Execution& execution, const Visit& visit) const {
  for (std::size_t i = 0; i < long_edges_.size(); ++i) {
    if (i % 1024 == 0) execution.check();
    if (!visit(long_edges_[i])) return;
  }
  for_each_milestone(box.grown(reach_), execution, [&](VertexId v) {
    for (std::size_t end = parts_.first[v]; end < parts_.first[v + 1]; ++end) {
      if (!is_edge(v, end)) continue;
      const Edge edge{v, parts_.to[end]};
      if (length(edge) <= reach_ && !visit(edge)) return false;
    }
    return true;
  });
}

}  // namespace warren::serve
