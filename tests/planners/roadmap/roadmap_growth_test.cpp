// SPDX-License-Identifier: BSD-3-Clause
// How many samples worlds that are much longer than broad need, and how far milestones are joined there.
#include "planners/roadmap/connection.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "solve/kinds/planned_worlds.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {
namespace {

constexpr double world_length = 1e5;

/// Fences in a box of length : 1, each open below or above; some are short and lie anywhere.
Scene long_world(std::uint64_t seed) {
  test::Dice dice(seed);
  std::vector<Segment> walls;
  for (int i = 0; i < 20; ++i) {
    const double x = world_length * (i + 1 + 0.5 * dice.real()) / 22.0;
    const double gap = 0.3 + 0.4 * dice.real();
    walls.push_back(dice.roll(2) == 0 ? Segment{{x, 0.0}, {x, gap}} : Segment{{x, gap}, {x, 1.0}});
    const Vec2 at{world_length * dice.real(), 0.1 + 0.8 * dice.real()};
    walls.push_back({at, {at.x + 0.05 * dice.real(), at.y + 0.05}});
  }
  Scene scene;
  scene.walls = WallSet::narrowest(walls);
  scene.bounds = Box{{0.0, 0.0}, {world_length, 1.0}};
  return scene;
}

TEST(RoadmapRule, JoinsWithinAStripWhereADiscWouldStickOutOfTheWorld) {
  const double in_square = connection_rule({}, 1000, 1.0, 1.0).radius;
  EXPECT_EQ(in_square, connection_rule({}, 1000, 1.0).radius) << "as where the box is not known";
  const double in_strip = connection_rule({}, 1000, world_length, 1.0).radius;
  EXPECT_DOUBLE_EQ(2.0 * in_strip * 1000 / world_length, expected_neighbours);
}

TEST(RoadmapRule, LongWorldsOfFewWallsAreSolvedWithFewSamples) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const MazeWorld world(long_world(seed), 0.0, {});
    const RoadmapOptions options{.seed = seed};
    const Solution<Vec2> plan = lazy_prm(WorldView(world), {1.0, 0.5}, {world_length - 1.0, 0.5}, options, {});
    EXPECT_EQ(plan.outcome, Outcome::solved);
    EXPECT_LT(plan.counters.samples, 20'000U);
    EXPECT_LT(growth_cap * growth * static_cast<double>(usual_samples(WorldView(world), options, {})), 1e6)
        << "if there were no way";
  }
}

TEST(RoadmapRule, LongMazesGetTheSamplesThatTheirCellsNeed) {
  std::vector<Segment> walls;
  constexpr int cells = 3000;  // of a corridor whose fences stand at its left and right by turns
  for (int i = 1; i < cells; ++i) {
    walls.push_back(i % 2 == 0 ? Segment{{i * 1.0, 0.0}, {i * 1.0, 0.6}} : Segment{{i * 1.0, 0.4}, {i * 1.0, 1.0}});
  }
  Scene scene;
  scene.walls = WallSet::narrowest(walls);
  scene.bounds = Box{{0.0, 0.0}, {1.0 * cells, 1.0}};
  const MazeWorld world(scene, 0.0, {});
  EXPECT_GT(usual_samples(WorldView(world), {}, {}), 4U * cells);
}

}  // namespace
}  // namespace warren
