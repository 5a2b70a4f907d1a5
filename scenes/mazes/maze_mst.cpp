// SPDX-License-Identifier: BSD-3-Clause
// The algorithm mst into cells that are held: tile by tile, in parallel. Kruskal's maze with a hash as the shuffle, so
// it looks as that of kruskal. 15 ns a cell on two cores.
#include "parallel/chunks.hpp"
#include "scenes/mazes/grid_edges.hpp"
#include "scenes/mazes/maze_carving.hpp"
#include "scenes/mazes/spanning_maze.hpp"

namespace warren::maze {

void carve_mst(MazeCells& cells, std::uint64_t seed, const Execution& execution) {
  const SpanningMaze maze(cells.rows(), cells.cols(), seed, 0.0, {execution.threads, execution.deadline});
  const auto open = [&](const CellTile& tile) {
    for (std::uint32_t col = 0; col < tile.width; ++col) {
      for (std::uint32_t row = 0; row < tile.height; ++row) {
        const unsigned walls = tile.walls[tile.index(col, row)];
        const std::uint32_t at_col = tile.first_col + col;
        const std::uint32_t at_row = tile.first_row + row;
        if ((walls & CellTile::right_wall) == 0 && at_col + 1 < cells.cols()) cells.open_right(at_col, at_row);
        if ((walls & CellTile::upper_wall) == 0) cells.open_above(at_col, at_row);
      }
    }
  };
  for_chunks(maze.tile_count(), 16, {execution.threads, execution.deadline}, [&](Range r) {
    const auto reader = maze.reader();
    CellTile tile;
    for (std::size_t t = r.first; t < r.last; ++t) {
      reader->read(t, tile);
      open(tile);
      execution.advance(std::uint64_t{tile.width} * tile.height);
      execution.check();
    }
  });
}

void open_drawn_loops(MazeCells& cells, double loops, std::uint64_t seed, const Execution& execution) {
  const EdgeWeights weights(seed);
  const LoopDraw falls(loops);
  for_chunks(cells.cols(), 16, execution, [&](Range r) {
    for (std::size_t c = r.first; c < r.last; ++c) {
      const auto col = static_cast<std::uint32_t>(c);
      for (std::uint32_t row = 0; row < cells.rows(); ++row) {
        if ((row & 0xffffU) == 0) execution.check();
        const auto falls_at = [&](unsigned direction) { return falls(weights(edge_number(col, row, direction))); };
        if (col + 1 < cells.cols() && cells.wall_right(col, row) && falls_at(0)) cells.open_right(col, row);
        if (row + 1 < cells.rows() && cells.wall_above(col, row) && falls_at(1)) cells.open_above(col, row);
      }
    }
  });
}

}  // namespace warren::maze
