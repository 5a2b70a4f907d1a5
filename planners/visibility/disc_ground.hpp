// SPDX-License-Identifier: BSD-3-Clause
// What a disc of any radius meets among polygons and walls, contact allowed: the corners that its centre may go around
// on a circle, which of them may follow each other on a path, and the obstacles near a leg.
//
// Circles: around each corner with a free sector wider than half a turn (planners/visibility/visibility_graph), and
// around each wall without length that stands alone. The disc touches the corner, and nothing else that ends there, in
// the directions n with n . t <= 0 for both sides t of the sector: the circle's cone.
//
// Candidates: if a tangent of two circles is free for the disc, then the corners see each other as points do, because
// the strip, or the two triangles, between tangent and line of the corners is swept by the disc. So the neighbours of
// the visibility graph are all that can follow, for every radius. Walls without length hide nothing and are candidates
// of all. Without bounds the centre stays in the box of the obstacles, which is no wall.
//
// Build as VisibleCorners, O(n log n); 200 bytes a corner.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "spatial/obstacles/segment_grid.hpp"

namespace warren {

/// The circle around a corner; its radius is the disc's. Directions are unit vectors.
struct DiscCircle {
  Vec2 centre;
  Vec2 first, last;  ///< the sides of the free sector, which runs anticlockwise from first to last
  Vec2 begin;        ///< the first direction of the cone, anticlockwise
  double width;      ///< of the cone, radians, at most half a turn; a whole turn where the corner stands alone
  VertexId vertex;   ///< of the visible corners; no_vertex: a wall without length

  bool whole() const { return vertex == no_vertex; }
};

/// Immutable; any number of threads may read.
struct DiscGround {
  /// Throws Stopped at the deadline and the memory limit.
  DiscGround(const PlaneObstacles& obstacles, const Execution& execution);

  VisibleCorners corners;
  Box box;                        ///< of obstacles and bounds; empty where there is nothing
  std::optional<Box> room;        ///< where the centre must stay, where there are obstacles but no bounds
  std::vector<Segment> segments;  ///< pieces of the obstacles, then walls without length that stand alone
  SegmentGrid grid;               ///< of the segments
  std::vector<DiscCircle> circles;
  std::vector<std::uint32_t> circle_of;  ///< number of each vertex's, where its sector is wider than half a turn
  std::uint32_t first_whole = 0;         ///< the circles from here on go around walls without length
};

/// A ground, and which corners see each other, for questions that are many: the discs' radius, start and goal are each
/// question's own. Immutable; any number of threads may plan on it.
struct DiscRoadmap {
  /// Throw as VisibilityGraph's; `known`: its graph.
  DiscRoadmap(const PlaneObstacles& obstacles, const Execution& execution);
  DiscRoadmap(const PlaneObstacles& obstacles, Graph known, const Execution& execution);
  DiscRoadmap(const DiscRoadmap&) = delete;
  DiscRoadmap& operator=(const DiscRoadmap&) = delete;

  const DiscGround ground;
  const VisibilityGraph graph;  ///< refers to the ground's corners
};

/// Which segments come near a leg; scratch of one thread. The ground must outlive it.
class NearSegments {
 public:
  explicit NearSegments(const DiscGround& ground) : ground_(ground), epoch_(ground.segments.size(), 0) {}

  /// Calls visit(number) once for all segments of the ground that come nearer to s than `within`, and some more, until
  /// it returns false; whether it never did. `within` allows for the rounding of the caller's coordinates.
  template <class Visit>
  bool for_each(const Segment& s, double within, const Visit& visit) {
    const SegmentGrid& grid = ground_.grid;
    const Box box = box_of(s).grown(within);
    if (ground_.segments.empty() || !box.meets(grid.box())) return true;
    if (++now_ == 0) {
      std::fill(epoch_.begin(), epoch_.end(), 0U);
      now_ = 1;
    }
    const std::uint32_t last = cell(box.max).row;
    for (std::uint32_t row = cell(box.min).row; row <= last; ++row) {
      const auto [low, high] = span_in(s, grid.y_line(row) - within, grid.y_line(row + 1) + within);
      const std::uint32_t end = cell({high + within, s.a.y}).col;
      for (std::uint32_t col = cell({low - within, s.a.y}).col; col <= end; ++col) {
        for (const std::uint32_t number : grid.in_cell({col, row})) {
          if (epoch_[number] == now_) continue;
          epoch_[number] = now_;
          if (!visit(number)) return false;
        }
      }
    }
    return true;
  }

 private:
  struct Span {
    double low, high;
  };
  SegmentGrid::Cell cell(Vec2 p) const;
  /// The x that s takes where its y is between these.
  static Span span_in(const Segment& s, double y_low, double y_high);

  const DiscGround& ground_;
  std::vector<std::uint32_t> epoch_;
  std::uint32_t now_ = 0;
};

}  // namespace warren
