// SPDX-License-Identifier: BSD-3-Clause
// A tile above the world's that shows a number at each place by the step of a scale in which it lies, an ink a step.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "pictures/model/colors.hpp"
#include "serve/tiles/tile_grid.hpp"

namespace warren::serve {

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

/// A byte a pixel: 0 nothing, else one more than the number of its ink. Row 0 on top.
struct StepTile {
  std::vector<std::uint8_t> steps = std::vector<std::uint8_t>(std::size_t{TileGrid::pixels} * TileGrid::pixels, 0);
  std::uint8_t& at(std::size_t x, std::size_t y) { return steps[y * TileGrid::pixels + x]; }
};

/// At most 255 inks. Throws Stopped.
std::string png_of(const StepTile& tile, std::span<const Rgb> inks, const Execution& execution);

}  // namespace warren::serve
