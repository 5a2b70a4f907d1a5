// SPDX-License-Identifier: BSD-3-Clause
#include "serve/tiles/step_tile.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "scenes/images/png_writer_io.hpp"

namespace warren::serve {
namespace {

/// The least of 1, 2, 2.5 and 5 times a power of ten that is not below.
double round_number_from(double least) {
  double times_ten = 1.0;
  while (least >= 10.0 * times_ten) times_ten *= 10.0;
  double parts = 1.0;
  while (least * parts < 1.0) parts *= 10.0;
  const double power = least < 1.0 ? 1.0 / parts : times_ten;
  for (const double times : {1.0, 2.0, 2.5, 5.0}) {
    if (times * power >= least) return times * power;
  }
  return 10.0 * power;
}

}  // namespace

Steps Steps::up_to(double usual, double most) {
  constexpr double with_an_end = step_inks.size() - 1.0;
  Steps steps;
  constexpr double smallest = 1e-300;  // the product of which and a power of ten is 1
  if (std::isfinite(usual) && usual >= smallest) steps.each = round_number_from(usual / with_an_end);
  steps.count = 1 + static_cast<std::size_t>(std::clamp(most / steps.each, 0.0, with_an_end));
  return steps;
}

std::size_t Steps::of(double value) const {
  return static_cast<std::size_t>(std::min(value / each, static_cast<double>(count - 1)));
}

std::string png_of(const StepTile& tile, std::span<const Rgb> inks, const Execution& execution) {
  std::vector<std::array<std::uint8_t, 3>> palette{{0, 0, 0}};
  std::vector<std::uint8_t> alphas{0};
  for (const Rgb ink : inks) {
    palette.push_back({ink.red, ink.green, ink.blue});
    alphas.push_back(step_opacity);
  }
  std::string bytes;
  write_png({.width = TileGrid::pixels,
             .height = TileGrid::pixels,
             .palette = palette,
             .alphas = alphas,
             .compression = 1,
             .row = [&](std::size_t y) { return tile.steps.data() + y * TileGrid::pixels; }},
            execution, [&](std::string_view piece) { bytes += piece; });
  return bytes;
}

}  // namespace warren::serve
