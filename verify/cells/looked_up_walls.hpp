// SPDX-License-Identifier: BSD-3-Clause
// Walls of a maze that can be looked up one by one as cheaply as tile by tile, say in bits: whoever asks for those near
// a path pays for the path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/plane/cell_walls.hpp"

namespace warren {

class LookedUpWalls : public CellWallSource {
 public:
  static constexpr unsigned usual_side_log2 = 6;  ///< of tiles: what a leg beside the lattice looks at
  using CellWallSource::CellWallSource;
  /// Bits of CellTile: which walls of a cell stand. Columns from -1 to cols() - 1, rows likewise; of column -1 the
  /// right walls alone mean something, of row -1 the upper ones.
  virtual unsigned walls_at(std::ptrdiff_t col, std::ptrdiff_t row) const = 0;
  std::unique_ptr<CellWallReader> reader() const override;

 private:
  class Reader;
};

}  // namespace warren
