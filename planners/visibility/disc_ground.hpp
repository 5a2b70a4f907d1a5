// SPDX-License-Identifier: BSD-3-Clause
// What a disc of any radius meets among polygons and walls, contact allowed: the corners that its centre may go around
// on a circle, and which of them may follow each other on a path.
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
struct DiscRoadmap : NotCopied {
  /// Throws as VisibilityGraph; `known`: its graph, where that is there already.
  DiscRoadmap(const PlaneObstacles& obstacles, const Execution& execution, std::optional<Graph> known = {});

  const DiscGround ground;
  const VisibilityGraph graph;  ///< refers to the ground's corners
};

}  // namespace warren
