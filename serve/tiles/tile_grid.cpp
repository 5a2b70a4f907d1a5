// SPDX-License-Identifier: BSD-3-Clause
#include "serve/tiles/tile_grid.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace warren::serve {
namespace {

constexpr int closest = -6;  // 64 pixels a cell

std::optional<std::uint32_t> number_below(std::uint32_t end, std::string_view digits) {
  std::uint32_t number = 0;
  const char* last = digits.data() + digits.size();
  const auto [read, error] = std::from_chars(digits.data(), last, number);
  const bool is_plain = digits == "0" || !digits.starts_with('0');  // one name a tile
  return is_plain && error == std::errc() && read == last && number < end ? std::optional(number) : std::nullopt;
}

}  // namespace

Box TileGrid::box_of(const TilePlace& tile) const {
  const double side = pixel(tile.zoom) * pixels;
  const Vec2 upper_left{corner.x + tile.x * side, corner.y - tile.y * side};
  return {{upper_left.x, upper_left.y - side}, {upper_left.x + side, upper_left.y}};
}

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

}  // namespace warren::serve
