// SPDX-License-Identifier: BSD-3-Clause
// A point or disc among simple polygons, walls and bounds: polygons convex or not, apart, touching, sharing corners and
// sides, overlapping (their union is blocked). Every point of a motion keeps the clearance from every wall and outline;
// with clearance 0 it keeps off them (positive distance, decided exactly). The reference point stays in the box of the
// obstacles, or strictly inside the bounds. Planning widens the clearance by the factor 1 + 1e-9, so that rounding
// can't fail the verification. A state costs the walls and outlines near it (spatial/obstacles/wall_index) and a
// descent to the polygon around it (spatial/obstacles/polygon_index), whatever the number of polygons; a motion only
// the former, since who starts outside and crosses no outline stays outside.
#pragma once

#include <span>

#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "spatial/obstacles/polygon_index.hpp"
#include "spatial/obstacles/wall_index.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {

/// Immutable after construction; one Query a thread.
class PolygonWorld : public PointWorld {
 public:
  struct Query {};

  /// clearance >= 0 and finite (InputError otherwise). Throws InputError for polygons that are not simple, naming their
  /// line, and for a scene without any obstacle.
  PolygonWorld(const Scene& scene, double clearance, const Execution& execution);

  Query make_query() const { return {}; }
  bool is_free(const State& a, Query&) const noexcept {
    return box_.contains(a) && sides_.keeps_clearance(a, a, planning_clearance_) && !polygons_.polygon_around(a);
  }
  /// If both ends are free.
  bool is_free_motion(const State& a, const State& b, Query&) const noexcept {
    return sides_.keeps_clearance(a, b, planning_clearance_);
  }

  /// Uniform samples that a first roadmap needs: 4.5 for each square as wide as a typical gap, at least 500 and at most
  /// 8 a corner beyond that. A pure function of the obstacles.
  double suggested_samples(const Execution& execution) const;

  double planning_clearance() const { return planning_clearance_; }  ///< what motions keep: clearance (1 + 1e-9)
  const WallIndex& sides() const { return sides_; }                  ///< walls, outlines and bounds
  const PolygonIndex& polygons() const { return polygons_; }

 private:
  double clearance_;
  double planning_clearance_;
  PolygonIndex polygons_;
  WallIndex sides_;
};

static_assert(SteerableWorld<PolygonWorld>);

// What blocks the reference point of a polygon that does not turn: Minkowski sums of the obstacles with the mirrored
// body, piece by convex piece, so that planners for points (visibility graph, cells) plan for the body at that angle.
// Pieces of one obstacle overlap by the width of the body; so do obstacles that the body does not fit between.

/// outline: around the reference point, three or more corners. room: distance that shall be kept, > 0; the polygons
/// keep at least that much, and at corners up to 1 / cos(pi / disc_corners) times as much: 0.5 % more for 32.
/// InputError for outlines that are no simple polygons, and where the body doesn't fit in the bounds at all. Without
/// bounds the box of the obstacles confines the reference point, and becomes the bounds. Throws Stopped.
PlaneObstacles translation_obstacles(const Scene& scene, std::span<const Vec2> outline, double theta, double room,
                                     std::size_t disc_corners = 32, const Execution& execution = {});

}  // namespace warren
