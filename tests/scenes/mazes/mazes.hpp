// SPDX-License-Identifier: BSD-3-Clause
// Mazes for tests, and what is to be seen of them without the code under test.
#pragma once

#include <cstdint>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "scenes/mazes/maze_generator.hpp"

namespace warren::mazes {

/// Column and row.
using Cell = std::pair<std::uint32_t, std::uint32_t>;
inline constexpr MazeAlgorithm all_algorithms[] = {MazeAlgorithm::backtracker, MazeAlgorithm::kruskal,
                                                   MazeAlgorithm::prim,        MazeAlgorithm::wilson,
                                                   MazeAlgorithm::course,      MazeAlgorithm::mst};

/// Distances in steps from a cell by a plain breadth-first search; -1: not reached.
inline std::vector<int> distances_from(const MazeCells& cells, Cell from) {
  std::vector<int> steps(cells.cell_count(), -1);
  const auto id = [&](Cell c) { return std::size_t{c.first} * cells.rows() + c.second; };
  std::queue<Cell> queue;
  steps[id(from)] = 0;
  queue.push(from);
  while (!queue.empty()) {
    const auto [col, row] = queue.front();
    queue.pop();
    std::vector<Cell> next;
    if (col + 1 < cells.cols() && !cells.wall_right(col, row)) next.emplace_back(col + 1, row);
    if (col > 0 && !cells.wall_right(col - 1, row)) next.emplace_back(col - 1, row);
    if (row + 1 < cells.rows() && !cells.wall_above(col, row)) next.emplace_back(col, row + 1);
    if (row > 0 && !cells.wall_above(col, row - 1)) next.emplace_back(col, row - 1);
    for (const Cell& c : next) {
      if (steps[id(c)] >= 0) continue;
      steps[id(c)] = steps[id({col, row})] + 1;
      queue.push(c);
    }
  }
  return steps;
}

/// How many pairs of neighbours have no wall between them.
inline std::uint64_t openings(const MazeCells& cells) {
  std::uint64_t count = 0;
  for (std::uint32_t col = 0; col < cells.cols(); ++col) {
    for (std::uint32_t row = 0; row < cells.rows(); ++row) {
      if (col + 1 < cells.cols() && !cells.wall_right(col, row)) ++count;
      if (row + 1 < cells.rows() && !cells.wall_above(col, row)) ++count;
    }
  }
  return count;
}

/// Both walls of every cell, a character each.
inline std::string drawing(const MazeCells& cells) {
  std::string text;
  for (std::uint32_t col = 0; col < cells.cols(); ++col) {
    for (std::uint32_t row = 0; row < cells.rows(); ++row) {
      text += static_cast<char>('0' + 2 * cells.wall_above(col, row) + cells.wall_right(col, row));
    }
  }
  return text;
}

inline MazeCells maze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, MazeAlgorithm algorithm,
                      double loops = 0.0) {
  return generate_maze({rows, cols, seed, algorithm, loops}, {});
}

}  // namespace warren::mazes
