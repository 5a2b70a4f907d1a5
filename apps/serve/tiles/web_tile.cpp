// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/tiles/web_tile.hpp"

#include <cmath>
#include <utility>

#include "scenes/files/image_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren::serve {
namespace {

constexpr int closest = -6;  // 64 pixels a cell

std::optional<std::uint32_t> number_below(std::uint32_t end, std::string_view digits) {
  const auto number = scene_text::number_in_full<std::uint32_t>(digits);
  const bool is_plain = digits == "0" || !digits.starts_with('0');  // one name a tile
  return is_plain && number && *number < end ? number : std::nullopt;
}

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

using PngColors = std::vector<std::array<std::uint8_t, 3>>;

std::string png_of(const PixelTile& tile, PngColors palette, std::vector<std::uint8_t> alphas,
                   const Execution& execution) {
  std::string bytes;
  write_png({.width = TileGrid::pixels,
             .height = TileGrid::pixels,
             .palette = std::move(palette),
             .alphas = std::move(alphas),
             .compression = 1,
             .row = [&](std::size_t y) { return tile.bytes.data() + y * TileGrid::pixels; }},
            execution, [&](std::string_view piece) { bytes += piece; });
  return bytes;
}

}  // namespace

Box TileGrid::box_of(const TilePlace& tile) const {
  const double side = pixel(tile.zoom) * pixels;
  const Vec2 upper_left{corner.x + tile.x * side, corner.y - tile.y * side};
  return {{upper_left.x, upper_left.y - side}, {upper_left.x + side, upper_left.y}};
}

OnTile TileGrid::on(const TilePlace& tile) const { return {box_of(tile), pixel(tile.zoom)}; }

std::optional<TilePlace> TileGrid::tile_at(std::string_view zoom, std::string_view x, std::string_view y) const {
  const auto z = number_below(levels, zoom);
  if (!z) return std::nullopt;
  const auto column = number_below(1U << *z, x);
  const auto row = number_below(1U << *z, y);
  if (!column || !row) return std::nullopt;
  return TilePlace{*z, *column, *row};
}

TileGrid grid_for_cells(std::uint32_t cols, std::uint32_t rows, double cell, Vec2 upper_left, CellsOnTiles& cells) {
  const double extent = std::max(cols, rows);
  cells.level = closest;
  const auto margin = [&] { return std::ldexp(1.0, std::max(0, cells.level)); };
  while (std::ldexp(TileGrid::pixels, cells.level) < extent + 2.0 * margin()) ++cells.level;
  cells.margin = static_cast<std::uint32_t>(margin());
  return {.corner = {upper_left.x - margin() * cell, upper_left.y + margin() * cell},
          .span = std::ldexp(TileGrid::pixels * cell, cells.level),
          .levels = static_cast<unsigned>(cells.level - closest) + 1};
}

TileGrid grid_around(const Box& box) {
  constexpr double margin = 1.06;
  constexpr unsigned levels = 14;
  const double extent = std::max({box.width(), box.height(), 1e-9});
  const Vec2 middle = 0.5 * (box.min + box.max);
  const double span = extent * margin;
  return {.corner = {middle.x - 0.5 * span, middle.y + 0.5 * span}, .span = span, .levels = levels};
}

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

std::string png_of_inks(const PixelTile& tile, std::span<const Rgb> inks, std::span<const std::uint8_t> opacities,
                        const Execution& execution) {
  PngColors palette{{0, 0, 0}};
  std::vector<std::uint8_t> alphas{0};
  for (const Rgb ink : inks) {
    palette.insert(palette.end(), opacities.size(), {ink.red, ink.green, ink.blue});
    alphas.insert(alphas.end(), opacities.begin(), opacities.end());
  }
  return png_of(tile, palette, alphas, execution);
}

std::string png_of_shades(PixelTile tile, Rgb ink, const Execution& execution) {
  constexpr unsigned shades = 16;
  PngColors palette;
  for (unsigned i = 0; i < shades; ++i) {
    const Rgb color = mixed(ink, colors::paper, 100 * i / (shades - 1));
    palette.push_back({color.red, color.green, color.blue});
  }
  for (std::uint8_t& shade : tile.bytes) shade = static_cast<std::uint8_t>(shade >> 4U);
  return png_of(tile, palette, {}, execution);
}

}  // namespace warren::serve
