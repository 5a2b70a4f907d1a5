// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/grid_world.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
namespace {

OccupancyMap sparse_map(std::uint64_t seed) {
  OccupancyMap map;
  map.blocked = Bitmap(90, 50);
  for (int i = 0; i < 60; ++i) {
    map.blocked.set(static_cast<std::uint32_t>(random_bits(seed, 0, 2 * i) % 90),
                    static_cast<std::uint32_t>(random_bits(seed, 0, 2 * i + 1) % 50));
  }
  if (seed % 2 == 1) {
    map.cell = 0.05;
    map.origin = {-3, 7};
    map.yaw_rad = 0.3;
  }
  return map;
}

TEST(GridWorld, AgreesWithTheVerificationOnRandomMotions) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = sparse_map(seed);
    const double radius = map.cell * std::array{0.0, 0.3, 0.5, 1.7}[seed / 2 % 4];
    const GridWorld world(map, radius, {});
    const GridWorld without_distances(map, radius, {}, MapMilestones::none);
    auto query = world.make_query();
    int free = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const Vec2 a = world.at_unit({uniform(seed, i, 0), uniform(seed, i, 1)});
      const double share = i % 3 == 0 ? 1.0 : 0.1;  // some across the map, most short
      const Vec2 b = a + share * (world.at_unit({uniform(seed, i, 2), uniform(seed, i, 3)}) - a);
      const bool is_free = world.is_free_motion(a, b, query);
      const double clearance = verify_on_map(map, std::array{a, b}, {}, {}).min_clearance;
      const double slack = 1e-8 * map.cell;
      if (is_free) {
        ASSERT_GE(clearance, radius) << i;
        ASSERT_GT(clearance, 0.0) << i;
        ++free;
      } else {
        ASSERT_LT(clearance, radius + slack) << i;
      }
      ASSERT_EQ(without_distances.is_free_motion(a, b, query), is_free) << i;
      ASSERT_EQ(world.is_free(a, query), world.is_free_motion(a, a, query));
    }
    EXPECT_GT(free, 10);
  }
}

TEST(GridWorld, OutsideIsBlockedAndBadRadiiAreRefused) {
  OccupancyMap map;
  map.blocked = Bitmap(4, 4);
  const GridWorld world(map, 0.5, {});
  auto query = world.make_query();
  EXPECT_TRUE(world.is_free_motion({0.6, 0.6}, {3.4, 3.4}, query));
  EXPECT_FALSE(world.is_free_motion({0.6, 0.6}, {3.6, 3.4}, query));
  EXPECT_FALSE(world.is_free({-1, 2}, query));
  EXPECT_FALSE(world.is_free({2, NAN}, query));
  EXPECT_THROW(GridWorld(map, -1.0, {}), InputError);
  EXPECT_THROW(GridWorld(map, NAN, {}), InputError);
}

TEST(GridWorld, CorridorStatesAreMostlyFreeAndAPureFunctionOfSeedAndIndex) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = sparse_map(seed);
    const double radius = map.cell * std::array{0.0, 0.3, 0.5, 1.7}[seed / 2 % 4];
    const GridWorld world(map, radius, {.threads = 1}, MapMilestones::corridors);
    const GridWorld again(map, radius, {.threads = 3}, MapMilestones::corridors);
    auto query = world.make_query();
    int free = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Vec2 p = world.corridor_state(seed, i);
      EXPECT_EQ(p, again.corridor_state(seed, i));
      free += world.is_free(p, query) ? 1 : 0;
      EXPECT_FALSE(p == world.corridor_state(seed + 1, i));
    }
    EXPECT_GT(free, 180);
  }
  const GridWorld plain(sparse_map(0), 0.0, {});
  EXPECT_EQ(plain.corridor_state(3, 4), uniform_state(plain, 3, 4));  // none were asked for
}

}  // namespace
}  // namespace warren
