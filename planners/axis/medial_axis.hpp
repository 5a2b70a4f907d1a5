// SPDX-License-Identifier: BSD-3-Clause
// The medial axis of the free plane: the points that have two nearest obstacles, as a graph of curves. It is the
// Voronoi diagram of walls, polygons' sides and the frame (the bounds' sides; without bounds, those of the obstacles'
// box), pruned to what lies inside the frame and outside all polygons.
//
// The diagram is exact for ends snapped to a grid of 2^-29 of half the world (planners/visibility/noding.hpp);
// clearances are computed anew at each curve's narrowest point, as distances to the obstacles that were given. Gaps
// narrower than `resolution` (a few units of the grid) count as closed. Where a vertex lies is decided by the sweep of
// planners/vertical_cells/cell_decomposition.hpp, so polygons must not overlap.
// Time O(n log n), 20 microseconds a segment (bench/cells_bench.cpp).
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "planners/axis/voronoi_diagram.hpp"

namespace warren {

/// A curve of the axis between two of its vertices.
struct AxisEdge {
  VertexId from, to;
  std::uint32_t site, other;  ///< what it lies between
  double length;              ///< along the curve
  double clearance;           ///< least distance of the curve to its two obstacles
};

/// Immutable after construction; any number of threads may read.
class MedialAxis {
 public:
  /// Throws ObstacleClash where polygons overlap; InputError where the frame has no inside; Stopped at the deadline.
  /// There must be an obstacle or bounds.
  MedialAxis(const PlaneObstacles& obstacles, const Execution& execution);

  const Box& frame() const { return frame_; }
  const std::vector<Vec2>& vertices() const { return vertices_; }
  const std::vector<AxisEdge>& edges() const { return edges_; }
  /// Which of the points lie inside the frame (or on it) and not strictly inside a polygon? 1 or 0 each; exact.
  std::vector<char> free_points(const PlaneObstacles& obstacles, const std::vector<Vec2>& points,
                                const Execution& execution) const;
  AxisCurve curve(const AxisEdge& edge) const {
    return {sites_[edge.site].shape, sites_[edge.other].shape, vertices_[edge.from], vertices_[edge.to]};
  }
  /// Least distance of the curve to the two obstacles that it lies between.
  double least_clearance(const AxisEdge& edge, const AxisCurve& curve) const;
  /// In world units; of each, its obstacle is one of obstacles().
  const std::vector<VoronoiSite>& sites() const { return sites_; }
  /// Walls, polygons' sides, and the frame's four sides; bounds are obstacles, a mere box isn't.
  const std::vector<Segment>& obstacles() const { return obstacles_; }
  std::size_t true_obstacle_count() const { return true_obstacle_count_; }
  /// Curves with less clearance are closed to everybody.
  double resolution() const { return resolution_; }
  double snap_error() const { return snap_error_; }

 private:
  void collect(const PlaneObstacles& obstacles);
  void build(const PlaneObstacles& obstacles, const Execution& execution);

  Box frame_;
  std::vector<Segment> obstacles_;
  std::size_t true_obstacle_count_ = 0;
  std::vector<Vec2> vertices_;
  std::vector<VoronoiSite> sites_;  // `segment`: the obstacle's number
  std::vector<AxisEdge> edges_;
  double resolution_ = 0.0;
  double snap_error_ = 0.0;
};

}  // namespace warren
