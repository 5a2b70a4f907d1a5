// SPDX-License-Identifier: BSD-3-Clause
// Where a cell lies in the index: cells are numbered tile by tile, 64 x 64 cells a tile, row by row in it, so that what
// is near in the plane is near in memory. A place is tile * 4096 + row in the tile * 64 + column in the tile; the
// lattice is filled up to whole tiles with cells that have no passages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "planners/route_trees/lattice_passages.hpp"

namespace warren {

using LatticePlace = std::uint32_t;
inline constexpr LatticePlace no_place = ~LatticePlace{0};

/// Directions are 0 right, 1 up, 2 left, 3 down; the opposite of d is d ^ 2.
class LatticePlaces {
 public:
  static constexpr unsigned side = 64;
  static constexpr unsigned tile_places = side * side;

  explicit LatticePlaces(LatticeSize size)
      : size_(size),
        tile_cols_(static_cast<std::uint32_t>(LatticePassages::words_a_row(size.cols))),
        tile_rows_(static_cast<std::uint32_t>(LatticePassages::words_a_row(size.rows))),
        inner_{1, side, ~LatticePlace{0}, ~LatticePlace{side} + 1},
        over_{tile_places - (side - 1), tile_cols_ * tile_places - (side - 1) * side,
              ~LatticePlace{tile_places - (side - 1)} + 1,
              ~LatticePlace{tile_cols_ * tile_places - (side - 1) * side} + 1} {}

  LatticeSize size() const { return size_; }
  std::uint32_t tile_cols() const { return tile_cols_; }
  std::uint32_t tile_rows() const { return tile_rows_; }
  std::size_t tile_count() const { return std::size_t{tile_cols_} * tile_rows_; }
  std::size_t place_count() const { return tile_count() * tile_places; }

  LatticePlace place(std::uint32_t col, std::uint32_t row) const {
    return (row / side * tile_cols_ + col / side) * tile_places + row % side * side + col % side;
  }
  LatticePlace place_of(CellId cell) const { return place(cell % size_.cols, cell / size_.cols); }
  std::uint32_t col(LatticePlace p) const { return tile_of(p) % tile_cols_ * side + p % side; }
  std::uint32_t row(LatticePlace p) const { return tile_of(p) / tile_cols_ * side + p / side % side; }
  CellId cell_of(LatticePlace p) const { return row(p) * size_.cols + col(p); }

  static std::uint32_t tile_of(LatticePlace p) { return p / tile_places; }
  /// Does the motion lead to another tile?
  static bool leaves_tile(LatticePlace p, unsigned direction) {
    const unsigned along = (direction & 1U) == 0 ? p % side : p / side % side;
    return along == (direction < 2 ? side - 1 : 0);
  }
  /// How far along its tile's side a cell is that a motion in this direction leaves.
  static unsigned along_side(LatticePlace p, unsigned direction) {
    return (direction & 1U) == 0 ? p / side % side : p % side;
  }
  /// The neighbour, which must be in the lattice.
  LatticePlace step(LatticePlace p, unsigned direction) const {
    return p + (leaves_tile(p, direction) ? over_[direction] : inner_[direction]);
  }
  /// The neighbour in the same tile.
  LatticePlace step_inside(LatticePlace p, unsigned direction) const { return p + inner_[direction]; }

 private:
  LatticeSize size_;
  std::uint32_t tile_cols_;
  std::uint32_t tile_rows_;
  std::array<LatticePlace, 4> inner_;  // what a motion adds to a place, modulo 2^32: inside a tile
  std::array<LatticePlace, 4> over_;   // and over its border
};

}  // namespace warren
