// SPDX-License-Identifier: BSD-3-Clause
// A polygon that moves and turns among polygons, walls and bounds: SE(2), the poses (x, y, theta). The body may be
// convex or not and need not hold its reference point. Between two poses the reference point goes straight while the
// body turns evenly the shorter way; the whole motion is certified free (worlds/poses/certified_motion.hpp): a piece of
// it is where the body is farther from an obstacle than any point of it goes, or where a line along the obstacle's side
// stays between the two. Of the second only what comes nearer counts: a corner c that turns by w a unit of time and
// goes by v is within v t of where it was up to t^2 w^2 |c| / 2, so ways past an obstacle cost little.
//
// Metric: sqrt(dx^2 + dy^2 + (r dtheta)^2) with the turn the shorter way; r is the body's radius (its farthest corner
// from the reference point), so that a unit of either moves no point further than a unit. It is the geodesic metric of
// a cylinder of that radius, so the chord in (x, y, r cos theta, r sin theta) never exceeds it. Planning widens the
// clearance by the factor 1 + 1e-9 plus rounding, so that a verification can't fail by rounding.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/base/trigonometry.hpp"
#include "core/base/world.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "worlds/poses/certified_motion.hpp"
#include "worlds/poses/obstacle_tree.hpp"
#include "worlds/rasters/corridor_points.hpp"

namespace warren {

/// Immutable after construction; one Query a thread.
class Se2World : public BodyAmongObstacles {
 public:
  /// clearance: room around the body; 0: touching is blocked. Throws InputError unless it is finite and >= 0, for
  /// outlines of the body and of obstacles that are no simple polygons, and a scene without anything that confines the
  /// body. Without bounds the box of the obstacles confines the reference point. Copies a map. Throws Stopped.
  Se2World(const Scene& scene, std::span<const Vec2> outline, double clearance, const Execution& execution = {});

  bool is_free_motion(const State& a, const State& b, Query& query) const {
    return proved_free(judge_motion(a, b, query), query.refused);
  }
  double distance(const State& a, const State& b) const {
    const double turn = radius_ * turn_between(a.theta, b.theta);
    const Vec2 way = b.position() - a.position();
    return std::sqrt(dot(way, way) + turn * turn);
  }
  State interpolate(const State& a, const State& b, double t) const { return warren::interpolate(a, b, t); }
  /// The index-th sample whose reference point is in the middle of a map's corridor, in any heading: a pure function;
  /// the uniform one where the scene is no map.
  State corridor_state(std::uint64_t seed, std::uint64_t index) const;
  std::array<double, 4> embed(const State& a) const {
    const auto [sine, cosine] = portable::sin_and_cos(a.theta);
    return {a.x, a.y, radius_ * cosine, radius_ * sine};
  }

  MotionVerdict judge_motion(const State& a, const State& b, Query& query) const;

  /// Where the reference point may be while the body has the heading of a, on a coarse grid; no places where there are
  /// too many obstacles to look at all. A hint: motions between them have to be checked.
  PlaceGrid free_places(const State& a) const;
  Vec2 place_of(const State& a) const { return a.position(); }
  State shifted(const State& a, Vec2 to) const { return {to.x, to.y, a.theta}; }

  double suggested_samples(const Execution&) const { return 400.0; }
  std::uint64_t first_samples() const { return 50; }  ///< of a roadmap that is tried first
  /// Of the box times a full turn, in the metric.
  double sampled_volume() const { return box().width() * box().height() * 2.0 * std::numbers::pi * radius_; }
  double radius() const { return radius_; }  ///< of the body: its farthest corner from the reference point
  /// Motions that come so near may be refused.
  double resolution() const { return 1e-4 * radius_; }

 private:
  double radius_;
  std::optional<CorridorPoints> corridors_;  // only of maps
};

static_assert(SteerableWorld<Se2World>);

}  // namespace warren
