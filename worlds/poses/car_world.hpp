// SPDX-License-Identifier: BSD-3-Clause
// A car among polygons, walls and bounds: poses (x, y, theta), and between two of them the shortest curve that its
// steering can drive (worlds/poses/dubins_curve.cpp forwards only, worlds/poses/reeds_shepp_curve.cpp both ways). Its
// body is a disc around the reference point or a polygon; the turning radius of the reference point is a number of its
// own.
//
// Every motion is certified free all along (worlds/poses/certified_motion.hpp): the curve is halved until, at the
// middle of each piece, the body is farther from every polygon, wall and bound (BodyAmongObstacles in
// worlds/poses/obstacle_tree.hpp) than any point of it goes from there to the piece's ends. It is blocked where it
// touches, and refused, and counted, where pieces reach the resolution: refused is not free. Distances are those of the
// body grown by the clearance and a billionth of clearance, radius and turning radius. On a map the obstacles are the
// borders of blocked cells, so that both ends have to be free already. On a straight piece each point of the body goes
// as far as the reference point, on an arc farther by the ratio of its distance from the turning centre to the turning
// radius (of a disc, which looks the same however it is turned, the middle alone counts). Without bounds the reference
// point stays in the obstacles' box, on the curve too. The metric is the curve's length; for Dubins curves it has a
// direction. The chord in (x, y, rho cos theta, rho sin theta), shortened by sqrt(2), never exceeds it. The metric of a
// differential drive is that of turning bodies, the root of the squares of way and weighed turn, whatever it turns on
// the way: what it turns there obeys no triangle inequality.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "core/base/world.hpp"
#include "core/plane/se2.hpp"
#include "scenes/scene/scene.hpp"
#include "worlds/poses/certified_motion.hpp"
#include "worlds/poses/obstacle_tree.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {

struct CarOptions {
  double turning_radius = 1.0;     ///< of the reference point; > 0
  double radius = 0.0;             ///< of the disc; >= 0; unused where there is an outline
  std::vector<Vec2> outline = {};  ///< the body as a polygon; empty: the disc
  double clearance = 0.0;          ///< room around the body; finite, >= 0; 0: touching is blocked
};

/// The body among the obstacles, whatever the steering; its reach is the clearance, of discs their radius too, and
/// rounding. Immutable after construction; one Query a thread.
class CarBody : public BodyAmongObstacles {
 public:
  /// Throws InputError for options out of range, outlines of the car and of obstacles that are no simple polygons, and
  /// a scene without anything that confines the car. Copies a map. Throws Stopped.
  CarBody(const Scene& scene, const CarOptions& options, const Execution& execution = {});

  MotionVerdict judge(const SteeringCurve& curve, Query& query) const;
  bool is_free_curve(const SteeringCurve& curve, Query& query) const {
    return proved_free(judge(curve, query), query.refused);
  }

  double turning_radius() const { return turning_radius_; }
  double resolution() const { return resolution_; }  ///< motions that come so near may be refused

 private:
  bool confines(const Box& way) const;

  double turning_radius_;
  double resolution_;
};

/// Curve: DubinsCurve, ReedsSheppCurve or DifferentialCurve.
template <class Curve>
class CarWorld : public CarBody {
 public:
  static constexpr bool one_way = Curve::one_way;

  using CarBody::CarBody;
  bool is_free_motion(const State& a, const State& b, Query& query) const { return is_free_curve(curve(a, b), query); }
  double distance(const State& a, const State& b) const {
    if constexpr (Curve::turns_on_spot) {
      const double turn = turning_radius() * turn_between(a.theta, b.theta);
      return portable::hypot(b.x - a.x, b.y - a.y, turn);
    }
    return turning_radius() * Curve::shortest(a, b, turning_radius()).length;
  }
  State interpolate(const State& a, const State& b, double t) const {
    const SteeringCurve way = curve(a, b);
    return t < 1.0 ? way.at(t * way.length()) : b;
  }
  std::array<double, 4> embed(const State& a) const {
    constexpr double shrink = Curve::turns_on_spot ? 1.0 : std::numbers::sqrt2 * 0.5;
    const double turn = turning_radius() * shrink;
    const auto [sine, cosine] = portable::sin_and_cos(a.theta);
    return {shrink * a.x, shrink * a.y, turn * cosine, turn * sine};
  }

