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
