// SPDX-License-Identifier: BSD-3-Clause
#include "planners/axis/axis_lines.hpp"

#include <algorithm>

#include "parallel/polled_sort.hpp"
#include "planners/shorten/certain_clearance.hpp"

namespace warren {
namespace {

constexpr std::size_t edges_per_poll = 256;

/// Collects lines; a vertex of the axis becomes a point where a line first comes by.
class LinesOfAxis {
 public:
  LinesOfAxis(const AxisRoadmap& roadmap, double clearance)
      : roadmap_(roadmap), clearance_(clearance), point_of_(roadmap.axis.vertices().size(), no_vertex) {}

  void add(const AxisEdge& edge) {
    const AxisCurve curve = roadmap_.axis.curve(edge);
    const Vec2 from = roadmap_.axis.vertices()[edge.from];
    const Vec2 to = roadmap_.axis.vertices()[edge.to];
    corners_.assign(1, from);
    curve.between(from, to).append_polyline(corners_);
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      if (!certainly_keeps_clearance(roadmap_.index, {corners_[i - 1], corners_[i]}, clearance_)) return;
    }
    VertexId before = vertex(edge.from);
    for (std::size_t i = 1; i < corners_.size(); ++i) {
      const VertexId next = i + 1 == corners_.size() ? vertex(edge.to) : point(corners_[i]);
      if (before != next) lines_.edges.push_back({std::min(before, next), std::max(before, next)});
      before = next;
    }
  }
  StraightLines take(const Execution& execution) {
    polled_sort(lines_.edges.begin(), lines_.edges.end(), execution);
    lines_.edges.erase(std::unique(lines_.edges.begin(), lines_.edges.end()), lines_.edges.end());
    return std::move(lines_);
  }

 private:
  VertexId point(Vec2 at) {
    lines_.points.push_back(at);
    return static_cast<VertexId>(lines_.points.size() - 1);
  }
  VertexId vertex(VertexId v) {
    if (point_of_[v] == no_vertex) point_of_[v] = point(roadmap_.axis.vertices()[v]);
    return point_of_[v];
  }

  const AxisRoadmap& roadmap_;
  double clearance_;
  std::vector<VertexId> point_of_;
  std::vector<Vec2> corners_;
  StraightLines lines_;
};

}  // namespace

StraightLines axis_lines(const AxisRoadmap& roadmap, double clearance, const Execution& execution) {
  const double least = std::max(clearance, roadmap.axis.resolution());
  LinesOfAxis lines(roadmap, clearance);
  for (std::size_t i = 0; i < roadmap.axis.edges().size(); ++i) {
    if (i % edges_per_poll == 0) execution.check();
    const AxisEdge& edge = roadmap.axis.edges()[i];
    if (edge.clearance >= least) lines.add(edge);
  }
  return lines.take(execution);
}

}  // namespace warren
