// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_price.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using test::seeds;

// The oracle: a leg at thousands of poses, at each all sides of the body against all sides of all obstacles.

double to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const double length_sq = dot(b - a, b - a);
  const double t = length_sq > 0.0 ? std::fmax(0.0, std::fmin(1.0, dot(p - a, b - a) / length_sq)) : 0.0;
  return std::hypot(p.x - a.x - t * (b.x - a.x), p.y - a.y - t * (b.y - a.y));
}

struct PricedLeg {
  Se2 a;
  double length;
  double turn;
  bool is_arc;

  Se2 at(double t) const {
    const double theta = a.theta + t * turn;
    if (!is_arc || turn == 0.0) return {a.x + t * length * std::cos(0.3), a.y + t * length * std::sin(0.3), theta};
    const double radius = length / turn;  // about a point to the left
    const Vec2 middle{a.x - radius * std::sin(a.theta), a.y + radius * std::cos(a.theta)};
    return {middle.x + radius * std::sin(theta), middle.y - radius * std::cos(theta), theta};
  }
};

struct PricedWorld {
  Scene scene;
  RobotSpec robot;
  Prices prices;
  std::vector<Segment> sides;

  double clearance(const Se2& pose) const {
    std::vector<Vec2> corners;
    for (const Vec2 c : robot.outline.empty() ? std::vector<Vec2>{Vec2{}} : robot.outline) {
      corners.push_back({pose.x + std::cos(pose.theta) * c.x - std::sin(pose.theta) * c.y,
                         pose.y + std::sin(pose.theta) * c.x + std::cos(pose.theta) * c.y});
    }
    double least = std::numeric_limits<double>::infinity();
    for (const Segment& s : sides) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 next = corners[(i + 1) % corners.size()];
        least = std::fmin(least, std::fmin(to_segment(s.a, corners[i], next), to_segment(s.b, corners[i], next)));
        least = std::fmin(least, to_segment(corners[i], s.a, s.b));
      }
    }
    return least - robot.radius;
  }
  /// Areas are triangles and one square of a mask's cells.
  double factor(Vec2 p) const {
    double greatest = 1.0;
    for (const PricedArea& area : prices.areas) {
      int left = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec2 a = area.corners[i];
        const Vec2 b = area.corners[(i + 1) % 3];
        left += cross(b - a, p - a) > 0.0 ? 1 : -1;
      }
      if (std::abs(left) == 3) greatest = std::fmax(greatest, area.factor);
    }
    for (const PriceMask& mask : prices.masks) {
      const MaskCells& cells = *mask.read;
      const double x =
          std::cos(cells.yaw_rad) * (p.x - cells.origin.x) + std::sin(cells.yaw_rad) * (p.y - cells.origin.y);
      const double y =
          std::cos(cells.yaw_rad) * (p.y - cells.origin.y) - std::sin(cells.yaw_rad) * (p.x - cells.origin.x);
      const double column = std::floor(x / cells.cell);
      const double row = std::floor(y / cells.cell);
      if (column < 0 || row < 0 || column >= cells.width || row >= cells.height) continue;
      const int value = cells.values[static_cast<std::size_t>(row * cells.width + column)];
      greatest = std::fmax(greatest, 1.0 + (*mask.factor - 1.0) * value / 100.0);
    }
    return greatest;
  }
};

/// Some walls in a box, or a map with some blocked cells.
PricedWorld random_world(std::uint64_t seed) {
  PricedWorld world;
  const auto draw = [&](std::uint64_t i, double low, double high) { return low + (high - low) * uniform(seed, 3, i); };
  const bool on_map = seed % 2 == 0;
  const Box box{{0, 0}, {10, 8}};
  const std::array corners{box.min, Vec2{box.max.x, box.min.y}, box.max, Vec2{box.min.x, box.max.y}};
  for (std::size_t i = 0; i < 4; ++i) world.sides.push_back({corners[i], corners[(i + 1) % 4]});
  if (on_map) {
    OccupancyMap map;
    map.cell = 0.5;
    map.blocked = Bitmap(20, 16);
    for (std::uint64_t i = 0; i < 12; ++i) {
      const auto x = static_cast<std::uint32_t>(draw(2 * i, 0, 20));
      const auto y = static_cast<std::uint32_t>(draw(2 * i + 1, 0, 16));
      map.blocked.set(x, y);
      const Vec2 low{0.5 * x, 0.5 * y};
      const std::array square{low, low + Vec2{0.5, 0}, low + Vec2{0.5, 0.5}, low + Vec2{0, 0.5}};
      for (std::size_t k = 0; k < 4; ++k) world.sides.push_back({square[k], square[(k + 1) % 4]});
    }
    world.scene.map = std::move(map);
  } else {
    std::vector<Segment> walls;
    for (std::uint64_t i = 0; i < 8; ++i) {
      const Vec2 a{draw(50 + 4 * i, 0, 10), draw(51 + 4 * i, 0, 8)};
      walls.push_back({a, a + Vec2{draw(52 + 4 * i, -1, 1), draw(53 + 4 * i, -1, 1)}});
    }
    world.scene.walls = WallSet::narrowest(walls);
    for (std::size_t i = 0; i < walls.size(); ++i) world.sides.push_back(world.scene.walls.segment(i));
    world.scene.bounds = box;
  }
  world.robot.kind = seed % 3 == 0 ? RobotKind::polygon : RobotKind::car;
  world.robot.turning_radius = 0.5;
  world.robot.steering = SteeringKind::reeds_shepp;
  if (seed % 3 == 1) {
    world.robot.radius = 0.2;
  } else {
    world.robot.outline = {{-0.2, -0.15}, {0.5, -0.15}, {0.5, 0.1}, {0.1, 0.1}, {0.1, 0.3}, {-0.2, 0.3}};
  }
  world.prices.clearance = ClearancePrice{draw(90, 0.5, 5.0), draw(91, 0.2, 1.2)};
  for (std::uint64_t i = 0; i < 2; ++i) {
    PricedArea area{draw(100 + i, 1.5, 6.0), {}, 0};
    for (std::uint64_t k = 0; k < 3; ++k)
      area.corners.push_back({draw(110 + 8 * i + k, 0, 10), draw(130 + 8 * i + k, 0, 8)});
    world.prices.areas.push_back(area);
  }
  MaskCells cells{6, 4, {}, 0.9, {draw(150, 1, 5), draw(151, 1, 4)}, seed % 4 == 1 ? 0.7 : 0.0};
  for (std::uint64_t i = 0; i < 24; ++i) cells.values.push_back(static_cast<std::int8_t>(random_bits(seed, 9, i) % 99));
  world.prices.masks.push_back({MaskKind::areas, "mask.yaml", 8.0, 100.0, -1.0, cells});
  return world;
}

