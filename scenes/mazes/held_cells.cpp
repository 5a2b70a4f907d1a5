// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/held_cells.hpp"

#include "parallel/chunks.hpp"

namespace warren {

MazeCells cells_from(const CellWallSource& source, const Execution& execution) {
  constexpr std::size_t grain = 8;  // a reader's scratch is large
  MazeCells cells(source.rows(), source.cols(), execution);
  const std::span<std::uint8_t> bytes = cells.bytes();
  for_chunks(source.tile_count(), grain, execution, [&](Range r) {
    const auto reader = source.reader();
    CellTile tile;
    for (std::size_t number = r.first; number < r.last; ++number) {
      reader->read(number, tile);
      for (std::uint32_t col = 0; col < tile.width; ++col) {
        std::uint8_t* const column = bytes.data() + cells.index(tile.first_col + col, tile.first_row);
        for (std::uint32_t row = 0; row < tile.height; ++row) column[row] = tile.walls[tile.index(col, row)];
      }
    }
  });
  bytes[cells.index(source.cols() - 1, source.rows() - 1)] |= MazeCells::right_wall;  // the exit is no cell's business
  return cells;
}

}  // namespace warren
