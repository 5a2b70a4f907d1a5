// SPDX-License-Identifier: BSD-3-Clause
// The shortest way of a car that may also back up: Reeds, Shepp, Pacific J. Math. 145 (1990). Its words, | a change of
// gear: CSC, C|C|C, C|CC, CC|C, CC|CC, C|CC|C, C|CSC, CSC|C, C|CSC|C, where a second arc beside S is a quarter turn: 48
// with left and right, forwards and backwards. All are tried, and the shortest whose end is the goal up to rounding is
// taken; the published tables that would spare some contain errors.
//
// The families are solved here for signed arcs (negative: backwards), so each closed form also gives ways with gear
// changes that the theorem doesn't need; they are ways all the same, and the shortest of more ways is no longer.
// Mirror (left is right), time reversal (forwards is backwards) and the way back from the goal give the rest from eight
// forms. The length is a metric, and continuous. bench/steering_bench.cpp: below 1 us a pair.
#pragma once

#include <functional>

#include "worlds/poses/steering_curve.hpp"

namespace warren {

struct ReedsSheppCurve {
  /// The way from b to a is the way from a to b, driven back. That has to be seen to: between near poses whose headings
  /// differ more, many words are as long as the turn. Of such the first that is tried is taken, anywhere.
  static constexpr bool one_way = false;
  static constexpr bool turns_on_spot = false;

  /// The shortest word from a to b; turning_radius > 0.
  static SteeringWord shortest(const Se2& a, const Se2& b, double turning_radius) noexcept;
  /// Every word towards b of at most this length, in turning radii, in no order; some of them twice. What is visited
  /// leads to b only if ends_at(word, seen_from(a, b, turning_radius), off_by_rounding(a, b, turning_radius)).
  static void for_each_word(const Se2& a, const Se2& b, double turning_radius, double longest,
                            const std::function<void(const SteeringWord&)>& visit);
};

}  // namespace warren
