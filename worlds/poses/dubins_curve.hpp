// SPDX-License-Identifier: BSD-3-Clause
// The shortest way of a car that only drives forwards: Dubins, Amer. J. Math. 79 (1957). It is one of six words, C an
// arc of the turning radius (left or right), S straight: LSL RSR LSR RSL LRL RLR. All six are tried, since the
// published classifications that would spare some of them contain errors; the shortest whose end is the goal up to
// rounding is taken. Closed forms; right turns are left turns in the mirror. bench/steering_bench.cpp: some 200 ns a
// pair.
//
// The length jumps where an arc shrinks to nothing and starts again as a full circle. There rounding must not decide:
// an arc that is a full circle but for some 1e-6 is tried as none first, and is taken as none where that ends at the
// goal. So a rest of a shortest curve is as long as it was on the whole, and planners may cut curves anywhere.
#pragma once

#include "worlds/poses/steering_curve.hpp"

namespace warren {

struct DubinsCurve {
  /// A way from a to b is none from b to a.
  static constexpr bool one_way = true;
  static constexpr bool turns_on_spot = false;

  /// The shortest word from a to b; turning_radius > 0.
  static SteeringWord shortest(const Se2& a, const Se2& b, double turning_radius) noexcept;
};

}  // namespace warren
