// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/poses/differential_curve.hpp"

#include <cmath>
#include <numbers>

#include "core/base/trigonometry.hpp"

namespace warren {
namespace {

void add_turn(SteeringWord& word, double turn_rad) {
  word.add(turn_rad > 0.0 ? Steer::left_on_spot : Steer::right_on_spot, std::abs(turn_rad));
}

}  // namespace

SteeringWord DifferentialCurve::shortest(const Se2& a, const Se2& b, double turning_radius) noexcept {
  const Se2 goal = seen_from(a, b, turning_radius);
  const double way = portable::hypot(goal.x, goal.y);
  SteeringWord word;
  if (way <= SteeringCurve::nothing + off_by_rounding(a, b, turning_radius)) {
    add_turn(word, goal.theta);
    return word;
  }
  const double towards = portable::atan2(goal.y, goal.x);
  const double away = wrapped_angle(towards - std::numbers::pi);
  const double then = turn_between(towards, goal.theta);
  const double then_from_away = turn_between(away, goal.theta);
  const bool forwards =
      std::abs(towards) + std::abs(then) <= std::abs(away) + std::abs(then_from_away) + SteeringCurve::nothing;
  add_turn(word, forwards ? towards : away);
  word.add(Steer::straight, forwards ? way : -way);
  add_turn(word, forwards ? then : then_from_away);
  return word;
}

}  // namespace warren
