// SPDX-License-Identifier: BSD-3-Clause
// A tile in sixteen shades between paper and ink as a small PNG, made in about a millisecond.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "pictures/model/colors.hpp"
#include "serve/tiles/tile_grid.hpp"

namespace warren::serve {

/// A byte a pixel: 0 paper, 255 ink; row 0 on top.
struct ShadeTile {
  std::vector<std::uint8_t> shades = std::vector<std::uint8_t>(std::size_t{TileGrid::pixels} * TileGrid::pixels, 0);
  std::uint8_t& at(std::size_t x, std::size_t y) { return shades[y * TileGrid::pixels + x]; }
};

/// Throws Stopped.
std::string png_of(const ShadeTile& tile, Rgb ink, const Execution& execution);

}  // namespace warren::serve
