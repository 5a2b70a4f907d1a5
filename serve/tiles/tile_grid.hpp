// SPDX-License-Identifier: BSD-3-Clause
// Where tiles lie: squares of 512 pixels, tile (0, 0) of zoom 0 the whole world, each zoom halves a pixel; x to the
// right, y down, while the world's own y goes up.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/base/types.hpp"

namespace warren::serve {

struct TilePlace {
  unsigned zoom = 0;
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

struct TileGrid {
  static constexpr unsigned pixels = 512;

  Vec2 corner = {};     ///< upper left, of the world's coordinates
  double span = 1.0;    ///< side of the tile of zoom 0
  unsigned levels = 1;  ///< zooms 0 .. levels - 1; <= 24

  /// Side of a pixel.
  double pixel(unsigned zoom) const { return span / (static_cast<double>(pixels) * static_cast<double>(1U << zoom)); }
  Box box_of(const TilePlace& tile) const;
  /// The tile whose numbers, in digits, these are; nothing where there is none.
  std::optional<TilePlace> tile_at(std::string_view zoom, std::string_view x, std::string_view y) const;
};

/// Cells of a grid on tiles: a pixel has 2^level cells a side, or a cell 2^-level pixels, so that pixels and cells
/// never lie askew.
struct CellsOnTiles {
  int level = 0;             ///< of zoom 0; below 0 where cells are larger than pixels
  std::uint32_t margin = 1;  ///< cells left of and above the world
};
/// The grid for so many cells of this side whose upper left corner is there, down to 64 pixels a cell.
TileGrid grid_for_cells(std::uint32_t cols, std::uint32_t rows, double cell, Vec2 upper_left, CellsOnTiles& cells);
/// The grid around a box, down to a 2^13th of it a tile.
TileGrid grid_around(const Box& box);

}  // namespace warren::serve
