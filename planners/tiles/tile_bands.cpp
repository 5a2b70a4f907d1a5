// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiles/tile_bands.hpp"

#include <algorithm>

namespace warren {
namespace {

constexpr std::size_t band_bytes = std::size_t{64} << 20;  // smaller bands are not worth their count
constexpr std::uint32_t most_bands_in_order = 16;
constexpr std::uint32_t most_bands = 64;

std::size_t bytes_of_tile(const WallCounts& counts, std::size_t tile, std::size_t wall_bytes) {
  return counts.narrow().of_tile(tile) * sizeof(NarrowWall) + counts.wide().of_tile(tile) * wall_bytes;
}

/// Chunks looked at for all bands together, over the number of chunks.
double passes(const WallCounts& counts, const TileGrid& grid, const TileBands& bands) {
  std::size_t looks = 0;
  std::vector<std::uint8_t> met(bands.count);
  for (std::size_t chunk = 0; chunk < counts.chunks(); ++chunk) {
    std::fill(met.begin(), met.end(), std::uint8_t{0});
    for (std::size_t tile = 0; tile < counts.tiles(); ++tile) {
      if (counts.has(chunk, tile)) met[bands.of(grid, tile)] = 1;
    }
    looks += static_cast<std::size_t>(std::count(met.begin(), met.end(), 1));
  }
  return static_cast<double>(looks) / static_cast<double>(counts.chunks());
}

/// So many that a band takes half of what is left.
std::uint32_t bands_by_memory(std::size_t bytes, const Execution& execution) {
  if (execution.deadline == nullptr) return 1;
  const std::size_t limit = execution.deadline->memory_bytes();
  const std::size_t held = resident_bytes();
  const std::size_t left = limit > held ? (limit - held) / 2 : 0;
  if (bytes <= left) return 1;
  return static_cast<std::uint32_t>(std::min<std::size_t>(most_bands, bytes / std::max(left, band_bytes) + 1));
}

}  // namespace

std::vector<std::size_t> TileBands::tiles(const TileGrid& grid, std::uint32_t band) const {
  std::vector<std::size_t> tiles;
  for (std::size_t tile = 0; tile < grid.count(); ++tile) {
    if (of(grid, tile) == band) tiles.push_back(tile);
  }
  return tiles;
}

TileBands choose_bands(const WallCounts& counts, const TileGrid& grid, std::size_t wall_bytes,
                       const Execution& execution) {
  std::size_t bytes = 0;
  for (std::size_t tile = 0; tile < counts.tiles(); ++tile) bytes += bytes_of_tile(counts, tile, wall_bytes);
  if (bytes <= band_bytes) return {};
  const auto bands = [&](bool by_rows, std::size_t count) {
    return TileBands{
        static_cast<std::uint32_t>(std::min<std::size_t>(by_rows ? grid.tile_rows : grid.tile_cols, count)), by_rows};
  };
  constexpr double about_one_pass = 1.5;
  const std::size_t in_order = std::min<std::size_t>(most_bands_in_order, bytes / band_bytes + 1);
  for (const bool by_rows : {false, true}) {
    const TileBands some = bands(by_rows, in_order);
    if (passes(counts, grid, some) < about_one_pass) return some;
  }
  return bands(grid.tile_rows > grid.tile_cols, bands_by_memory(bytes, execution));
}

}  // namespace warren
