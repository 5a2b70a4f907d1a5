// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/heading_layers.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/plane/se2.hpp"
#include "scenes/scene/scene.hpp"
#include "tests/seeds.hpp"
#include "verify/judges/verify_turning.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

OccupancyMap map_of_rooms(std::uint64_t seed) {
  OccupancyMap map;
  map.blocked = Bitmap(seed % 3 == 0 ? 70 : 17, 13);  // over a word's border, too
  for (std::uint32_t y = 0; y < map.height(); ++y) {
    for (std::uint32_t x = 0; x < map.width(); ++x) {
      if (uniform(seed, std::uint64_t{y} * map.width() + x, 0) < 0.04) map.blocked.set(x, y);
    }
  }
  map.free = map.blocked.size() - map.blocked.count();
  map.occupied = map.blocked.count();
  map.cell = seed % 2 == 0 ? 1.0 : 0.05;
  if (seed % 4 == 1) {
    map.origin = {-12.3, 4.7};
    map.yaw_rad = 0.35;
  }
  return map;
}

/// In cells: convex, without its reference point, and not convex.
std::vector<Vec2> body_of(std::uint64_t seed, double cell) {
  std::vector<Vec2> body;
  if (seed % 3 == 0) body = {{-1.31, -0.43}, {1.17, -0.52}, {0.93, 0.61}, {-1.23, 0.57}};
  if (seed % 3 == 1) body = {{0.41, 0.33}, {2.13, 0.22}, {1.05, 1.17}};
  if (seed % 3 == 2) body = {{-1.07, -1.03}, {1.11, -0.97}, {0.23, -0.61}, {-0.94, 1.09}};
  for (Vec2& p : body) p = cell * p;
  return body;
}

/// Asks the verification of walls, which knows nothing of layers.
class Oracle {
 public:
  Oracle(const OccupancyMap& map, std::vector<Vec2> body, double clearance) : body_(std::move(body)) {
    options_.clearance = clearance;
    scene_.map = map;
    add_map_walls(scene_, {});
  }
  Se2 pose(const HeadingLayers& layers, std::int64_t i, std::int64_t j, std::uint32_t k) const {
    const OccupancyMap& map = *scene_.map;
    const Vec2 p = world_point(map, {static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5});
    return {p.x, p.y, 2.0 * std::numbers::pi * k / layers.angles + map.yaw_rad};
  }
  bool is_free(const Se2& from, const Se2& to) const {
    const Se2 path[] = {from, to};
    return verify_se2(scene_, body_, path, options_, {}).verified;
  }

 private:
  Scene scene_;
  std::vector<Vec2> body_;
  PoseVerifyOptions options_;
};

TEST(MapLayers, EqualTheVerificationOfEveryStandStepAndTurn) {
  for (const std::uint64_t seed : test::seeds(24, 6, 0)) {
    SCOPED_TRACE(seed);
    const OccupancyMap map = map_of_rooms(seed);
    const std::vector<Vec2> body = body_of(seed, map.cell);
    const double clearance = seed % 5 == 0 ? 0.217 * map.cell : 0.0;
    const HeadingLayers layers = map_layers(map, body, seed % 2 == 0 ? 12 : 7, clearance, {});
    const Oracle oracle(map, body, clearance);
    const auto bit = [&](std::uint32_t bitmap, std::uint32_t i, std::uint32_t j) {
      return !layers.bitmaps[bitmap].test(i, j);
    };
    int safe_turns = 0;
    int free_turns = 0;
    for (std::uint64_t n = 0; n < 60; ++n) {
      const auto i = static_cast<std::uint32_t>(uniform(seed, n, 1) * layers.width);
      const auto j = static_cast<std::uint32_t>(uniform(seed, n, 2) * layers.height);
      const auto k = static_cast<std::uint32_t>(uniform(seed, n, 3) * layers.angles);
      const Se2 from = oracle.pose(layers, i, j, k);
      EXPECT_EQ(layers.is_free(i, j, k), oracle.is_free(from, from)) << i << ' ' << j << ' ' << k;
      for (std::size_t s = 0; s < HeadingLayers::steps.size(); ++s) {
        const auto [dx, dy] = HeadingLayers::steps[s];
        const Se2 to = oracle.pose(layers, std::int64_t{i} + dx, std::int64_t{j} + dy, k);
        EXPECT_EQ(bit(layers.moving[k][s], i, j), oracle.is_free(from, to)) << i << ' ' << j << ' ' << k << ' ' << s;
      }
      Se2 turned = from;
      turned.theta += 2.0 * std::numbers::pi / layers.angles;
      const bool is_safe = bit(layers.turning[k], i, j);
      const bool is_free = oracle.is_free(from, turned);
      EXPECT_TRUE(!is_safe || is_free) << i << ' ' << j << ' ' << k;
      safe_turns += is_safe ? 1 : 0;
      free_turns += is_free ? 1 : 0;
    }
    EXPECT_LE(free_turns - safe_turns, 4);  // arcs are replaced by hulls
  }
}

TEST(MapLayers, ASquareSharesItsLayersAndFitsWhereItDoesNotTouch) {
  OccupancyMap map;
  map.blocked = Bitmap(9, 9);
  const std::vector<Vec2> square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const HeadingLayers layers = map_layers(map, square, 8, 0.0, {});
  EXPECT_EQ(layers.bitmaps.size(), 2U * 6U);
  EXPECT_EQ(layers.free_at(0), 49U);  // at the middles of all cells but the outermost
  const std::vector<Vec2> exact{{-1.5, -1.5}, {1.5, -1.5}, {1.5, 1.5}, {-1.5, 1.5}};
  EXPECT_EQ(map_layers(map, exact, 8, 0.0, {}).free_at(0), 25U);  // touching the border is blocked
}

TEST(MapLayers, RefuseBodiesAndGridsThatCantBe) {
  OccupancyMap map;
  map.blocked = Bitmap(9, 9);
  const std::vector<Vec2> body{{-1, -1}, {1, -1}, {0, 1}};
  EXPECT_THROW(map_layers(map, std::span(body).first(2), 8, 0.0, {}), InputError);
  EXPECT_THROW(map_layers(map, body, 0, 0.0, {}), InputError);
  EXPECT_THROW(map_layers(map, body, 8, -1.0, {}), InputError);
  EXPECT_THROW(map_layers(map, body, 8, 1e5, {}), InputError);
  EXPECT_THROW(map_layers(map, body, 60'000'000, 0.0, {}), InputError);
}

}  // namespace
}  // namespace warren
