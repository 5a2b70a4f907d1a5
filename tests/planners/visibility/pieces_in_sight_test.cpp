// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/plane_pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/rng.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

/// The piece that a ray from the eye meets first; the number of pieces where it meets none.
std::uint32_t first_met(const PlanePieces& pieces, Vec2 eye, Vec2 direction) {
  double nearest = 1e300;
  auto met = static_cast<std::uint32_t>(pieces.pieces().size());
  for (std::uint32_t i = 0; i < pieces.pieces().size(); ++i) {
    const auto [a, b] = pieces.segment(i);
    const double across = cross(direction, b - a);
    const double at = cross(a - eye, b - a) / across;         // along the ray
    const double share = cross(a - eye, direction) / across;  // of the piece
    if (!(at > 0.0 && share > 0.0 && share < 1.0 && at < nearest)) continue;
    nearest = at;
    met = i;
  }
  return met;
}

TEST(NearPieces, HoldEveryPieceThatARayMeetsFirst) {
  for (const std::uint64_t seed : test::seeds(20, 5)) {
    SCOPED_TRACE(seed);
    PlaneObstacles obstacles;
    for (std::uint64_t i = 0; i < 60; ++i) {
      const auto u = [&](std::uint64_t axis) { return uniform(seed, i, axis); };
      const double length = i % 3 == 0 ? 6.0 : 1.0;
      const Vec2 a{10.0 * u(0), 10.0 * u(1)};
      obstacles.walls.push_back({a, a + Vec2{length * (u(2) - 0.5), length * (u(3) - 0.5)}});
    }
    const PlanePieces pieces(obstacles, {});
    const Execution execution;
    NearPieces near(pieces, execution);
    for (std::uint64_t i = 100; i < 120; ++i) {
      const Vec2 eye{10.0 * uniform(seed, i, 0), 10.0 * uniform(seed, i, 1)};
      const auto found = near.look(eye, std::vector<PlaceRange>{all_round});
      const std::vector<std::uint32_t> seen(found.begin(), found.end());
      for (int ray = 0; ray < 500; ++ray) {
        const double angle = 2.0 * std::numbers::pi * (ray + 0.5) / 500.0;
        const std::uint32_t met = first_met(pieces, eye, {std::cos(angle), std::sin(angle)});
        if (met == pieces.pieces().size()) continue;
        ASSERT_TRUE(std::find(seen.begin(), seen.end(), met) != seen.end()) << met << " from " << eye.x << " " << eye.y;
      }
    }
  }
}

}  // namespace
}  // namespace warren
