// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap/lattice_steps.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "core/base/rng.hpp"
#include "planners/roadmap/milestones.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {
namespace {

constexpr LatticeSize size{.rows = 200, .cols = 300};  // two chunks of rows

Scene scattered_walls() {
  std::vector<Segment> walls;
  for (std::uint64_t i = 0; i < 12'000; ++i) {
    const Vec2 a{300.0 * uniform(1, i, 0), 200.0 * uniform(1, i, 1)};
    walls.push_back({a, a + Vec2{uniform(1, i, 2) - 0.5, i % 3 == 0 ? 0.0 : uniform(1, i, 3) - 0.5}});
  }
  walls.push_back({{3.5, 10.0}, {290.0, 180.0}});
  Scene scene;
  scene.walls = WallSet::narrowest(walls);
  scene.bounds = Box{{0.0, 0.0}, {302.0, 202.0}};
  return scene;
}

TEST(LatticeSteps, AreFreeWhereTheWorldSaysSoEitherWay) {
  const Scene scene = scattered_walls();
  for (const double clearance : {0.0, 0.2}) {
    const MazeWorld world(scene, clearance, Execution{1});
    for (const unsigned threads : {1U, 3U}) {
      SCOPED_TRACE(testing::Message() << clearance << " on " << threads);
      const std::uint64_t count = std::uint64_t{size.rows} * size.cols;
      LatticeSteps steps;
      const RawVector<Vec2> points = lattice_milestones(world, size, count, Execution{threads}, 0, &steps);
      EXPECT_EQ(points, lattice_milestones(world, size, count, Execution{1}, 0));
      MazeWorld::Query query;
      std::size_t free = 0;
      for (std::uint64_t i = 0; i < count; ++i) {
        const Vec2 at = lattice_point(size, i);
        const std::array motions{Motion<Vec2>{at, {at.x + 1.0, at.y}}, Motion<Vec2>{{at.x, at.y + 1.0}, at}};
        const std::uint32_t bits = steps.free_motions(motions);
        for (std::size_t m = 0; m < motions.size(); ++m) {
          const bool is_free = world.is_free_motion(motions[m].from, motions[m].to, query);
          ASSERT_EQ((bits >> m & 1U) != 0, is_free) << at.x << ", " << at.y << ", motion " << m;
          free += static_cast<std::size_t>(is_free);
        }
      }
      EXPECT_GT(free, count / 10);
      EXPECT_LT(free, count * 2);
    }
  }
}

TEST(LatticeSteps, AreAllCandidatesOfShortRadiiAlone) {
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  EXPECT_TRUE(are_lattice_steps(options, {.radius = 1.4}));
  EXPECT_FALSE(are_lattice_steps(options, {.radius = 1.42}));  // diagonals, too
  EXPECT_FALSE(are_lattice_steps(options, {.radius = 1.0, .neighbours = 4}));
  options.sampler = SamplerKind::uniform;
  EXPECT_FALSE(are_lattice_steps(options, {.radius = 1.0}));
}

}  // namespace
}  // namespace warren
