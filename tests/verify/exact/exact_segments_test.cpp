// SPDX-License-Identifier: BSD-3-Clause
#include "verify/exact/exact_segments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.hpp"

namespace warren {
namespace {

/// Ends of a wall 5 away, and a point off its line by one unit in the last place, in units of any size.
TEST(ExactSegments, DecideTheSameInUnitsOfAnySize) {
  for (int exponent = -330; exponent <= 195; ++exponent) {
    SCOPED_TRACE(exponent);
    const double unit = std::ldexp(1.0, exponent);
    const Segment wall{{-unit, 7.0 * unit}, {7.0 * unit, unit}};
    EXPECT_FALSE(exact::closer_than({{0.0, 0.0}, {0.0, 0.0}}, wall, 5.0 * unit));
    EXPECT_TRUE(exact::closer_than({{0.0, 0.0}, {0.0, 0.0}}, wall, std::nextafter(5.0 * unit, 1e61)));
    const Vec2 third{unit / 3.0, unit / 3.0};
    EXPECT_EQ(exact::side_of({-unit, -unit}, {unit, unit}, third), 0);
    EXPECT_EQ(exact::side_of({-unit, -unit}, {unit, unit}, {third.x, std::nextafter(third.y, 1e61)}), 1);
    EXPECT_EQ(exact::side_of({-unit, -unit}, {unit, unit}, {third.x, std::nextafter(third.y, 0.0)}), -1);
  }
}

/// A point a hair off a long segment that runs along no axis: the cross product is all cancellation.
TEST(ExactDistance, IsRightToAPartOfItselfHoweverLongTheSegments) {
  for (const double length : {1.0, 1e3, 1e6, 1e9, 1e12}) {
    SCOPED_TRACE(length);
    const Segment wall{{-length, -length}, {length, length}};  // on y = x
    for (const double off : {1.0, 1e-3, 0x1p-20}) {
      const Vec2 p{0.25, 0.25 + off};
      EXPECT_NEAR(exact::distance({p, p}, wall), off * std::sqrt(0.5), 1e-9 * off);
    }
  }
}

TEST(ExactDistance, IsNeverBelowThatOfTheBoxes) {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const auto tenth = [&](unsigned axis) { return 0.1 * std::floor(10.0 * uniform(3, i, axis)); };
    const Segment s{{tenth(0), tenth(1)}, {tenth(2), tenth(3)}};
    Segment t{{tenth(4), tenth(5)}, {tenth(6), tenth(7)}};
    if (i % 2 == 0) t.b.x = t.a.x;
    const double gap = std::sqrt(exact::gap_sq(box_of(s), box_of(t)));
    EXPECT_GE(exact::distance(s, t), gap);
    EXPECT_NEAR(exact::distance(s, t), exact::distance(t, s), 1e-14);
  }
}

}  // namespace
}  // namespace warren
