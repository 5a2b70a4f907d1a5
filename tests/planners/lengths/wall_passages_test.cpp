// SPDX-License-Identifier: BSD-3-Clause
// The oracle is the world of the plain planner, asked motion by motion; the number of edges is the tiled planner's.
#include "planners/lengths/core_graph.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/base/solution.hpp"
#include "planners/lengths/route_index.hpp"
#include "planners/mazes/tiled_prm_lattice.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/seeds.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {
namespace {

Vec2 point_of(std::uint32_t col, std::uint32_t row) { return {col + 1.0, row + 1.0}; }

std::uint64_t expect_motions_of_world(const Scene& scene, LatticeSize size, double clearance) {
  const MazeWorld world(scene, clearance, {});
  const LatticePassages passages = wall_passages({scene.walls, {}, scene.bounds, clearance, size}, {});
  auto query = world.make_query();
  std::uint64_t count = 0;
  for (std::uint32_t row = 0; row < size.rows; ++row) {
    for (std::uint32_t col = 0; col < size.cols; ++col) {
      const auto free = [&](std::uint32_t to_col, std::uint32_t to_row) {
        const Vec2 to = point_of(to_col, to_row);
        return to_col < size.cols && to_row < size.rows && world.is_free(point_of(col, row), query) &&
               world.is_free(to, query) && world.is_free_motion(point_of(col, row), to, query);
      };
      const unsigned open = passages.open_at(col, row) & 3U;
      EXPECT_EQ((open & 1U) != 0, free(col + 1, row)) << col << ' ' << row;
      EXPECT_EQ((open & 2U) != 0, free(col, row + 1)) << col << ' ' << row;
      count += (open & 1U) + (open >> 1);
    }
  }
  return count;
}

TEST(WallPassages, AreTheFreeMotionsOfMazes) {
  for (const std::uint64_t seed : test::seeds(4)) {
    for (const double clearance : {0.0, 0.1, 0.499}) {
      SCOPED_TRACE(std::to_string(seed) + " " + std::to_string(clearance));
      const MazeOptions maze{70, 90, seed, MazeAlgorithm::kruskal, seed % 2 == 0 ? 0.1 : 0.0};
      const Scene scene = maze_scene(maze, seed > 2, {});
      const std::uint64_t edges = expect_motions_of_world(scene, {maze.rows, maze.cols}, clearance);
      EXPECT_GE(edges, 70U * 90U - 1);
    }
  }
}

TEST(WallPassages, AreTheFreeMotionsAmongSlantedWalls) {
  for (const std::uint64_t seed : test::seeds(8)) {
    SCOPED_TRACE(seed);
    std::vector<Segment> walls{{{0.5, 0.5}, {80.5, 0.5}}, {{80.5, 0.5}, {80.5, 70.5}}};
    for (std::uint64_t i = 0; i < 150; ++i) {
      const Vec2 a{80 * uniform(seed, i, 0), 70 * uniform(seed, i, 1)};
      walls.push_back({a, a + Vec2{9 * uniform(seed, i, 2) - 4.5, 9 * uniform(seed, i, 3) - 4.5}});
    }
    Scene scene;
    scene.walls = WallSet::narrowest(walls);
    const std::uint64_t edges = expect_motions_of_world(scene, {70, 80}, seed % 2 == 0 ? 0.3 : 0.0);
    EXPECT_GT(edges, 1000U);
  }
}

TEST(WallPassages, TheIndexAnswersWhatTheTiledPlannerDoes) {
  for (const std::uint64_t seed : test::seeds(4)) {
    SCOPED_TRACE(seed);
    const MazeOptions maze{150, 150, seed, MazeAlgorithm::backtracker, seed % 2 == 0 ? 0.05 : 0.0};
    const Scene scene = maze_scene(maze, false, {});
    RoadmapOptions options;
    options.sampler = SamplerKind::lattice;
    options.lattice = {maze.rows, maze.cols};
    const Solution<Vec2> plan = tiled_prm({scene.walls, {}, {}, 0.1, point_of(0, 0), point_of(149, 149)}, options, {});
    const RouteIndex index(wall_passages({scene.walls, {}, {}, 0.1, options.lattice}, {}), {}, {});
    RouteQuery query(index);
    const auto length = query.length(0, 150 * 150 - 1);
    ASSERT_TRUE(length);
    EXPECT_EQ(static_cast<double>(*length), path_length(plan.path, MazeWorld::distance));
  }
}

TEST(WallPassages, AClearanceOutOfRangeIsRefused) {
  const Scene scene = maze_scene({.rows = 3, .cols = 3}, false, {});
  EXPECT_THROW(wall_passages({scene.walls, {}, {}, -0.1, {3, 3}}, {}), InputError);
  EXPECT_THROW(wall_passages({scene.walls, {}, {}, 8.1, {3, 3}}, {}), InputError);
}

}  // namespace
}  // namespace warren
