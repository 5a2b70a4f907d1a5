// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/sides_near_legs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "core/base/rng.hpp"
#include "verify/judges/verify_turning.hpp"

namespace warren {
namespace {

/// 300 short walls, some long ones, a few polygons.
Scene scattered_sides(std::uint64_t seed) {
  Scene scene;
  std::vector<Segment> walls;
  for (std::uint64_t i = 0; i < 320; ++i) {
    const double length = i % 16 == 0 ? 90.0 : 1.5;
    const Vec2 a{100 * uniform(seed, i, 0), 60 * uniform(seed, i, 1)};
    walls.push_back({a, a + length * Vec2{uniform(seed, i, 2) - 0.5, uniform(seed, i, 3) - 0.5}});
  }
  scene.walls = WallSet::narrowest(walls);
  for (std::uint64_t i = 0; i < 9; ++i) {
    const Vec2 a{100 * uniform(seed, i, 4), 60 * uniform(seed, i, 5)};
    scene.polygons.push_back({{a, a + Vec2{2, 0.5}, a + Vec2{0.5, 3}}});
  }
  scene.bounds = Box{{-60, -60}, {160, 120}};
  return scene;
}

/// Does a part of the segment lie in the box? By clipping.
bool meets(const Segment& s, const Box& box) {
  double from = 0.0;
  double to = 1.0;
  const auto clip = [&](double a, double way, double low, double high) {
    if (way == 0.0) {
      if (a < low || a > high) to = -1.0;
      return;
    }
    const double t = (low - a) / way;
    const double u = (high - a) / way;
    from = std::max(from, std::min(t, u));
    to = std::min(to, std::max(t, u));
  };
  clip(s.a.x, s.b.x - s.a.x, box.min.x, box.max.x);
  clip(s.a.y, s.b.y - s.a.y, box.min.y, box.max.y);
  return from <= to;
}

std::vector<Box> random_boxes(std::uint64_t seed, double width, double height) {
  std::vector<Box> boxes;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const Vec2 corner{width * uniform(seed, i, 10), height * uniform(seed, i, 11)};
    const double size = i == 7 ? 0.0 : 4.0;
    boxes.push_back({corner, corner + size * Vec2{uniform(seed, i, 12), uniform(seed, i, 13)}});
  }
  return boxes;
}

TEST(PathSurroundings, HoldEverySideThatMeetsABox) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = scattered_sides(seed);
    const Obstacles obstacles(scene);
    PathSurroundings around(scene, nullptr, {});
    const std::vector<Box> boxes = random_boxes(seed, 100, 60);
    around.file(boxes, {.threads = 1 + static_cast<unsigned>(seed % 3)});
    std::vector<NearSide> sides;
    std::size_t most = 0;
    for (const Box& box : boxes) {
      around.gather(std::span(&box, 1), sides, {});
      std::set<std::uint64_t> numbers;
      for (const NearSide& side : sides) EXPECT_TRUE(numbers.insert(side.number).second) << "twice";
      for (std::size_t i = 0; i < obstacles.size(); ++i) {
        EXPECT_TRUE(!meets(obstacles.segment(i), box) || numbers.contains(i)) << i;
      }
      most = std::max(most, sides.size());
    }
    EXPECT_LT(most, obstacles.size() / 2);
  }
}

TEST(PathSurroundings, AreTheBordersOfAMapsCells) {
  using Edge = std::tuple<std::int64_t, std::int64_t, bool>;  // corner, and does it rise?
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene;
    OccupancyMap& map = scene.map.emplace();
    map.blocked = Bitmap(seed % 3 == 0 ? 64 : 137, 40);
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      for (std::uint32_t x = 0; x < map.width(); ++x) {
        if (uniform(seed, y, x) < 0.3) map.blocked.set(x, y);
      }
    }
    const auto is_blocked = [&](std::int64_t x, std::int64_t y) {
      const bool inside = x >= 0 && y >= 0 && x < map.width() && y < map.height();
      return !inside || map.blocked.holds(x, y);
    };
    const PathSurroundings around(scene, nullptr, {});
    std::vector<NearSide> sides;
    std::vector<Box> boxes = random_boxes(seed, map.width(), map.height());
    boxes.push_back({{-5, -5}, {300, 300}});
    for (const Box& box : boxes) {
      around.gather(std::span(&box, 1), sides, {});
      std::set<Edge> found;
      for (const NearSide& side : sides) {
        const auto x = std::llround(side.segment.a.x);
        const auto y = std::llround(side.segment.a.y);
        const bool rises = side.segment.a.x == side.segment.b.x;
        const auto length =
            std::llround(rises ? side.segment.b.y - side.segment.a.y : side.segment.b.x - side.segment.a.x);
        for (std::int64_t n = 0; n < length; ++n) {
          const Edge edge{rises ? x : x + n, rises ? y + n : y, rises};
          EXPECT_TRUE(found.insert(edge).second) << "twice";
          const auto [u, v, up] = edge;
          EXPECT_NE(is_blocked(u, v), up ? is_blocked(u - 1, v) : is_blocked(u, v - 1));
        }
      }
      for (std::int64_t y = 0; y <= map.height(); ++y) {
        for (std::int64_t x = 0; x <= map.width(); ++x) {
          const Vec2 corner{static_cast<double>(x), static_cast<double>(y)};
          const bool rises = y < map.height() && is_blocked(x, y) != is_blocked(x - 1, y);
          const bool lies = x < map.width() && is_blocked(x, y) != is_blocked(x, y - 1);
          EXPECT_TRUE(!rises || !meets({corner, corner + Vec2{0, 1}}, box) || found.contains({x, y, true}))
              << x << ' ' << y;
          EXPECT_TRUE(!lies || !meets({corner, corner + Vec2{1, 0}}, box) || found.contains({x, y, false}))
              << x << ' ' << y;
        }
      }
    }
  }
}

TEST(PathSurroundings, AVerificationTellsHowFarTheNearestIsHoweverFar) {
  const std::vector<Vec2> body{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  const std::vector<Se2> path{{400, 500, 0}, {600, 500, 0}, {600, 500, 1}};
  Scene walls;
  walls.bounds = Box{{0, 0}, {1000, 1000}};
  walls.walls = WallSet::narrowest(std::vector<Segment>{{{500, 600}, {510, 600}}});
  const Verification among_walls = verify_se2(walls, body, path, {}, {});
  EXPECT_TRUE(among_walls.verified);
  EXPECT_NEAR(among_walls.min_clearance, 99.5, 1e-3);
  Scene map;
  map.map.emplace().blocked = Bitmap(1000, 1000);
  map.map->blocked.set(500, 600);
  const Verification on_map = verify_se2(map, body, path, {}, {});
  EXPECT_TRUE(on_map.verified);
  EXPECT_NEAR(on_map.min_clearance, 99.5, 1e-3);
  map.map->blocked.set(450, 500);
  const Verification blocked = verify_se2(map, body, path, {}, {});
  ASSERT_TRUE(blocked.first_violation);
  EXPECT_EQ(blocked.first_violation->leg, 0U);
  EXPECT_EQ(blocked.first_violation->obstacle.substr(0, 5), "cell ");
}

}  // namespace
}  // namespace warren