  SteeringCurve curve(const State& a, const State& b) const {
    return {a, b, Curve::shortest(a, b, turning_radius()), turning_radius()};
  }
  double suggested_samples(const Execution&) const { return 400.0; }
  std::uint64_t first_samples() const { return 100; }  ///< of a roadmap that is tried first
  const CarBody& body() const { return *this; }
};

static_assert(SteerableWorld<CarWorld<DubinsCurve>>);
static_assert(SteerableWorld<CarWorld<ReedsSheppCurve>>);
static_assert(SteerableWorld<CarWorld<DifferentialCurve>>);

struct DrivingPrice {
  double cusp = 0.0;     ///< of a change of gear, in units of length; finite, >= 0
  double reverse = 1.0;  ///< of a unit of length driven backwards; finite, >= 1
};

/// A curve and what it costs, the changes of gear on it included. Gears: 1 forwards, -1 backwards, 0 of no way at all.
struct PricedCurve {
  SteeringCurve curve;
  double price = 0.0;
  std::int8_t first_gear = 0;
  std::int8_t last_gear = 0;
};

/// A car whose changes of gear and ways backwards have a price, for planners/shorten/redrive.hpp: between two poses not
/// the shortest curve alone but, for each gear at its begin and at its end, the cheapest of all Reeds-Shepp words.
/// Refers to the car. Immutable; one Query a thread.
class PricedCar {
 public:
  using State = Se2;
  using Query = CarBody::Query;
  using Way = PricedCurve;

  PricedCar(const CarBody& car, const DrivingPrice& price) : car_(&car), price_(price) {}

  Query make_query() const { return car_->make_query(); }
  bool is_free(const State& a, Query& query) const { return car_->is_free(a, query); }
  bool is_free_way(const Way& way, Query& query) const { return car_->is_free_curve(way.curve, query); }
  double gear_change_price() const { return price_.cusp; }
  /// Of the shortest curve: no way costs less.
  double distance(const State& a, const State& b) const {
    return car_->turning_radius() * ReedsSheppCurve::shortest(a, b, car_->turning_radius()).length;
  }
  /// Of each gear at the begin and at the end the cheapest way below that price, if there is one: at most four.
  std::vector<Way> ways(const State& a, const State& b, double most) const;
  /// A pose near a by four numbers in [0, 1): where the car gets from it by one piece, or shifted and turned. `scale`
  /// 1: up to a turning radius or so away.
  State drawn_near(const State& a, const std::array<double, 4>& u, double scale) const;
  /// Appends poses up to the way's end, between each two of which it is the shortest curve.
  static void append(Path<State>& path, const Way& way);

  int gear_at_begin(const State& a, const State& b) const { return shortest(a, b).first_gear; }
  int gear_at_end(const State& a, const State& b) const { return shortest(a, b).last_gear; }
  /// Of a path whose legs are shortest curves, and of the changes of gear at its ends from and to those given; 0: none.
  double price(std::span<const State> path, int gear_before = 0, int gear_after = 0) const;

 private:
  /// What of a way a word says.
  struct Recipe {
    SteeringWord word;
    double price = 0.0;
    std::int8_t first_gear = 0;
    std::int8_t last_gear = 0;
  };
  Recipe shortest(const State& a, const State& b) const;
  Recipe priced(const SteeringWord& word, double off) const;

  const CarBody* car_;
  DrivingPrice price_;
};

/// Ways from a free pose whose last stroke is 0.8 turning radii long: poses, the first `from` itself, between each two
/// of which the car's shortest curve is one free stroke. At most `most`, the fewest strokes first. None where `from`
/// has such a stroke itself, or where each of the three searches tried 10,000 poses or all there are in vain. Driven
/// back, they are ways in. Throws Stopped.
std::vector<Path<Se2>> ways_out(const CarBody& body, const Se2& from, std::size_t most, const Execution& execution);

}  // namespace warren
