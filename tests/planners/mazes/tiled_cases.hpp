// SPDX-License-Identifier: BSD-3-Clause
// Questions to tiled_prm among walls, and its oracle, the plain pipeline: prm over MazeWorld, with its own index,
// neighbours, graph and search.
#pragma once

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "planners/mazes/tiled_prm_lattice.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "solve/kinds/planned_worlds.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"
#include "verify/judges/verify_point.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren::test {

struct TiledCase {
  Scene scene;
  LatticeSize lattice;
  double clearance = 0.1;
  Vec2 start;
  Vec2 goal;
};

inline TiledCase maze_case(const MazeOptions& maze, double clearance = 0.1, bool merged = false) {
  Scene scene = maze_scene(maze, merged, {});
  const Vec2 start{scene.start[0], scene.start[1]};
  const Vec2 goal{scene.goal[0], scene.goal[1]};
  return {std::move(scene), {maze.rows, maze.cols}, clearance, start, goal};
}

inline std::vector<Segment> segments_of(const WallSet& walls) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < walls.size(); ++i) segments.push_back(walls.segment(i));
  return segments;
}

inline RoadmapOptions options_of(const TiledCase& c) {
  RoadmapOptions options;
  options.sampler = SamplerKind::lattice;
  options.lattice = c.lattice;
  return options;
}

inline Solution<Vec2> tiled(const TiledCase& c, const Execution& execution = {}) {
  std::vector<Segment> bounds;
  if (c.scene.bounds) {
    const Box& box = *c.scene.bounds;
    const Vec2 corners[] = {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    for (int i = 0; i < 4; ++i) bounds.push_back({corners[i], corners[(i + 1) % 4]});
  }
  return tiled_prm({c.scene.walls, bounds, c.scene.bounds, c.clearance, c.start, c.goal}, options_of(c), execution);
}

inline Solution<Vec2> plain(const TiledCase& c) {
  const MazeWorld world(c.scene, c.clearance, {});
  return prm(WorldView(world), c.start, c.goal, options_of(c), {});
}

inline void expect_same_answer(const TiledCase& c, const Solution<Vec2>& expected, const Solution<Vec2>& found) {
  ASSERT_EQ(name_of(found.outcome), name_of(expected.outcome));
  EXPECT_EQ(found.roadmap.milestones, expected.roadmap.milestones);
  EXPECT_EQ(found.roadmap.edges, expected.roadmap.edges);
  EXPECT_EQ(found.roadmap.components, expected.roadmap.components);
  EXPECT_EQ(found.counters.samples, expected.counters.samples);
  EXPECT_EQ(found.counters.neighbour_queries, expected.counters.neighbour_queries);
  EXPECT_EQ(found.counters.edges_checked, expected.counters.edges_checked);
  EXPECT_NEAR(length_of(found), length_of(expected), 1e-12 * length_of(expected));
  if (found.outcome == Outcome::solved) {
    VerifyOptions verify;
    verify.clearance = c.clearance;
    EXPECT_TRUE(verify_path(c.scene, found.path, verify, {}).verified);
    EXPECT_EQ(found.path.front(), c.start);
    EXPECT_EQ(found.path.back(), c.goal);
  }
  if (found.outcome == Outcome::not_connected) {
    EXPECT_EQ(found.separation.start_size, expected.separation.start_size);
    EXPECT_EQ(found.separation.goal_size, expected.separation.goal_size);
    EXPECT_EQ(found.separation.nearest_gap, expected.separation.nearest_gap);
  }
}

inline void expect_same_answer(const TiledCase& c) { expect_same_answer(c, plain(c), tiled(c)); }

}  // namespace warren::test
