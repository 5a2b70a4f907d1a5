// SPDX-License-Identifier: BSD-3-Clause
#include "serve/tiles/shade_png.hpp"

#include "scenes/images/png_writer_io.hpp"

namespace warren::serve {

std::string png_of(const ShadeTile& tile, Rgb ink, const Execution& execution) {
  constexpr unsigned shades = 16;
  std::vector<std::array<std::uint8_t, 3>> palette;
  for (unsigned i = 0; i < shades; ++i) {
    const Rgb color = mixed(ink, colors::paper, 100 * i / (shades - 1));
    palette.push_back({color.red, color.green, color.blue});
  }
  std::vector<std::uint8_t> row(TileGrid::pixels);
  std::string bytes;
  write_png({.width = TileGrid::pixels,
             .height = TileGrid::pixels,
             .palette = palette,
             .compression = 1,
             .row =
                 [&](std::size_t y) {
                   const std::uint8_t* from = tile.shades.data() + y * TileGrid::pixels;
                   for (std::size_t x = 0; x < row.size(); ++x) row[x] = static_cast<std::uint8_t>(from[x] >> 4U);
                   return static_cast<const std::uint8_t*>(row.data());
                 }},
            execution, [&](std::string_view piece) { bytes += piece; });
  return bytes;
}

}  // namespace warren::serve
