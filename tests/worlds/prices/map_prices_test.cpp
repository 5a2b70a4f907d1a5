// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/prices/map_prices.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "spatial/maps/free_cells.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/prices/priced_maps.hpp"
#include "worlds/plane/grid_world.hpp"

namespace warren {
namespace {

using priced_maps::brute_parts;
using priced_maps::random_leg;
using priced_maps::random_map;
using priced_maps::random_prices;
using test::seeds;

TEST(MapPrices, LegsCostWhatBruteForceSays) {
  int asked = 0;
  MapPrices::Scratch scratch;  // for all: each lies where the one before lay
  for (const std::uint64_t seed : seeds(1000, 2)) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = random_map(seed);
    const double radius = seed % 3 == 0 ? 0.7 * map.cell : 0.0;
    const Prices prices = random_prices(map, seed);
    const OccupancyMap effective = effective_map(map, prices, {});
    const MapPrices priced(effective, radius, prices, {});
    const GridWorld world(effective, radius, {});
    auto query = world.make_query();
    for (std::uint64_t i = 0; i < 25; ++i) {
      const auto [a, b] = random_leg(map, seed, i);
      if (!world.is_free_motion(a, b, query)) continue;
      ++asked;
      const PriceParts found = priced.parts(a, b, scratch);
      const PriceParts brute = brute_parts(effective, a, b, prices, radius);
      EXPECT_NEAR(found.clearance, brute.clearance, 1e-9 * (1.0 + brute.clearance)) << i;
      EXPECT_NEAR(found.areas, brute.areas, 1e-9 * (1.0 + brute.areas)) << i;
      const PriceParts back = priced.parts(b, a, scratch);
      EXPECT_NEAR(found.sum(), back.sum(), 1e-10 * (1.0 + found.sum()));
      EXPECT_EQ(priced.cost(a, b, scratch), distance(a, b) + found.sum());
    }
  }
  EXPECT_GT(asked, 4);
}

/// Legs across a hall, whose open middle is crossed in strides; blocks in it come and go.
TEST(MapPrices, KeptNearAndRenewedLegsCostTheSameToTheLastBit) {
  OccupancyMap map;
  map.blocked = Bitmap(300, 260);
  map.cell = 0.7;
  map.origin = {-11.3, 4.1};
  const Prices prices{.clearance = ClearancePrice{3.0, 7.4}};
  const double radius = 0.3;
  MapPrices kept(map, radius, prices, {});
  kept.keep_near(radius / map.cell, {});
  MapPrices::Scratch scratch;
  SequentialRng rng(7);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(rng.below(n)); };
  for (int change = 0; change < 6; ++change) {
    const MapPrices fresh(map, radius, prices, {});
    MapPrices::Scratch other;
    for (int i = 0; i < 200; ++i) {
      const auto place = [&] {
        return world_point(map, {1.0 + 298.0 * 0x1p-20 * below(1U << 20U), 1.0 + 258.0 * 0x1p-20 * below(1U << 20U)});
      };
      const Vec2 a = place();
      const Vec2 b = place();
      ASSERT_EQ(kept.parts(a, b, scratch).clearance, fresh.parts(a, b, other).clearance) << change << " " << i;
    }
    const Cell low{20 + below(250), 20 + below(210)};
    const Cell high{low.x + below(9), low.y + below(9)};
    for (std::uint32_t y = low.y; y <= high.y; ++y) map.blocked.set_run(y, low.x, high.x + 1);
    kept.renew(low, high, {});
  }
}

