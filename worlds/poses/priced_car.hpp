// SPDX-License-Identifier: BSD-3-Clause
// A car whose changes of gear and ways backwards have a price, for planners/shorten/redrive.hpp: between two poses not
// the shortest curve alone but, for each gear at its begin and at its end, the cheapest of all Reeds-Shepp words.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/path.hpp"
#include "core/plane/se2.hpp"
#include "worlds/poses/car_world.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {

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
  double distance(const State& a, const State& b) const;
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
  Way shortest(const State& a, const State& b) const;
  /// What of a way a word says.
  struct Recipe;
  Recipe priced(const SteeringWord& word, double off) const;

  const CarBody* car_;
  DrivingPrice price_;
};

}  // namespace warren
