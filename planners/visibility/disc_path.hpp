// SPDX-License-Identifier: BSD-3-Clause
// The shortest path of a disc among polygons and walls, exactly: tangents between circles around the obstacles' corners
// and arcs on them (planners/visibility/visibility_graph), found by A* over tangents.
//
// From a circle, and a side of it, a way leads on along the circle and then a tangent. A way is in the queue by its
// length and the straight line from its end; when it comes first, and not before, its tangent is compared with the
// obstacles near it. Then it arrives: if an earlier arrival on the same side of the circle reaches its place along a
// free arc at no more cost, it is dropped; else it offers its cost to all tangents that leave farther on, up to the
// first place where the arc is blocked.
//   a tangent is free   no obstacle comes nearer than the radius
//   an arc is free      (its ends are) no obstacle nearer than two radii has its nearest point in a direction inside
//                       it: circle and obstacle, both grown by the radius, cross twice at most
//
// Two searches are a bracket: one takes for free what keeps the radius less a trifle, so that nothing that is free is
// missed: its length is a lower bound, and where it finds nothing there is no path. The other draws circles larger by a
// trifle, so that rounding brings no path nearer than the radius. Mostly the first one's way stands the second's test,
// and is not searched again. The trifle: 1e-12 of the radius, and some units in the last place of the world's size.
//
// Time as a lazy visibility search, O(k log k) a circle that is reached, k pieces in sight of its corner, and some 0.2
// us a tangent tried; memory 300 bytes a corner and 100 a tangent.
// (Laumond 1987; Storer, Reif 1994; Hershberger, Guibas 1988.)
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "planners/visibility/visibility_graph.hpp"

namespace warren {

/// A piece of the path of a disc's centre: straight, or along a circle.
struct DiscPiece {
  Vec2 from, to;
  std::optional<Vec2> centre;  ///< of the circle; none: straight
  bool anticlockwise = false;  ///< on a circle
  double angle = 0.0;          ///< radians, on a circle
};

struct DiscPath {
  /// solved; infeasible: proved, no way keeps the radius; not_connected: ways that keep it within rounding alone;
  /// start_blocked, goal_blocked: does not keep the radius, or only within rounding.
  Outcome outcome = Outcome::not_connected;
  /// Start to goal. An arc is cut where an obstacle is as near to it as the polyline around it bulges.
  std::vector<DiscPiece> pieces;
  double radius = 0.0;           ///< of the circles: the disc's, and a trifle
  double length = 0.0;           ///< of the pieces, arcs as arcs
  double lower_bound = 0.0;      ///< no path is shorter, proved; 0: nothing is known; infinity: there is none
  std::uint64_t circles = 0;     ///< that there are
  std::uint64_t candidates = 0;  ///< tangents that were drawn
  std::uint64_t checked = 0;     ///< of them, those compared with the obstacles
  std::uint64_t free = 0;        ///< of these, those that nothing blocks
  std::uint64_t arrivals = 0;    ///< at circles, which no earlier one was as good as

  /// Turns around corners: arcs that follow each other on a circle count as one.
  std::uint64_t arcs() const;
};

/// Plans for the centre of a disc of this radius, > 0 and finite. The bounds are obstacles for the whole disc; without
/// them the centre stays in the obstacles' box. known: who sees whom, where that is there already. A function of the
/// problem alone, on the caller's thread. Throws Stopped.
DiscPath shortest_disc_path(const DiscGround& ground, Vec2 start, Vec2 goal, double radius, const Execution& execution,
                            const Graph* known = nullptr);

/// How far an arc turns, at most, from corner to corner of the polyline.
inline constexpr double turn_of_polyline_rad = 0.005;

/// A solved path as a polyline, which keeps the radius as well: arcs by tangents from outside. It is longer by less
/// than 3e-6 of the arcs.
Path<Vec2> polyline_of(const DiscPath& path, const Execution& execution);

}  // namespace warren
