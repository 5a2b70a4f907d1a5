// SPDX-License-Identifier: BSD-3-Clause
// Mazes as lattice passages, and the oracle of route indices: a plain breadth-first search of the whole lattice.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/lengths/core_graph.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren::test {

inline void open_right(PassageWords& words, LatticeSize size, std::uint32_t col, std::uint32_t row) {
  words.right[row * LatticePassages::words_a_row(size.cols) + col / 64] |= std::uint64_t{1} << col % 64;
}
inline void open_up(PassageWords& words, LatticeSize size, std::uint32_t col, std::uint32_t row) {
  words.up[row * LatticePassages::words_a_row(size.cols) + col / 64] |= std::uint64_t{1} << col % 64;
}

/// The maze's passages; blocked(col, row) cells have none.
template <class Blocked>
LatticePassages maze_passages(const MazeOptions& options, const Blocked& blocked) {
  const MazeCells cells = generate_maze(options, {});
  const LatticeSize size{options.rows, options.cols};
  PassageWords words = LatticePassages::closed(size, {});
  for (std::uint32_t row = 0; row < size.rows; ++row) {
    for (std::uint32_t col = 0; col < size.cols; ++col) {
      if (blocked(col, row)) continue;
      if (col + 1 < size.cols && !cells.wall_right(col, row) && !blocked(col + 1, row)) {
        open_right(words, size, col, row);
      }
      if (row + 1 < size.rows && !cells.wall_above(col, row) && !blocked(col, row + 1)) open_up(words, size, col, row);
    }
  }
  return {size, std::move(words)};
}
inline LatticePassages maze_passages(const MazeOptions& options) {
  return maze_passages(options, [](std::uint32_t, std::uint32_t) { return false; });
}

inline constexpr std::uint32_t not_reached = ~std::uint32_t{0};

/// Steps from a cell to all others.
inline std::vector<std::uint32_t> flood_lengths(const LatticePassages& passages, CellId start) {
  std::vector<std::uint32_t> steps(passages.cell_count(), not_reached);
  std::vector<CellId> queue{start};
  steps[start] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    passages.for_each_neighbour(queue[i], [&](CellId next) {
      if (steps[next] != not_reached) return;
      steps[next] = steps[queue[i]] + 1;
      queue.push_back(next);
    });
  }
  return steps;
}

}  // namespace warren::test
