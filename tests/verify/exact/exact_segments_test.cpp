// SPDX-License-Identifier: BSD-3-Clause
#include "verify/exact/exact_segments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.hpp"

namespace warren {
namespace {

TEST(Dyadic, RoundsToTheDoublesThatItIsMadeOf) {
  for (const double x : {0.0, 1.0, -1.0, 0.1, -1e-100, 3e200, 0x1.fffffffffffffp+60, 5e-324})
    EXPECT_EQ(Dyadic(x).rounded(), x);
}

TEST(Dyadic, RoundsSumsAndProductsAsDoublesDo) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double a = (uniform(1, i, 0) - 0.5) * std::ldexp(1.0, static_cast<int>(i % 120) - 60);
    const double b = uniform(1, i, 1) - 0.5;
    EXPECT_DOUBLE_EQ((Dyadic(a) * Dyadic(b)).rounded(), a * b);
    EXPECT_DOUBLE_EQ((Dyadic(a) + Dyadic(b)).rounded(), a + b);
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
