// SPDX-License-Identifier: BSD-3-Clause
#include "solve/mazes/maze_infeasible.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenes/mazes/maze_generator.hpp"

namespace warren {
namespace {

/// Zero-based {col, row} of a cell whose closed square holds p, a point of the maze's box. On a side between two cells
/// either will do: p is free, so the side is open.
std::pair<std::uint32_t, std::uint32_t> cell_of(Vec2 p, MazeHint maze) {
  const auto at = [](double x, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(x - 0.5), 0.0, static_cast<double>(count - 1)));
  };
  return {at(p.x, maze.cols), at(p.y, maze.rows)};
}

bool holds(const Box& outer, const Box& inner) { return outer.contains(inner.min) && outer.contains(inner.max); }

}  // namespace

bool proves_infeasible(const Scene& scene, Vec2 start, Vec2 goal, const Execution& execution) {
  const MazeHint maze = *scene.maze;
  const Box box{{0.5, 0.5}, {maze.cols + 0.5, maze.rows + 0.5}};
  if (!box.contains(start) || !box.contains(goal)) return false;
  if (scene.bounds && !holds(box, *scene.bounds)) return false;
  const MazeCells cells = cells_of_walls(scene.walls, maze, execution);
  return !flood_connects(cells, cell_of(start, maze), cell_of(goal, maze), execution);
}

}  // namespace warren
