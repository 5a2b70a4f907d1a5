// SPDX-License-Identifier: BSD-3-Clause
#include "verify/exact/exact_segments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/rng.hpp"

namespace warren {
namespace {

using std::numbers::pi;

double to_segment(Vec2 p, const Segment& s) {
  const Vec2 along = s.b - s.a;
  const double square = dot(along, along);
  const double t = square > 0.0 ? std::clamp(dot(p - s.a, along) / square, 0.0, 1.0) : 0.0;
  return norm(p - (s.a + t * along));
}

TEST(ArcDistance, KnownDistancesComeOut) {
  const Arc quarter{{0, 0}, {1, 0}, pi / 2};
  struct Known {
    Segment s;
    double distance;
  };
  const Known all[] = {{{{2, -1}, {2, 3}}, 1.0},                        // beside its begin
                       {{{2, 2}, {2, 2}}, 2.0 * std::sqrt(2.0) - 1.0},  // a point
                       {{{3, 0}, {0, 3}}, 1.5 * std::sqrt(2.0) - 1.0},  // square to the diagonal
                       {{{0, 0}, {2, 2}}, 0.0},                         // across
                       {{{0, 0}, {-2, -2}}, 1.0},                       // behind its centre
                       {{{-3, -1}, {3, -1}}, 1.0},                      // below
                       {{{0.5, 0.5}, {0, 0}}, 1.0 - std::sqrt(0.5)}};   // inside
  for (const Known& known : all) {
    EXPECT_NEAR(distance(quarter, known.s), known.distance, 1e-14) << known.s.a.x << ' ' << known.s.a.y;
    // The same arc from its other end.
    EXPECT_NEAR(distance(Arc{{0, 0}, {0, 1}, -pi / 2}, known.s), known.distance, 1e-14);
  }
}

TEST(ArcDistance, EqualsTheLeastOverManyPoints) {
  constexpr int points = 20'000;
  int touching = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    const auto at = [&](std::uint64_t k) { return Vec2{4.0 * uniform(seed, k, 0), 4.0 * uniform(seed, k, 1)}; };
    const Arc arc{at(0), at(1), pi * (2.0 * uniform(seed, 9, 0) - 1.0)};
    Segment s{at(2), at(3)};
    if (seed % 10 == 0) s.b = s.a;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= points; ++i) least = std::min(least, to_segment(arc.at(arc.turn * i / points), s));
    const double step = norm(arc.from - arc.center) * std::abs(arc.turn) / points;
    const double found = distance(arc, s);
    EXPECT_LE(found, least + 1e-12);
    EXPECT_GE(found, least - step);
    touching += found == 0.0 ? 1 : 0;
  }
  EXPECT_GT(touching, 10);
}

}  // namespace
}  // namespace warren