TEST(MapPrices, CostsAddUpOverPieces) {
  MapPrices::Scratch scratch;  // for all: each lies where the one before lay
  for (const std::uint64_t seed : seeds(60, 8)) {
    const OccupancyMap map = random_map(seed);
    const Prices prices = random_prices(map, seed);
    const OccupancyMap effective = effective_map(map, prices, {});
    const MapPrices priced(effective, 0.0, prices, {});
    const GridWorld world(effective, 0.0, {});
    auto query = world.make_query();
    for (std::uint64_t i = 0; i < 40; ++i) {
      const Vec2 a = world.at_unit({uniform(seed, i, 0), uniform(seed, i, 1)});
      const Vec2 b = a + 0.2 * (world.at_unit({uniform(seed, i, 2), uniform(seed, i, 3)}) - a);
      if (!world.is_free_motion(a, b, query)) continue;
      const Vec2 middle = a + uniform(seed, i, 4) * (b - a);
      const double whole = priced.cost(a, b, scratch);
      EXPECT_NEAR(whole, priced.cost(a, middle, scratch) + priced.cost(middle, b, scratch), 1e-9 * (1.0 + whole));
    }
  }
}

TEST(MapPrices, StepsAreLegsRoundedUp) {
  constexpr double units = 1 << 20;
  MapPrices::Scratch scratch;  // for all: each lies where the one before lay
  for (const std::uint64_t seed : seeds(20, 4)) {
    const OccupancyMap map = random_map(seed);
    const Prices prices = random_prices(map, seed);
    const OccupancyMap effective = effective_map(map, prices, {});
    const MapPrices priced(effective, 0.0, prices, {});
    for (std::uint32_t y = 1; y + 1 < map.height(); ++y) {
      for (std::uint32_t x = 1; x + 1 < map.width(); ++x) {
        for (unsigned step = 0; step < 8; ++step) {
          const Cell to{x + static_cast<std::uint32_t>(cell_steps[step][0]),
                        y + static_cast<std::uint32_t>(cell_steps[step][1])};
          if (effective.blocked.test(x, y) || effective.blocked.test(to.x, to.y)) continue;
          const double cost = priced.cost(cell_centre(map, {x, y}), cell_centre(map, to), scratch);
          const double exact = cost / map.cell * units;
          const std::uint64_t up = priced.step_up({x, y}, step, scratch);
          EXPECT_NEAR(static_cast<double>(up), exact + 0.5, 0.5 + 1e-5 * exact) << x << ' ' << y << ' ' << step;
          EXPECT_EQ(up, priced.step_up(to, 7 - step, scratch));
        }
      }
    }
  }
}

TEST(MapPrices, BordersOfAreasCostTheLesser) {
  OccupancyMap map;
  map.blocked = Bitmap(20, 20);
  Prices prices;
  prices.areas.push_back({5.0, {{4, 4}, {10, 4}, {10, 10}, {4, 10}}, 0});
  prices.areas.push_back({3.0, {{2, 2}, {12, 2}, {12, 12}, {2, 12}}, 0});
  const MapPrices priced(map, 0.0, prices, {});
  MapPrices::Scratch scratch;
  EXPECT_DOUBLE_EQ(priced.parts({2, 2}, {2, 12}, scratch).areas, 0.0);
  EXPECT_DOUBLE_EQ(priced.parts({4, 4}, {4, 10}, scratch).areas, 6.0 * 2.0);  // in the larger one alone
  EXPECT_DOUBLE_EQ(priced.parts({1, 7}, {13, 7}, scratch).areas, 6.0 * 4.0 + 4.0 * 2.0);
  prices.areas = {{1.0, {{4, 4}, {10, 4}, {10, 10}, {4, 10}}, 0}};
  EXPECT_FALSE(MapPrices(map, 0.0, prices, {}).is_priced());
}

TEST(MapPrices, APointSaysHowFarItsPriceReaches) {
  OccupancyMap map;
  map.blocked = Bitmap(20, 20);
  Prices prices;
  prices.clearance = ClearancePrice{2.0, {}};
  EXPECT_THROW(MapPrices(map, 0.0, prices, {}), UsageError);
  EXPECT_DOUBLE_EQ(clearance_reach(*prices.clearance, 0.25), 0.5);
}

}  // namespace
}  // namespace warren
