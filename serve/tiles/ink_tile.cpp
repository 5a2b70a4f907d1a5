// SPDX-License-Identifier: BSD-3-Clause
#include "serve/tiles/ink_tile.hpp"

#include <array>
#include <cstdint>

#include "scenes/images/png_writer_io.hpp"
#include "serve/tiles/tile_grid.hpp"

namespace warren::serve {
namespace {

constexpr unsigned shades = 15;  // of an ink, beside none

}  // namespace

InkTile::InkTile(std::span<const Rgb> inks, const Execution& execution)
    : inks_(inks), execution_(execution), masks_(inks.size()) {}

Mask& InkTile::of(std::size_t ink) {
  if (!masks_[ink]) masks_[ink].emplace(TileGrid::pixels, TileGrid::pixels, execution_);
  return *masks_[ink];
}

std::string InkTile::png() const {
  std::vector<std::array<std::uint8_t, 3>> palette{{0, 0, 0}};
  std::vector<std::uint8_t> alphas{0};
  for (const Rgb ink : inks_) {
    for (unsigned shade = 1; shade <= shades; ++shade) {
      palette.push_back({ink.red, ink.green, ink.blue});
      alphas.push_back(static_cast<std::uint8_t>(255 * shade / shades));
    }
  }
  std::vector<std::uint8_t> row(TileGrid::pixels);
  const auto row_of = [&](std::size_t y) {
    for (std::size_t x = 0; x < row.size(); ++x) {
      unsigned most = 0;
      row[x] = 0;
      for (std::size_t ink = 0; ink < masks_.size(); ++ink) {
        const unsigned shade = masks_[ink] ? masks_[ink]->pixels()[y * TileGrid::pixels + x] >> 4U : 0;
        if (shade <= most) continue;
        most = shade;
        row[x] = static_cast<std::uint8_t>(shades * ink + shade);
      }
    }
    return static_cast<const std::uint8_t*>(row.data());
  };
  std::string bytes;
  write_png({.width = TileGrid::pixels,
             .height = TileGrid::pixels,
             .palette = palette,
             .alphas = alphas,
             .compression = 1,
             .row = row_of},
            execution_, [&](std::string_view piece) { bytes += piece; });
  return bytes;
}

}  // namespace warren::serve
