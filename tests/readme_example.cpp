// SPDX-License-Identifier: BSD-3-Clause
#include "planners/roadmap/prm.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "verify/judges/verify_point.hpp"
#include "worlds/plane/maze_world.hpp"

int main() {
  const warren::Scene maze = warren::maze_scene({.rows = 21, .cols = 31, .seed = 7}, true, {});
  const warren::Vec2 start{0.5, 1.0}, goal{31.5, 21.0};
  const warren::MazeWorld world(maze, 0.1, {});  // a disc of radius 0.1 among the maze's walls
  const auto answer = warren::prm(world, start, goal, {}, {});
  const auto judged = warren::verify_path(maze, answer.path, {.clearance = 0.1, .start = start, .goal = goal}, {});
  return judged.verified ? 0 : 1;
}
