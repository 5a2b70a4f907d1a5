// SPDX-License-Identifier: BSD-3-Clause
// Oracles: the independent verifier says that the path is one, and taut_path, which works on any walls and knows no
// cells, that it can't be shorter.
#include "apps/studies/largest_maze.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "planners/shorten/taut_path.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "spatial/obstacles/wall_index.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren::studies {
namespace {

double length_of(std::span<const Vec2> path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance(path[i - 1], path[i]);
  return length;
}

/// The way through the centres of the cells of a maze without loops: the depth-first walk has no choice.
std::vector<Vec2> centre_path(const MazeCells& cells) {
  struct Step {
    std::uint32_t col, row;
    int next = 0;
  };
  std::vector<Step> walk{{0, 0}};
  std::vector<bool> seen(cells.cell_count(), false);
  seen[0] = true;
  while (walk.back().col + 1 != cells.cols() || walk.back().row + 1 != cells.rows()) {
    Step& at = walk.back();
    if (at.next == 4) {
      walk.pop_back();
      continue;
    }
    const int d = at.next++;
    const bool open = d == 0   ? !cells.wall_right(at.col, at.row)
                      : d == 1 ? !cells.wall_above(at.col, at.row)
                      : d == 2 ? at.col > 0 && !cells.wall_right(at.col - 1, at.row)
                               : at.row > 0 && !cells.wall_above(at.col, at.row - 1);
    if (!open) continue;
    const Step to{at.col + (d == 0 ? 1 : 0) - (d == 2 ? 1 : 0), at.row + (d == 1 ? 1 : 0) - (d == 3 ? 1 : 0)};
    const std::size_t number = std::size_t{to.col} * cells.rows() + to.row;
    if (seen[number]) continue;
    seen[number] = true;
    walk.push_back(to);
  }
  std::vector<Vec2> path{{0.5, 1.0}};
  for (const Step& s : walk) path.push_back({s.col + 1.0, s.row + 1.0});
  path.push_back({cells.cols() + 0.5, static_cast<double>(cells.rows())});
  return path;
}

TEST(BfsFunnel, GivesTheShortestPathOfAMazeWithoutLoops) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const auto rows = static_cast<std::uint32_t>(2 + seed % 11);
    const auto cols = static_cast<std::uint32_t>(2 + seed * 7 % 13);
    const MazeOptions options{.rows = rows, .cols = cols, .seed = seed};
    const Scene scene = maze_scene(options, seed % 2 == 0, Execution{});
    const Path<Vec2> path = bfs_funnel(scene, Execution{});
    const VerifyOptions verify{.clearance = 0.0,
                               .contact = Contact::allowed,
                               .start = Vec2{0.5, 1.0},
                               .goal = Vec2{cols + 0.5, static_cast<double>(rows)}};
    EXPECT_TRUE(verify_path(scene, path, verify, Execution{}).verified);
    const WallIndex walls(scene.walls, Execution{});
    const auto taut = taut_path(walls, centre_path(generate_maze(options, Execution{})), 0.0, Execution{});
    EXPECT_NEAR(length_of(path), length_of(taut), 1e-3);
    EXPECT_LE(length_of(path), length_of(taut) + 1e-9);
  }
}

TEST(BfsFunnel, FindsAWayThroughLoops) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = maze_scene({.rows = 12, .cols = 9, .seed = seed, .loops = 0.3}, false, Execution{});
    const VerifyOptions verify{
        .clearance = 0.0, .contact = Contact::allowed, .start = Vec2{0.5, 1.0}, .goal = Vec2{9.5, 12.0}};
    EXPECT_TRUE(verify_path(scene, bfs_funnel(scene, Execution{}), verify, Execution{}).verified);
  }
}

TEST(BfsFunnel, ACorridorIsWalkedInAStraightLine) {
  const Scene scene = maze_scene({.rows = 1, .cols = 7}, false, Execution{});
  EXPECT_DOUBLE_EQ(length_of(bfs_funnel(scene, Execution{})), 7.0);
}

TEST(BfsFunnel, AWallAcrossLeavesNoPath) {
  std::vector<Segment> walls;
  const Scene open = maze_scene({.rows = 6, .cols = 6, .loops = 1.0}, false, Execution{});
  for (std::size_t i = 0; i < open.walls.size(); ++i) walls.push_back(open.walls.segment(i));
  walls.push_back({{3.5, 0.5}, {3.5, 6.5}});
  Scene scene = open;
  scene.walls = WallSet::narrowest(walls);
  EXPECT_TRUE(bfs_funnel(scene, Execution{}).empty());
}

}  // namespace
}  // namespace warren::studies
