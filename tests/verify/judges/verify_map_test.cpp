// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_point.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"

namespace warren {
namespace {

OccupancyMap room() {
  OccupancyMap map;
  map.blocked = Bitmap(6, 5);
  map.blocked.set(2, 2);
  map.blocked.set(3, 3);
  return map;
}

bool is_free(const OccupancyMap& map, const std::vector<Vec2>& path, double clearance = 0.0) {
  return verify_on_map(map, path, {.clearance = clearance}, {}).verified;
}

TEST(VerifyOnMap, ClosedSquaresMayNotBeTouched) {
  const OccupancyMap map = room();
  EXPECT_TRUE(is_free(map, {{0.5, 0.5}, {5.5, 0.5}, {5.5, 4.5}}));
  EXPECT_FALSE(is_free(map, {{0.5, 2.5}, {5.5, 2.5}}));               // through
  EXPECT_FALSE(is_free(map, {{0.5, 2.0}, {5.5, 2.0}}));               // along a side
  EXPECT_TRUE(is_free(map, {{0.5, 1.9999999}, {5.5, 1.9999999}}));    // beside it
  EXPECT_FALSE(is_free(map, {{1.0, 3.0}, {3.0, 1.0}}));               // over a corner, diagonally
  EXPECT_FALSE(is_free(map, {{2.5, 3.5}, {3.5, 2.5}}));               // between two that touch at a corner
  EXPECT_FALSE(is_free(map, {{0.5, 0.5}, {0.0, 0.5}}));               // the map's edge
  EXPECT_FALSE(is_free(map, {{0.5, 0.5}, {-3.0, 0.5}, {0.5, 1.5}}));  // and beyond
  EXPECT_FALSE(is_free(map, {{2.5, 2.5}}));
  EXPECT_TRUE(is_free(map, {{1.5, 2.5}}));
}

TEST(VerifyOnMap, ReportsLengthClearanceAndTheFirstViolation) {
  OccupancyMap map = room();
  map.cell = 2.0;
  map.origin = {100, 0};
  const Verification free = verify_on_map(map, std::vector<Vec2>{{101, 1}, {101, 5}, {103, 5}}, {}, {});
  EXPECT_TRUE(free.verified);
  EXPECT_DOUBLE_EQ(free.length, 6.0);
  EXPECT_DOUBLE_EQ(free.min_clearance, 1.0);
  const Verification bad = verify_on_map(map, std::vector<Vec2>{{101, 1}, {101, 5}, {109, 5}, {101, 5}}, {}, {});
  EXPECT_FALSE(bad.verified);
  EXPECT_EQ(bad.first_violation->leg, 1U);
  EXPECT_EQ(bad.first_violation->obstacle, "cell 2, 2");
  const Verification wrong = verify_on_map(map, std::vector<Vec2>{{101, 1}, {101, 5}}, {.start = Vec2{101, 2}}, {});
  EXPECT_FALSE(wrong.verified);
  EXPECT_THROW(verify_on_map(map, {}, {}, {}), InputError);
  EXPECT_THROW(verify_on_map(map, std::vector<Vec2>{{NAN, 0}}, {}, {}), InputError);
}

/// Distance of a segment's points, densely taken, from every closed square and from the outside.
double sampled_clearance(const OccupancyMap& map, Vec2 a, Vec2 b) {
  double least = std::numeric_limits<double>::infinity();
  constexpr int steps = 400;
  for (int i = 0; i <= steps; ++i) {
    const Vec2 p = a + (static_cast<double>(i) / steps) * (b - a);
    least = std::min({least, p.x, p.y, map.width() - p.x, map.height() - p.y});
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      for (std::uint32_t x = 0; x < map.width(); ++x) {
        if (!map.blocked.test(x, y)) continue;
        const double dx = std::max({x - p.x, 0.0, p.x - x - 1.0});
        const double dy = std::max({y - p.y, 0.0, p.y - y - 1.0});
        least = std::min(least, std::hypot(dx, dy));
      }
    }
  }
  return std::max(least, 0.0);
}

TEST(VerifyOnMap, LeastDistanceEqualsDenseSampling) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    OccupancyMap map;
    map.blocked = Bitmap(40, 25);
    for (int i = 0; i < 12; ++i) {
      map.blocked.set(static_cast<std::uint32_t>(random_bits(seed, 0, 2 * i) % 40),
                      static_cast<std::uint32_t>(random_bits(seed, 0, 2 * i + 1) % 25));
    }
    const Vec2 a{40 * uniform(seed, 1, 0), 25 * uniform(seed, 1, 1)};
    const Vec2 b{40 * uniform(seed, 1, 2), 25 * uniform(seed, 1, 3)};
    const double expected = sampled_clearance(map, a, b);
    const Verification judged = verify_on_map(map, std::vector<Vec2>{a, b}, {}, {});
    EXPECT_LE(judged.min_clearance, expected + 1e-12);
    EXPECT_GE(judged.min_clearance, expected - 0.06);  // the samples' distance
    if (expected > 0.1) {
      EXPECT_TRUE(is_free(map, {a, b}, judged.min_clearance * (1 - 1e-12)));
      EXPECT_FALSE(is_free(map, {a, b}, judged.min_clearance * (1 + 1e-6)));
    }
  }
}

TEST(VerifyOnMap, WaterIsFreeToPathsThatBeginOnIt) {
  OccupancyMap map;
  map.blocked = Bitmap(6, 3);
  map.water = Bitmap(6, 3);
  for (std::uint32_t x = 3; x < 6; ++x) {
    for (std::uint32_t y = 0; y < 3; ++y) {
      map.blocked.set(x, y);
      map.water.set(x, y);
    }
  }
  EXPECT_TRUE(is_free(map, {{0.5, 0.5}, {2.5, 2.5}}));
  EXPECT_TRUE(is_free(map, {{3.5, 0.5}, {5.5, 2.5}}));
  EXPECT_FALSE(is_free(map, {{0.5, 0.5}, {5.5, 0.5}}));
  EXPECT_FALSE(is_free(map, {{5.5, 0.5}, {0.5, 0.5}}));
}

}  // namespace
}  // namespace warren
