// SPDX-License-Identifier: BSD-3-Clause
// Passages of mazes' own walls, without a look at distances: bit for bit those of the lattice planner.
#include "solve/kept/lattice_roadmap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "planners/lengths/core_graph.hpp"
#include "scenes/files/read_world_io.hpp"

namespace warren {
namespace {

std::vector<Segment> segments_of(const WallSet& walls) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < walls.size(); ++i) segments.push_back(walls.segment(i));
  return segments;
}

TEST(PassagesOfMaze, AreThoseAmongTheWalls) {
  for (const char* source : {"maze:70x150", "maze:130x64,loops=0.1,algorithm=kruskal", "maze:1x90", "maze:65x3"}) {
    Scene scene = read_world(source);
    std::vector<Segment> walls = segments_of(scene.walls);
    std::reverse(walls.begin() + 4, walls.end());
    walls.push_back({{2.5, 0.5}, {0.5, 0.5}});  // longer than a cell, the other way round
    const WallSet shuffled = WallSet::narrowest(walls);
    for (const bool in_order : {true, false}) {
      if (!in_order) scene.walls = shuffled;
      for (const double reach : {0.0, 0.1, 0.48}) {
        SCOPED_TRACE(std::string(source) + " " + std::to_string(reach));
        const auto found = passages_of_maze(scene, reach, {});
        ASSERT_TRUE(found.has_value());
        const LatticePassages expected =
            wall_passages({scene.walls, {}, scene.bounds, reach, {scene.maze->rows, scene.maze->cols}}, {});
        EXPECT_TRUE(std::ranges::equal(found->right_words(), expected.right_words()));
        EXPECT_TRUE(std::ranges::equal(found->up_words(), expected.up_words()));
      }
    }
  }
}

TEST(PassagesOfMaze, AreNotTakenForGrantedElsewhere) {
  const Scene maze = read_world("maze:20x30");
  EXPECT_FALSE(passages_of_maze(maze, 0.5, {}));  // bodies that touch the walls on both sides
  Scene bounded = maze;
  bounded.bounds = Box{{0.5, 0.5}, {20.0, 20.5}};
  EXPECT_FALSE(passages_of_maze(bounded, 0.1, {}));
  Scene no_hint = maze;
  no_hint.maze.reset();
  EXPECT_FALSE(passages_of_maze(no_hint, 0.1, {}));
  for (const bool off_grid : {true, false}) {
    Scene other = maze;
    std::vector<Segment> walls = segments_of(maze.walls);
    if (off_grid) {
      walls.push_back({{3.0, 3.5}, {3.0, 4.5}});
    } else {
      std::reverse(walls.begin(), walls.end());  // whose outline isn't where it is looked for
    }
    other.walls = WallSet::narrowest(walls);
    EXPECT_FALSE(passages_of_maze(other, 0.1, {})) << off_grid;
  }
}

}  // namespace
}  // namespace warren
