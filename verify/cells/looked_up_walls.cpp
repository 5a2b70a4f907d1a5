// SPDX-License-Identifier: BSD-3-Clause
#include "verify/cells/looked_up_walls.hpp"

#include "core/base/whole.hpp"

namespace warren {

class LookedUpWalls::Reader : public CellWallReader {
 public:
  explicit Reader(const LookedUpWalls& walls) : walls_(walls) {}
  void read(std::size_t number, CellTile& tile) override {
    walls_.place(number, tile);
    for (std::ptrdiff_t row = -1; row < std::ptrdiff_t{tile.height}; ++row) {
      for (std::ptrdiff_t col = -1; col < std::ptrdiff_t{tile.width}; ++col) {
        tile.walls[tile.index(col, row)] =
            as_whole<std::uint8_t>(walls_.walls_at(std::ptrdiff_t{tile.first_col} + col, tile.first_row + row));
      }
    }
  }

 private:
  const LookedUpWalls& walls_;
};

std::unique_ptr<CellWallReader> LookedUpWalls::reader() const { return std::make_unique<Reader>(*this); }

}  // namespace warren
