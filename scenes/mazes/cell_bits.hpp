// SPDX-License-Identifier: BSD-3-Clause
// The walls of a maze in two bits a cell, a row of cells behind the other from the lowest up, each beginning with a
// byte of its own: cell c of a row has bits 2 (c mod 4) and the next of byte c / 4, lowest bits first; the first says
// that the wall on its right stands, the second that the one above it does. What a .maze file holds
// (docs/file_formats.md). The outline stands but for the doors left of the first cell and right of the last.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "core/plane/cell_walls.hpp"
#include "core/run/execution.hpp"

namespace warren {

/// Bytes of a row of cells.
constexpr std::size_t bytes_a_row(std::uint32_t cols) { return (std::size_t{cols} + 3) / 4; }

/// Writes a tile's cells into rows of bits, of which the first is that of the tile's first row. Tiles of 4 or more
/// cells a side share no bytes.
void pack_tile(const CellTile& tile, std::size_t row_bytes, std::uint8_t* rows);

/// Bits that somebody holds, tile by tile, of all rows or of some. Refers to them.
class CellBits : public CellWallSource {
 public:
  static constexpr unsigned usual_side_log2 = 8;
  /// Called for bytes first .. last - 1 that a reader has looked at and may not look at again.
  using Forget = std::function<void(std::size_t first, std::size_t last)>;

  /// first_row: that of the first bits; no tile is read that needs those of a row below, or above the last that is
  /// held.
  CellBits(std::uint32_t rows, std::uint32_t cols, const std::uint8_t* bits, Forget forget, std::uint32_t first_row = 0)
      : CellWallSource(rows, cols, usual_side_log2), bits_(bits), forget_(std::move(forget)), first_row_(first_row) {}
  std::unique_ptr<CellWallReader> reader() const override;

 private:
  class Reader;
  const std::uint8_t* bits_;
  Forget forget_;
  std::uint32_t first_row_;
};

struct HashedCells {
  std::string hash;       ///< scene_hash() of the walls
  std::size_t walls = 0;  ///< how many they are
};

/// The hash of a maze's world from its cells: that of all its walls in the course's order, of which no more than a
/// strip of columns a thread is made at once. By it whoever has a maze as bits knows that it is the world that it
/// should be. Of the walls that maze_walls() makes, not merged, of the same cells: the outline's are the course's. Some
/// ns a cell. Throws Stopped.
HashedCells hash_of_cells(const CellWallSource& cells, const Execution& execution);

}  // namespace warren
