// SPDX-License-Identifier: BSD-3-Clause
// A car among polygons, walls and bounds: poses (x, y, theta), and between two of them the shortest curve that its
// steering can drive (worlds/poses/dubins_curve.hpp forwards only, worlds/poses/reeds_shepp_curve.hpp both ways). Its
// body is a disc around the reference point or a polygon; the turning radius of the reference point is a number of its
// own.
//
// Every motion is certified free all along (worlds/poses/certified_motion.hpp): on a straight piece each point of the
// body goes as far as the reference point, on an arc farther by the ratio of its distance from the turning centre to
// the turning radius (of a disc, which looks the same however it is turned, the middle alone counts). Without bounds
// the reference point stays in the obstacles' box, on the curve too. On a map the body moves among the borders between
// free and blocked cells, which the scene has as walls (worlds/rasters/map_borders.hpp): as it touches none of them, it
// is among free cells wholly or not at all. The metric is the curve's length; for Dubins curves it has a direction. The
// chord in (x, y, rho cos theta, rho sin theta), shortened by sqrt(2), never exceeds it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "core/base/world.hpp"
#include "core/plane/se2.hpp"
#include "scenes/scene/scene.hpp"
#include "worlds/poses/certified_motion.hpp"
#include "worlds/poses/dubins_curve.hpp"
#include "worlds/poses/obstacle_tree.hpp"
#include "worlds/poses/reeds_shepp_curve.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {

struct CarOptions {
  double turning_radius = 1.0;            ///< of the reference point; > 0
  double radius = 0.0;                    ///< of the disc; >= 0; unused where there is an outline
  std::vector<Vec2> outline = {};         ///< the body as a polygon; empty: the disc
  double clearance = 0.0;                 ///< room around the body; finite, >= 0; 0: touching is blocked
  std::optional<double> resolution = {};  ///< motions that come so near may be refused; > 0; none: body size / 10,000
};

/// The body among the obstacles, whatever the steering. Immutable after construction; one Query a thread.
class CarBody {
 public:
  struct Query {
    Footprint footprint;
    std::uint64_t refused = 0;  ///< motions that were neither proved free nor blocked
  };

  /// Throws InputError for options out of range, outlines of the car and of obstacles that are no simple polygons, and
  /// a scene without anything that confines the car. Copies a map. Throws Stopped.
  CarBody(const Scene& scene, const CarOptions& options, const Execution& execution = {});

  Query make_query() const { return {Footprint(outline_.size())}; }
  /// Poses at which the body is in the bounds, if it can be there at that angle.
  Se2 at_unit(const std::array<double, 3>& u) const;
  bool is_free(const Se2& a, Query& query) const;
  /// Lower bound of the distance to the nearest obstacle less the clearance; <= 0: not free. More than `enough` counts
  /// as any number above it.
  double clearance(const Se2& a, double enough, Query& query) const;
  MotionVerdict judge(const SteeringCurve& curve, Query& query) const;
  bool is_free_curve(const SteeringCurve& curve, Query& query) const;

  double turning_radius() const { return turning_radius_; }
  double resolution() const { return resolution_; }
  const Box& box() const { return box_; }  ///< the bounds, else the box of the obstacles
  /// How far any point of the body goes while the reference point goes 1 with this steering.
  double pace(Steer steer) const { return pace_[as_whole<std::size_t>(as_whole<int>(steer) + 1)]; }

 private:
  bool confines(const Box& way) const;
  /// Is the body where it may be, if it touches no obstacle?
  bool is_confined(const Se2& a) const;

  std::vector<Vec2> outline_;  // of the disc: its middle
  double turning_radius_;
  double reach_;  // kept around the outline when planning: the clearance, of discs their radius too, and rounding
  std::array<double, 3> pace_{1.0, 1.0, 1.0};
  double resolution_;
  ObstacleTree tree_;
  Box box_;
  std::optional<OccupancyMap> map_;
};

/// Curve: DubinsCurve or ReedsSheppCurve.
template <class Curve>
class CarWorld {
 public:
  static constexpr std::size_t dimension = 3;
  static constexpr bool one_way = Curve::one_way;
  using State = Se2;
  using Query = CarBody::Query;

  CarWorld(const Scene& scene, const CarOptions& options, const Execution& execution = {})
      : body_(scene, options, execution) {}

  Query make_query() const { return body_.make_query(); }
  State at_unit(const std::array<double, 3>& u) const { return body_.at_unit(u); }
  bool is_free(const State& a, Query& query) const { return body_.is_free(a, query); }
  bool is_free_motion(const State& a, const State& b, Query& query) const {
    return body_.is_free_curve(curve(a, b), query);
  }
  double clearance(const State& a, double enough, Query& query) const { return body_.clearance(a, enough, query); }
  double distance(const State& a, const State& b) const {
    return body_.turning_radius() * Curve::shortest(a, b, body_.turning_radius()).length;
  }
  State interpolate(const State& a, const State& b, double t) const {
    const SteeringCurve way = curve(a, b);
    return t < 1.0 ? way.at(t * way.length()) : b;
  }
  std::array<double, 4> embed(const State& a) const {
    const double turn = body_.turning_radius() * std::numbers::sqrt2 * 0.5;
    const double shrink = std::numbers::sqrt2 * 0.5;
    const auto [sine, cosine] = portable::sin_and_cos(a.theta);
    return {shrink * a.x, shrink * a.y, turn * cosine, turn * sine};
  }

  SteeringCurve curve(const State& a, const State& b) const {
    return {a, b, Curve::shortest(a, b, body_.turning_radius()), body_.turning_radius()};
  }
  double suggested_samples(const Execution&) const { return 400.0; }
  std::uint64_t first_samples() const { return 100; }  ///< of a roadmap that is tried first
  const CarBody& body() const { return body_; }

 private:
  CarBody body_;
};

static_assert(SteerableWorld<CarWorld<DubinsCurve>>);
static_assert(SteerableWorld<CarWorld<ReedsSheppCurve>>);

}  // namespace warren
