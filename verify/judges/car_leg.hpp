// SPDX-License-Identifier: BSD-3-Clause
// What two poses say of the leg between them, as the verification reads a car's path.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"
#include "core/plane/se2.hpp"
#include "verify/near/straight_runs.hpp"

namespace warren {

/// From one pose to the next with the steering wheel still, as a car takes it.
struct CarLeg {
  Se2 a;
  Vec2 chord;
  double turn = 0.0;
  double ahead = 0.0;   // the chord along the heading halfway; negative: backwards
  double aside = 0.0;   // and square to it: 0 but for rounding
  double length = 0.0;  // of the arc
  double radius = std::numeric_limits<double>::infinity();

  CarLeg(const Se2& from, const Se2& to, double turn_rad)
      : a(from), chord{to.x - from.x, to.y - from.y}, turn(turn_rad) {
    const double middle = from.theta + 0.5 * turn;
    const auto [sine, cosine] = portable::sin_and_cos(middle);
    ahead = chord.x * cosine + chord.y * sine;
    aside = chord.y * cosine - chord.x * sine;
    const double half_sine = portable::sin(0.5 * std::abs(turn));
    length = half_sine > 0.0 ? std::abs(ahead) * 0.5 * std::abs(turn) / half_sine : std::abs(ahead);
    if (half_sine > 0.0) radius = 0.5 * std::abs(ahead) / half_sine;
  }
  bool is_half_turn() const { return std::abs(turn) >= std::numbers::pi * (1.0 - 1e-12); }
};

/// The shorter way round. Half a turn could go either way: it is read as one ahead.
inline CarLeg car_leg_between(const Se2& a, const Se2& b) {
  const CarLeg leg(a, b, shorter_turn(a.theta, b.theta));
  if (!leg.is_half_turn() || leg.ahead >= 0.0) return leg;
  return {a, b, leg.turn - std::copysign(2.0 * std::numbers::pi, leg.turn)};
}

}  // namespace warren
