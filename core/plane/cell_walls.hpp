// SPDX-License-Identifier: BSD-3-Clause
// A world of walls on the sides of unit cells that need not be held: whoever gives it makes the walls of any tile by
// itself, when asked, as often as asked. Cell (col, row), from 0, is the unit square around (col + 1, row + 1); tiles
// are squares of 2^side_log2 cells, numbered row by row from below, narrower at the right and upper rim.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"

namespace warren {

/// The walls of one tile: a byte a cell, and of the cells left of and below it.
struct CellTile {
  static constexpr std::uint8_t right_wall = 1;
  static constexpr std::uint8_t upper_wall = 2;

  std::uint32_t first_col = 0, first_row = 0, width = 0, height = 0;
  /// Of column -1 and row -1 only the sides that the tile's cells share mean something.
  std::vector<std::uint8_t> walls;

  /// Of cell (col, row) of the tile, each from -1.
  std::size_t index(std::ptrdiff_t col, std::ptrdiff_t row) const {
    return static_cast<std::size_t>((row + 1) * (std::ptrdiff_t{width} + 1) + col + 1);
  }
};

/// Makes tiles; belongs to one thread.
class CellWallReader : NotCopied {
 public:
  virtual ~CellWallReader() = default;
  /// Fills in the tile of this number, below CellWallSource::tile_count().
  virtual void read(std::size_t number, CellTile& tile) = 0;
};

/// Immutable; any number of readers may be at work.
class CellWallSource : NotCopied {
 public:
  /// rows, cols: 1 .. 2^31 - 1; side_log2: 0 .. 8.
  CellWallSource(std::uint32_t rows, std::uint32_t cols, unsigned side_log2)
      : rows_(rows), cols_(cols), side_log2_(side_log2), tile_cols_(((cols - 1) >> side_log2) + 1) {}
  virtual ~CellWallSource() = default;
  virtual std::unique_ptr<CellWallReader> reader() const = 0;

  std::uint32_t rows() const { return rows_; }
  std::uint32_t cols() const { return cols_; }
  unsigned side_log2() const { return side_log2_; }
  std::size_t tile_count() const { return tile_cols_ * (((rows_ - 1) >> side_log2_) + std::size_t{1}); }
  std::size_t tile_cols() const { return tile_cols_; }
  std::size_t tile_of(std::uint32_t col, std::uint32_t row) const {
    return (row >> side_log2_) * tile_cols_ + (col >> side_log2_);
  }
  /// Of all walls.
  Box box() const { return {{0.5, 0.5}, {cols_ + 0.5, rows_ + 0.5}}; }

 protected:
  /// Sets where the tile lies, with all walls standing.
  void place(std::size_t number, CellTile& tile) const {
    tile.first_col = static_cast<std::uint32_t>(number % tile_cols_) << side_log2_;
    tile.first_row = static_cast<std::uint32_t>(number / tile_cols_) << side_log2_;
    tile.width = std::min(1U << side_log2_, cols_ - tile.first_col);
    tile.height = std::min(1U << side_log2_, rows_ - tile.first_row);
    tile.walls.assign((std::size_t{tile.width} + 1) * (std::size_t{tile.height} + 1),
                      CellTile::right_wall | CellTile::upper_wall);
  }

 private:
  std::uint32_t rows_;
  std::uint32_t cols_;
  unsigned side_log2_;
  std::size_t tile_cols_;
};

/// The plane cut into unit cells around whole numbers, as mazes are, and which of their sides a motion may cross. Cells
/// row by row from below. No motion of a free body passes from a cell to its neighbour but over a side that is open at
/// both; a side may be open that no motion crosses. Of points that keep off all walls cell_of() is exact.
struct CellSides {
  static constexpr std::uint8_t right = 1, up = 2, left = 4, down = 8, all = 15;

  Vec2 corner;  ///< lower left corner of cell 0: whole numbers and a half
  std::uint32_t cols = 0;
  std::uint32_t rows = 0;
  RawVector<std::uint8_t> open;  ///< a bit a side; empty: nothing is known

  std::size_t cell_of(Vec2 p) const {
    return std::size_t{place(p.y - corner.y, rows)} * cols + place(p.x - corner.x, cols);
  }
  /// The cell on the other side, which is not the rim's.
  std::size_t beyond(std::size_t cell, std::uint8_t side) const {
    return side == right ? cell + 1 : side == left ? cell - 1 : side == up ? cell + cols : cell - cols;
  }
  static constexpr std::uint8_t opposite(std::uint8_t side) {
    return static_cast<std::uint8_t>(side <= up ? side << 2 : side >> 2);
  }
  Box box_of_cell(std::size_t cell) const {
    const Vec2 low = corner + Vec2{static_cast<double>(cell % cols), static_cast<double>(cell / cols)};
    return {low, low + Vec2{1.0, 1.0}};
  }
  /// Between the cell and what lies beyond.
  Segment side_of_cell(std::size_t cell, std::uint8_t side) const {
    const Box box = box_of_cell(cell);
    if (side == right) return {{box.max.x, box.min.y}, box.max};
    if (side == left) return {box.min, {box.min.x, box.max.y}};
    if (side == up) return {{box.min.x, box.max.y}, box.max};
    return {box.min, {box.max.x, box.min.y}};
  }

 private:
  static std::uint32_t place(double offset, std::uint32_t count) {
    return std::min(static_cast<std::uint32_t>(std::max(offset, 0.0)), count - 1);
  }
};

}  // namespace warren
