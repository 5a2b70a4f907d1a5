// SPDX-License-Identifier: BSD-3-Clause
// How a differential drive goes from pose to pose: it turns on the spot towards the goal, or away from it to drive
// backwards, goes straight, and turns on the spot to the goal's heading. It takes the way that turns less, of equal
// ones that forwards. It drives no arcs: its `turning radius` only says how much a radian of turning counts.
#pragma once

#include "worlds/poses/steering_curve.hpp"

namespace warren {

struct DifferentialCurve {
  static constexpr bool one_way = false;
  static constexpr bool turns_on_spot = true;
  /// From a to b; turning_radius > 0. Of the word's length a radian of turning on the spot is one.
  static SteeringWord shortest(const Se2& a, const Se2& b, double turning_radius) noexcept;
};

}  // namespace warren