TEST(VerifyBodyPrice, LegsCostWhatDensePosesSayAndTheErrorIsHonest) {
  constexpr int samples = 1000;
  int asked = 0;
  int near = 0;
  for (const std::uint64_t seed : seeds(600, 4)) {
    SCOPED_TRACE(seed);
    const PricedWorld world = random_world(seed);
    for (std::uint64_t i = 0; i < 8; ++i) {
      const auto draw = [&](std::uint64_t k, double low, double high) {
        return low + (high - low) * uniform(seed, 20 + i, k);
      };
      const bool is_arc = world.robot.kind == RobotKind::car;
      PricedLeg leg{
          {draw(0, 0.5, 9.5), draw(1, 0.5, 7.5), draw(2, -3, 3)}, draw(3, 0.2, 2.5), draw(4, -1.5, 1.5), is_arc};
      if (is_arc && random_bits(seed, 40, i) % 2 == 0) leg.length = -leg.length;
      if (is_arc && i % 4 == 0) leg = {{leg.a.x, leg.a.y, 0.3}, leg.length, 0.0, true};  // straight on
      double clearance = 0.0;
      double areas = 0.0;
      double least = 1.0;
      for (int k = 0; k < samples && least > 0.01; ++k) {
        const Se2 pose = leg.at((k + 0.5) / samples);
        const double free = world.clearance(pose);
        least = std::fmin(least, free);
        const double left = std::fmax(0.0, 1.0 - free / *world.prices.clearance->reach);
        clearance += left * left;
        areas += world.factor(pose.position()) - 1.0;
      }
      if (least <= 0.01) continue;
      ++asked;
      const double length = std::abs(leg.length);
      clearance *= world.prices.clearance->price * length / samples;
      areas *= length / samples;
      const std::array path{leg.a, leg.at(1.0)};
      const PriceParts found = verify_body_price(world.scene, path, world.robot, world.prices, {});
      if (clearance > 0.01) ++near;
      EXPECT_NEAR(found.clearance, clearance, found.error + 1e-4 * (length + clearance)) << i;
      EXPECT_LE(found.error, 0.5e-3 * (length + found.clearance) * (1.0 + 1e-9)) << i;
      EXPECT_NEAR(found.areas, areas, 60.0 * 8.0 * length / samples) << i;
      EXPECT_EQ(found.turning + found.cusps + found.reverse, 0.0);
      // There and back, and in two pieces.
      const std::array back{path[1], path[0]};
      const PriceParts again = verify_body_price(world.scene, back, world.robot, world.prices, {});
      EXPECT_NEAR(again.clearance, found.clearance, found.error + again.error + 1e-12);
      EXPECT_NEAR(again.areas, found.areas, 1e-6 * (1.0 + found.areas));
    }
  }
  EXPECT_GT(asked, 3);
  EXPECT_GT(near, 0);
}

TEST(VerifyBodyPrice, TurnsOnTheSpotCostNothingAndWhatIsFarCostsNothing) {
  PricedWorld world = random_world(3);
  world.scene = {};
  world.scene.bounds = Box{{0, 0}, {100, 100}};
  const std::array path{Se2{50, 50, 0}, Se2{50, 50, 2}, Se2{60, 50, 2}};
  const PriceParts found = verify_body_price(world.scene, path, world.robot, world.prices, {});
  EXPECT_EQ(found.clearance, 0.0);
  EXPECT_EQ(found.error, 0.0);
  world.prices.clearance = ClearancePrice{1.0, {}};
  EXPECT_THROW(verify_body_price(world.scene, path, world.robot, world.prices, {}), InputError);
}

TEST(VerifyBodyPrice, BesideAWallItIsAClosedForm) {
  // A box of half width 0.5 that keeps 0.5 from the wall: (1 - 0.5 / 2)^2 a unit.
  Scene scene;
  scene.bounds = Box{{0, 0}, {100, 50}};
  RobotSpec robot{.kind = RobotKind::polygon, .outline = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
  Prices prices;
  prices.clearance = ClearancePrice{3.0, 2.0};
  const std::array path{Se2{10, 1, 0}, Se2{50, 1, 0}};
  const PriceParts found = verify_body_price(scene, path, robot, prices, {});
  EXPECT_NEAR(found.clearance, 40.0 * 3.0 * 0.75 * 0.75, found.error);
  EXPECT_GT(found.error, 0.0);
  EXPECT_LE(found.error, 0.5e-3 * (40.0 + found.clearance));
}

}  // namespace
}  // namespace warren
