// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/prices/map_prices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/rng.hpp"
#include "scenes/scene/scene.hpp"
#include "tests/seeds.hpp"
#include "tests/worlds/prices/priced_maps.hpp"
#include "verify/judges/verify_price.hpp"
#include "worlds/plane/polygon_world.hpp"

namespace warren {
namespace {

using priced_maps::integral;
using test::seeds;

/// Triangles and walls in a box, turned about the origin, moved and scaled.
struct Turned {
  double angle = 0.0;
  double scale = 1.0;
  Vec2 by = {};
  Vec2 operator()(Vec2 p) const {
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    return by + scale * Vec2{c * p.x - s * p.y, s * p.x + c * p.y};
  }
};

struct World {
  Scene scene;
  Prices prices;
};

World random_world(std::uint64_t seed, const Turned& turned) {
  World world;
  const auto place = [&](std::uint64_t stream, std::uint64_t i) {
    return Vec2{20.0 * uniform(seed, stream, 2 * i), 20.0 * uniform(seed, stream, 2 * i + 1)};
  };
  std::vector<Segment> walls;
  for (std::uint64_t i = 0; i < 6; ++i) {
    const Vec2 p = place(1, i);
    walls.push_back({turned(p), turned(p + 0.1 * (place(2, i) - Vec2{10, 10}))});
    const Vec2 q = place(3, i);
    world.scene.polygons.push_back({{turned(q), turned(q + Vec2{1.5, 0.3}), turned(q + Vec2{0.4, 1.2})}, 0});
  }
  const std::array<Vec2, 4> box{turned({-1, -1}), turned({21, -1}), turned({21, 21}), turned({-1, 21})};
  for (std::size_t i = 0; i < 4; ++i) walls.push_back({box[i], box[(i + 1) % 4]});
  world.scene.walls = WallSet::narrowest(walls);
  world.prices.clearance = ClearancePrice{3.0 * uniform(seed, 4, 0), turned.scale * (0.2 + 2.0 * uniform(seed, 4, 1))};
  const Vec2 at = place(5, 0);
  for (const double factor : {2.0, 4.0}) {
    const double size = 8.0 / factor;
    world.prices.areas.push_back({factor,
                                  {turned(at - Vec2{size, size}), turned(at + Vec2{size, -size}),
                                   turned(at + Vec2{size, size}), turned(at + Vec2{-size, size})},
                                  0});
  }
  return world;
}

std::vector<Segment> sides_of(const Scene& scene) {
  std::vector<Segment> sides;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) sides.push_back(scene.walls.segment(i));
  for (const ScenePolygon& polygon : scene.polygons) {
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      sides.push_back({polygon.corners[i], polygon.corners[(i + 1) % polygon.corners.size()]});
    }
  }
  return sides;
}

double brute_distance(const std::vector<Segment>& sides, Vec2 p) {
  double least_sq = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : sides) {
    const Vec2 along = b - a;
    const Vec2 off = p - a - std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0) * along;
    least_sq = std::min(least_sq, dot(off, off));
  }
  return std::sqrt(least_sq);
}

/// Legs of the world that is not turned, free in it.
template <class Each>
void for_legs(std::uint64_t seed, const World& world, double radius, const Each& each) {
  const PolygonWorld free(world.scene, radius, {});
  auto query = free.make_query();
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto place = [&](std::uint64_t k) {
      return Vec2{20.0 * uniform(seed, 9, 4 * i + k), 20.0 * uniform(seed, 9, 4 * i + k + 1)};
    };
    const Vec2 a = place(0);
    const Vec2 b = a + (i % 3 == 0 ? 1.0 : 0.2) * (place(2) - a);
    if (free.is_free(a, query) && free.is_free_motion(a, b, query)) each(a, b);
  }
}

TEST(SidePrices, PlannerAndJudgeAgreeWithBruteForce) {
  int asked = 0;
  for (const std::uint64_t seed : seeds(400, 1)) {
    SCOPED_TRACE(seed);
    const World world = random_world(seed, {});
    const double radius = seed % 2 == 0 ? 0.0 : 0.15;
    const PolygonWorld indexed(world.scene, radius, {});
    const SidePrices priced(indexed.sides(), radius, world.prices);
    const std::vector<Segment> sides = sides_of(world.scene);
    SidePrices::Scratch scratch;
    for_legs(seed, world, radius, [&](Vec2 a, Vec2 b) {
      ++asked;
      const double reach = *world.prices.clearance->reach;
      const auto near = [&](double t) {
        const double gap = brute_distance(sides, a + t * (b - a)) - radius;
        return gap < reach ? world.prices.clearance->price * (1.0 - gap / reach) * (1.0 - gap / reach) : 0.0;
      };
      const double brute = distance(a, b) * integral(near, 0.0, 1.0, static_cast<int>(160.0 * (1.0 + distance(a, b))));
      const PriceParts found = priced.parts(a, b, scratch);
      EXPECT_NEAR(found.clearance, brute, 1e-9 * (1.0 + brute));
      const std::array legs{a, b};
      const PriceParts judged = verify_price(world.scene, legs, world.prices, radius, {});
      EXPECT_NEAR(judged.clearance, brute, 1e-9 * (1.0 + brute));
      EXPECT_NEAR(judged.areas, found.areas, 1e-10 * (1.0 + found.areas));
    });
  }
  EXPECT_GT(asked, 1);
}

TEST(SidePrices, TurnedMovedAndScaledWorldsCostTheSame) {
  for (const std::uint64_t seed : seeds(200, 8)) {
    SCOPED_TRACE(seed);
    const World world = random_world(seed, {});
    const Turned turned{seed % 4 * 0.5 * std::numbers::pi + 0.3, 2.0, seed % 2 == 0 ? Vec2{4e6, -3e6} : Vec2{}};
    const World other = random_world(seed, turned);
    const PolygonWorld indexed(world.scene, 0.0, {});
    const PolygonWorld other_indexed(other.scene, 0.0, {});
    const SidePrices priced(indexed.sides(), 0.0, world.prices);
    const SidePrices other_priced(other_indexed.sides(), 0.0, other.prices);
    SidePrices::Scratch scratch;
    for_legs(seed, world, 0.01, [&](Vec2 a, Vec2 b) {
      const double cost = priced.cost(a, b, scratch);
      EXPECT_NEAR(other_priced.cost(turned(a), turned(b), scratch), 2.0 * cost, 1e-6 * (1.0 + cost));
      EXPECT_NEAR(priced.cost(b, a, scratch), cost, 1e-10 * (1.0 + cost));
      EXPECT_GE(cost, distance(a, b));
    });
  }
}

}  // namespace
}  // namespace warren
