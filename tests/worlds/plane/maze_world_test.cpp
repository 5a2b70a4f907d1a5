// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/maze_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren {
namespace {

using Bits = std::vector<std::uint64_t>;

bool bit(const Bits& bits, std::size_t i) { return (bits[i / 64] >> (i % 64) & 1U) != 0; }

/// Every point and step of a band of rows, asked for alone; what is out before stays out.
void expect_band_as_points(const MazeWorld& world, const LatticeRows& rows) {
  MazeWorld::Query query;
  Bits before(rows.rows * rows.words_a_row, ~std::uint64_t{0});
  before.at(0) = 0x5555;
  Bits points = before;
  Bits right = before;
  Bits up = before;
  world.keep_free(rows, points, right, up);
  for (std::size_t i = 0; i < before.size() * 64; ++i) {
    const std::size_t cols = rows.words_a_row * 64;
    const Vec2 at{static_cast<double>(i % cols + 1), rows.first + static_cast<double>(i / cols)};
    ASSERT_EQ(bit(points, i), bit(before, i) && world.is_free(at, query)) << at.x << ", " << at.y;
    ASSERT_EQ(bit(right, i), bit(before, i) && world.is_free_motion(at, {at.x + 1.0, at.y}, query))
        << at.x << ", " << at.y;
    ASSERT_EQ(bit(up, i), bit(before, i) && world.is_free_motion(at, {at.x, at.y + 1.0}, query))
        << at.x << ", " << at.y;
  }
}

TEST(MazeWorld, LooksAtRowsOfPointsAndStepsAsAtEachAlone) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    constexpr double side = 90.0;
    std::vector<Segment> walls;
    for (std::uint64_t i = 0; i < 60; ++i) {
      const auto c = [&](std::uint64_t axis) { return side * uniform(seed, i, axis); };
      Segment wall{{c(0), c(1)}, {c(2), c(3)}};
      if (i % 4 == 1) wall.b = wall.a + 0.02 * (wall.b - wall.a);
      if (i % 4 == 2)
        wall = {{std::round(wall.a.x), std::round(wall.a.y)}, {std::round(wall.b.x), std::round(wall.a.y)}};
      if (i % 4 == 3) wall.b = {wall.a.x, wall.b.y};
      walls.push_back(wall);
    }
    Scene scene;
    scene.walls = WallSet::narrowest(walls);
    if (seed % 2 == 0) scene.bounds = Box{{10.0, 5.0}, {80.5, 70.0}};
    for (const double clearance : {0.0, 0.1, 1.0, 3.7}) {
      SCOPED_TRACE(clearance);
      const MazeWorld world(scene, clearance, Execution{1});
      for (double row = 0.0; row <= 92.0; row += 7.0) expect_band_as_points(world, {row, 7, 2});
      expect_band_as_points(world, {40.0, 1, 1});
    }
  }
}

TEST(MazeWorld, StatesAndMotionsAreFreeWhereWallsAndBoundsAreFarEnough) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const auto point = [&](std::uint64_t i) {
      return Vec2{10 * uniform(seed, i, 0) - 1, 10 * uniform(seed, i, 1) - 1};
    };
    std::vector<Segment> walls;
    for (std::uint64_t i = 0; i < 10; ++i) walls.push_back({point(2 * i), point(2 * i) + 0.2 * point(2 * i + 1)});
    Scene scene;
    scene.walls = WallSet::narrowest(walls);
    scene.bounds = Box{{0.0, 0.0}, {8.0, 8.0}};
    for (const Segment& side : bounds_walls(scene)) walls.push_back(side);
    const double clearance = 0.1 * static_cast<double>(seed % 4);
    const MazeWorld world(scene, clearance, Execution{1});
    MazeWorld::Query query;
    for (std::uint64_t i = 100; i < 600; ++i) {
      const Segment motion{point(2 * i), point(2 * i) + 0.3 * point(2 * i + 1)};
      const auto is_free = [&](const Segment& s) {
        return std::all_of(walls.begin(), walls.end(), [&](const Segment& wall) {
          const double d = distance(s, wall);
          return d > 0.0 && d >= clearance;
        });
      };
      ASSERT_EQ(world.is_free(motion.a, query), scene.bounds->contains(motion.a) && is_free({motion.a, motion.a})) << i;
      ASSERT_EQ(world.is_free_motion(motion.a, motion.b, query), is_free(motion)) << i;
    }
  }
}

TEST(MazeWorld, ChecksBunchesOfMotionsAndStatesAsEachAlone) {
  MazeOptions options;
  options.rows = options.cols = 12;
  for (options.seed = 1; options.seed <= 20; ++options.seed) {
    SCOPED_TRACE(options.seed);
    const MazeWorld world(maze_scene(options, options.seed % 2 == 0, Execution{1}), 0.1, Execution{1});
    MazeWorld::Query query;
    for (std::uint64_t bunch = 0; bunch < 50; ++bunch) {
      std::vector<Motion<Vec2>> motions;
      for (std::uint64_t i = 0; i < 1 + bunch % bunch_size; ++i) {
        const auto u = [&](std::uint64_t axis) { return uniform(options.seed, 1000 * bunch + i, axis); };
        const Vec2 from{1.0 + std::floor(11 * u(0)), 1.0 + std::floor(11 * u(1))};
        motions.push_back({from, u(2) < 0.5 ? from + Vec2{1, 0} : from + Vec2{u(3), u(4)}});
      }
      const std::uint32_t free = world.free_motions(motions, query);
      for (std::size_t i = 0; i < motions.size(); ++i) {
        ASSERT_EQ((free >> i & 1U) != 0, world.is_free_motion(motions[i].from, motions[i].to, query));
      }
      std::vector<Vec2> states;
      for (const Motion<Vec2>& motion : motions)
        states.push_back(2.0 * motion.to - Vec2{6, 6});  // some of them outside
      const std::uint32_t standing = world.free_states(states, query);
      for (std::size_t i = 0; i < states.size(); ++i) {
        ASSERT_EQ((standing >> i & 1U) != 0, world.is_free(states[i], query));
      }
    }
  }
}

TEST(MazeWorld, AWallThatEndsInTheMiddleOfAnotherIsNoNarrowWay) {
  Scene scene;
  scene.bounds = Box{{0, 0}, {10, 10}};
  for (const double x : {5.0, 4.5}) {  // the bounds are walls, too
    scene.walls = WallSet::narrowest(std::array{Segment{{x, 0}, {x, 10}}});
    EXPECT_LE(MazeWorld(scene, 0.0, Execution{1}).suggested_samples({}), 1000.0);
  }
}

}  // namespace
}  // namespace warren
