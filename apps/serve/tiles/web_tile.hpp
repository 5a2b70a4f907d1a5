// SPDX-License-Identifier: BSD-3-Clause
// Where tiles lie: squares of 512 pixels, tile (0, 0) of zoom 0 the whole world, each zoom halves a pixel; x to the
// right, y down, while the world's own y goes up.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "pictures/model/colors.hpp"

namespace warren::serve {

struct TilePlace {
  unsigned zoom = 0;
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

struct OnTile;

struct TileGrid {
  static constexpr unsigned pixels = 512;

  Vec2 corner = {};     ///< upper left, of the world's coordinates
  double span = 1.0;    ///< side of the tile of zoom 0
  unsigned levels = 1;  ///< zooms 0 .. levels - 1; <= 24

  /// Side of a pixel.
  double pixel(unsigned zoom) const { return span / (static_cast<double>(pixels) * static_cast<double>(1U << zoom)); }
  Box box_of(const TilePlace& tile) const;
  OnTile on(const TilePlace& tile) const;
  /// The tile whose numbers, in digits, these are; nothing where there is none.
  std::optional<TilePlace> tile_at(std::string_view zoom, std::string_view x, std::string_view y) const;
};

/// From the world to the pixels of a tile, y down.
struct OnTile {
  Box box;
  double pixel;
  Vec2 operator()(Vec2 p) const { return {(p.x - box.min.x) / pixel, (box.max.y - p.y) / pixel}; }
  /// In the world, of the i-th pixel, row by row.
  Vec2 middle_of(std::size_t i) const {
    const Vec2 at{static_cast<double>(i % TileGrid::pixels) + 0.5, static_cast<double>(i / TileGrid::pixels) + 0.5};
    return {box.min.x + at.x * pixel, box.max.y - at.y * pixel};
  }
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

// A tile above the world's that shows a number at each place by the step of a scale in which it lies, an ink a step.

/// Inks of a scale from low to high, by their lightness too, so that they are told apart without colours; all of them
/// dark enough to stand out on the page's white. The page turns them over where it is dark.
inline constexpr std::array<Rgb, 8> step_inks{{{68, 1, 84},
                                               {72, 30, 111},
                                               {69, 56, 130},
                                               {60, 80, 139},
                                               {50, 102, 142},
                                               {41, 122, 142},
                                               {34, 142, 140},
                                               {31, 161, 135}}};
/// The same, and one more behind them.
constexpr std::array<Rgb, step_inks.size() + 1> step_inks_and(Rgb more) {
  std::array<Rgb, step_inks.size() + 1> inks{};
  for (std::size_t step = 0; step < step_inks.size(); ++step) inks[step] = step_inks[step];
  inks.back() = more;
  return inks;
}
/// Of inks that lie above the world's.
inline constexpr std::uint8_t step_opacity = 153;

/// A scale from 0 on whose steps are round numbers.
struct Steps {
  double each = 1.0;
  std::size_t count = 1;  ///< 1 .. step_inks.size(); the last one has no end

  /// So that nearly all values up to `usual` lie before the last step, and `most` in one of them. Both >= 0.
  static Steps up_to(double usual, double most);
  /// value >= 0.
  std::size_t of(double value) const;
};

/// A byte a pixel, 0 at first; row 0 on top.
struct PixelTile {
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(std::size_t{TileGrid::pixels} * TileGrid::pixels, 0);
  std::uint8_t& at(std::size_t x, std::size_t y) { return bytes[y * TileGrid::pixels + x]; }
};

/// A tile as a PNG: of bytes that are 0 for nothing, else 1 + ink * opacities.size() + opacity, the numbers of both. At
/// most 255 of them. Throws Stopped.
std::string png_of_inks(const PixelTile& tile, std::span<const Rgb> inks, std::span<const std::uint8_t> opacities,
                        const Execution& execution);
/// In sixteen shades between paper, 0, and ink, 255: small, and made in about a millisecond. Throws Stopped.
std::string png_of_shades(PixelTile tile, Rgb ink, const Execution& execution);

/// How dark a grid of cells is, seen from afar: level k has a byte for each square of 2^k x 2^k cells, the mean of its
/// four squares of level k - 1. Level 0, the cells themselves, is not held: whoever has them says how dark each is. A
/// third of a byte a cell, made in one pass over them on all threads. Immutable; any number of threads may read. What
/// lies beyond the cells is not dark.
class ShadePyramid {
 public:
  /// shade(x, y) is 0 .. 255. Throws Stopped.
  template <class Shade>
  ShadePyramid(std::uint32_t width, std::uint32_t height, const Shade& shade, const Execution& execution) {
    halve(width, height, shade, execution);
    while (planes_.back().width > 1 || planes_.back().height > 1) {
      const auto below = static_cast<unsigned>(planes_.size());
      const auto shade_below = [&](std::uint32_t x, std::uint32_t y) { return at(below, x, y); };
      halve(planes_.back().width, planes_.back().height, shade_below, execution);
    }
  }

  unsigned levels() const { return static_cast<unsigned>(planes_.size()) + 1; }
  /// level: 1 .. levels() - 1; any x and y.
  std::uint8_t at(unsigned level, std::int64_t x, std::int64_t y) const {
    const Plane& plane = planes_[level - 1];
    if (x < 0 || y < 0 || x >= plane.width || y >= plane.height) return 0;
    return plane.shades[static_cast<std::size_t>(y) * plane.width + static_cast<std::size_t>(x)];
  }

 private:
  struct Plane {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    RawVector<std::uint8_t> shades;
  };
  template <class Shade>
  void halve(std::uint32_t width, std::uint32_t height, const Shade& shade, const Execution& execution) {
    Plane plane{width / 2 + width % 2, height / 2 + height % 2, {}};
    execution.reserve(std::size_t{plane.width} * plane.height);
    plane.shades.resize(std::size_t{plane.width} * plane.height);
    for_each_index(plane.height, 1 + (1U << 18U) / plane.width, execution, [&](std::size_t y) {
      const auto row = static_cast<std::uint32_t>(2 * y);
      const bool above = row + 1 < height;
      for (std::uint32_t x = 0; x < plane.width; ++x) {
        const bool right = 2 * x + 1 < width;
        unsigned sum = shade(2 * x, row) + 2U;
        if (right) sum += shade(2 * x + 1, row);
        if (above) sum += shade(2 * x, row + 1);
        if (right && above) sum += shade(2 * x + 1, row + 1);
        plane.shades[y * plane.width + x] = static_cast<std::uint8_t>(std::min(255U, sum / 4));
      }
    });
    planes_.push_back(std::move(plane));
  }
  std::vector<Plane> planes_;  // level 1 first
};

}  // namespace warren::serve
