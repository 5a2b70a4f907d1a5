// SPDX-License-Identifier: BSD-3-Clause
// Three bits a cell, laid out so that a tile of 64 x 64 cells is 24 lines of cache: is the cell in the core, and if it
// isn't, which way its root is; if it is, where the chains of the reduced core that it lies on go on
// (planners/lengths/core_graph.hpp): to the right, upwards. To the left and downwards the neighbours know.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "planners/lengths/lattice_passages.hpp"

namespace warren {

using LatticePlace = std::uint32_t;

/// Where a cell lies in the index: cells are numbered tile by tile, 64 x 64 cells a tile, row by row in it, so that
/// what is near in the plane is near in memory. A place is tile * 4096 + row in the tile * 64 + column in the tile; the
/// lattice is filled up to whole tiles with cells that have no passages. Directions are 0 right, 1 up, 2 left, 3 down;
/// the opposite of d is d ^ 2.
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
  /// The cell so far along the side of a tile that a motion in this direction leaves.
  static LatticePlace on_side(std::uint32_t tile, unsigned direction, unsigned along) {
    constexpr std::array<LatticePlace, 4> corner{side - 1, (side - 1) * side, 0, 0};
    return tile * tile_places + corner[direction] + along * ((direction & 1U) == 0 ? side : 1U);
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

/// Words of row r of the lattice of tiles (a tile has 64): three each.
namespace mark_word {
inline constexpr std::size_t low = 0;   ///< lower bit of the direction; in the core: a chain goes on to the right
inline constexpr std::size_t high = 1;  ///< upper bit of the direction; in the core: a chain goes on upwards
inline constexpr std::size_t core = 2;
inline constexpr std::size_t count = 3;

/// Both bits that a cell has beside `core`, of its row's words.
inline unsigned low_and_high(const std::uint64_t* row, unsigned col) {
  return static_cast<unsigned>(row[low] >> col & 1U) | static_cast<unsigned>(row[high] >> col & 1U) << 1;
}
}  // namespace mark_word

/// Looks at the words; any number of threads may.
class CellMarks {
 public:
  explicit CellMarks(const std::uint64_t* words) : words_(words) {}

  bool is_core(LatticePlace p) const { return (row_of(p)[mark_word::core] >> p % 64 & 1U) != 0; }
  /// Of a cell outside the core.
  unsigned direction(LatticePlace p) const { return mark_word::low_and_high(row_of(p), p % 64); }

  /// The words of a tile, row by row.
  const std::uint64_t* tile(std::uint32_t number) const {
    return words_ + std::size_t{number} * LatticePlaces::side * mark_word::count;
  }
  void prefetch_tile(std::uint32_t number) const {
    constexpr std::size_t line = 8;  // words
    const std::uint64_t* const words = tile(number);
    for (std::size_t i = 0; i < LatticePlaces::side * mark_word::count; i += line) __builtin_prefetch(words + i);
  }

 private:
  const std::uint64_t* row_of(LatticePlace p) const { return words_ + std::size_t{p / 64} * mark_word::count; }

  const std::uint64_t* words_;
};

/// Cells of a tile as walks hold them: column in bits 0 to 5, row in bits 7 to 12. So a motion over the border sets a
/// bit between or above.
struct WalkedCells {
  static constexpr std::uint32_t col_bits = 63;
  static constexpr unsigned row_shift = 7;
  static constexpr std::uint32_t guards = ~(col_bits | col_bits << row_shift);
  static_assert(LatticePlaces::side == col_bits + 1);

  static std::uint32_t at(LatticePlace p) {
    const std::uint32_t in_tile = p % LatticePlaces::tile_places;
    return in_tile >> 6U << row_shift | (in_tile & col_bits);
  }
  static LatticePlace in_tile(std::uint32_t at) { return (at >> row_shift) << 6U | (at & col_bits); }
};

/// A climb towards the core, step by step, within one tile. A step waits for the marks that the one before it led to,
/// some fifteen cycles, and for nothing else: no branch depends on where the way turns. Looks at the marks of one tile.
class TileClimb : WalkedCells {
 public:
  TileClimb(CellMarks marks, LatticePlace from)
      : first_(from - from % LatticePlaces::tile_places),
        words_(marks.tile(LatticePlaces::tile_of(from))),
        at_(at(from)) {}

  /// False where the way ends: at the core, or where it would leave the tile.
  bool step() {
    if (at_core()) return false;
    const std::uint32_t next = at_ + motion();
    if ((next & guards) != 0) return false;
    at_ = next;
    return true;
  }
  LatticePlace place() const { return first_ + in_tile(at_); }
  bool at_core() const { return mark(mark_word::core) != 0; }

 private:
  std::uint32_t mark(std::size_t word) const {
    const std::uint64_t* const row = words_ + std::size_t{at_ >> row_shift} * mark_word::count;
    return static_cast<std::uint32_t>(row[word] >> (at_ & col_bits)) & 1U;
  }
  /// Right 1, up 128, left -1, down -128.
  std::uint32_t motion() const { return (1U - 2U * mark(mark_word::high)) << (row_shift * mark(mark_word::low)); }

  LatticePlace first_;
  const std::uint64_t* words_;
  std::uint32_t at_;
};

}  // namespace warren
