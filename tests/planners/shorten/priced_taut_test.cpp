// SPDX-License-Identifier: BSD-3-Clause
#include "planners/shorten/taut_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

/// Round obstacles; a metre at the rim of one costs 4, from 1.5 off it 1.
struct Discs {
  std::vector<Vec2> middles;
  double radius = 1.0;

  double room(Vec2 p) const {
    double least = 1e9;
    for (const Vec2 m : middles) least = std::min(least, distance(p, m) - radius);
    return least;
  }
  double cost(Vec2 a, Vec2 b) const {
    constexpr int parts = 64;
    double sum = 0.0;
    for (int i = 0; i < parts; ++i) {
      const double u = std::clamp(1.0 - room(a + (i + 0.5) / parts * (b - a)) / 1.5, 0.0, 1.0);
      sum += 1.0 + 3.0 * u * u;
    }
    return distance(a, b) * sum / parts;
  }
  bool is_free(Vec2 a, Vec2 b) const {
    for (const Vec2 m : middles) {
      if (distance(m, Segment{a, b}) < radius) return false;
    }
    return true;
  }
  PricedLegs legs() const {
    return {[this](Vec2 a, Vec2 b) { return cost(a, b); }, [this](Vec2 a, Vec2 b) { return is_free(a, b); }, 0.5};
  }
  double whole(const Path<Vec2>& path) const {
    double sum = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) sum += cost(path[i - 1], path[i]);
    return sum;
  }
};

TEST(PricedTaut, IsStraightWhereNothingCostsMore) {
  const Discs nothing;
  const Path<Vec2> pulled = priced_taut({{0, 0}, {1, 3}, {2, -1}, {5, 5}, {9, 0}}, nothing.legs(), {});
  EXPECT_EQ(pulled, (Path<Vec2>{{0, 0}, {9, 0}}));
}

TEST(PricedTaut, GoesInTheMiddleBetweenTwoThatAreDear) {
  const Discs gate{{{0, 2}, {0, -2}}};
  const Path<Vec2> pulled = priced_taut({{-6, 0}, {-1, 0.8}, {1, 0.8}, {6, 0}}, gate.legs(), {});
  EXPECT_LT(gate.whole(pulled), gate.whole({{-6, 0}, {6, 0}}) * 1.0005);
}

TEST(PricedTaut, NeverCostsMoreKeepsItsEndsAndOnlyTakesFreeLegs) {
  double before = 0.0;
  double after = 0.0;
  for (const std::uint64_t seed : test::seeds(60, 3)) {
    SCOPED_TRACE(seed);
    Discs discs;
    for (std::uint64_t i = 0; i < 12; ++i)
      discs.middles.push_back({20.0 * uniform(seed, i, 0), 20.0 * uniform(seed, i, 1)});
    Path<Vec2> path;
    for (std::uint64_t i = 0; i < 4000 && path.size() < 12; ++i) {
      const Vec2 next{20.0 * uniform(seed, i, 2), 20.0 * uniform(seed, i, 3)};
      if (discs.is_free(path.empty() ? next : path.back(), next)) path.push_back(next);
    }
    const Path<Vec2> pulled = priced_taut(path, discs.legs(), {});
    EXPECT_LE(discs.whole(pulled), discs.whole(path));
    EXPECT_EQ(pulled.front(), path.front());
    EXPECT_EQ(pulled.back(), path.back());
    for (std::size_t i = 1; i < pulled.size(); ++i) EXPECT_TRUE(discs.is_free(pulled[i - 1], pulled[i])) << i;
    EXPECT_EQ(pulled, priced_taut(path, discs.legs(), {}));
    before += discs.whole(path);
    after += discs.whole(pulled);
  }
  EXPECT_LT(after, 0.8 * before);
}

}  // namespace
}  // namespace warren
