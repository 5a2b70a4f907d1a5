// SPDX-License-Identifier: BSD-3-Clause
// A maze that is held, given tile by tile: what makes every maze of the generators a world whose walls are made when
// they are asked for. And the way back.
#pragma once

#include <memory>
#include <utility>

#include "core/plane/cell_walls.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren {

class HeldCells : public CellWallSource {
 public:
  HeldCells(MazeCells cells, unsigned side_log2)
      : CellWallSource(cells.rows(), cells.cols(), side_log2), cells_(std::move(cells)) {}
  std::unique_ptr<CellWallReader> reader() const override { return std::make_unique<Reader>(*this); }

 private:
  class Reader : public CellWallReader {
   public:
    explicit Reader(const HeldCells& held) : held_(held) {}
    void read(std::size_t number, CellTile& tile) override {
      held_.place(number, tile);
      for (std::ptrdiff_t row = -1; row < std::ptrdiff_t{tile.height}; ++row) {
        for (std::ptrdiff_t col = -1; col < std::ptrdiff_t{tile.width}; ++col) {
          const std::ptrdiff_t at_col = std::ptrdiff_t{tile.first_col} + col;
          const std::ptrdiff_t at_row = std::ptrdiff_t{tile.first_row} + row;
          tile.walls[tile.index(col, row)] = walls(at_col, at_row);
        }
      }
    }

   private:
    /// The outline opens left of the first cell and right of the last.
    std::uint8_t walls(std::ptrdiff_t col, std::ptrdiff_t row) const {
      const MazeCells& cells = held_.cells_;
      if (col < 0) return row == 0 ? 0 : CellTile::right_wall;
      if (row < 0) return CellTile::upper_wall;
      const auto c = static_cast<std::uint32_t>(col);
      const auto r = static_cast<std::uint32_t>(row);
      const bool is_last = c + 1 == cells.cols() && r + 1 == cells.rows();
      const bool right = cells.wall_right(c, r) && !is_last;
      return static_cast<std::uint8_t>((right ? 1 : 0) | (cells.wall_above(c, r) ? 2 : 0));
    }
    const HeldCells& held_;
  };

  MazeCells cells_;
};

/// All cells of a source. Throws InputError for 2^32 cells and more, Stopped.
MazeCells cells_from(const CellWallSource& source, const Execution& execution);

}  // namespace warren
