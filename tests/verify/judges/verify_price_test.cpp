// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_price.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/base/rng.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/prices/priced_maps.hpp"
#include "verify/judges/verify_point.hpp"
#include "worlds/prices/map_prices.hpp"

namespace warren {
namespace {

using priced_maps::brute_parts;
using priced_maps::random_leg;
using priced_maps::random_map;
using priced_maps::random_prices;
using test::seeds;

TEST(VerifyPrice, PathsOnMapsCostWhatBruteForceSays) {
  int asked = 0;
  for (const std::uint64_t seed : seeds(1000, 2)) {
    SCOPED_TRACE(seed);
    Scene scene;
    scene.map = random_map(seed);
    const double radius = seed % 3 == 0 ? 0.7 * scene.map->cell : 0.0;
    const Prices prices = random_prices(*scene.map, seed);
    const Scene effective = effective_scene(scene, prices, {}).value_or(scene);
    for (std::uint64_t i = 0; i < 25; ++i) {
      const auto [a, b] = random_leg(*scene.map, seed, i);
      const std::array legs{a, b};
      if (!verify_on_map(*effective.map, legs, {.radius = radius}, {}).verified) continue;
      ++asked;
      const PriceParts found = verify_price(effective, legs, prices, radius, {});
      const PriceParts brute = brute_parts(*effective.map, a, b, prices, radius);
      EXPECT_NEAR(found.clearance, brute.clearance, 1e-9 * (1.0 + brute.clearance)) << i;
      EXPECT_NEAR(found.areas, brute.areas, 1e-9 * (1.0 + brute.areas)) << i;
      // A leg so short that its ends are one place of the map.
      const std::array twice{a, Vec2{std::nextafter(a.x, b.x), a.y}, b};
      EXPECT_NEAR(verify_price(effective, twice, prices, radius, {}).sum(), found.sum(), 1e-9 * (1.0 + found.sum()))
          << i;
    }
  }
  EXPECT_GT(asked, 4);
}

TEST(VerifyPrice, TheJudgeClosesTheCellsThatPlannersDo) {
  for (const std::uint64_t seed : seeds(2000, 60)) {
    SCOPED_TRACE(seed);
    Scene scene;
    scene.map = random_map(seed);
    Prices prices = random_prices(*scene.map, seed);
    const auto corner = [&](std::uint64_t i) {  // every other one where lines between cells cross
      const Vec2 p{30.0 * uniform(seed, 60, 2 * i), 20.0 * uniform(seed, 60, 2 * i + 1)};
      return world_point(*scene.map, i % 2 == 0 ? Vec2{std::round(p.x), std::round(p.y)} : p);
    };
    prices.keep_out.push_back({{corner(0), corner(1), corner(2)}, 0});
    prices.keep_out.push_back({{corner(4), corner(6), corner(8)}, 0});
    MaskCells cells{6, 5, {}, 1.3 * scene.map->cell, corner(10), scene.map->yaw_rad + (seed % 2 == 0 ? 0.7 : 0.0)};
    for (std::uint64_t i = 0; i < 30; ++i) {
      cells.values.push_back(static_cast<std::int8_t>(random_bits(seed, 70, i) % 3 == 0 ? 100 : 40));
    }
    prices.masks.push_back({MaskKind::keep_out, "mask.yaml", {}, 100.0, -1.0, cells});
    const std::optional<Scene> judged = effective_scene(scene, prices, {});
    ASSERT_TRUE(judged);
    EXPECT_EQ(judged->map->blocked, effective_map(*scene.map, prices, {}).blocked);
  }
}

}  // namespace
}  // namespace warren
