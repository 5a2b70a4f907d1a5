// SPDX-License-Identifier: BSD-3-Clause
#include "studies/compare/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/types.hpp"

namespace warren::studies {
namespace {

constexpr Box frame{{150.0, 48.0}, {724.0, 350.0}};  // of the cells, y down

/// Red, green, blue, 0 to 255.
using Color = std::array<double, 3>;
constexpr std::array<Color, 5> viridis{{{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};

/// At a share from 0 to 1 of the scale.
Color color_at(double share) {
  const double at = share * static_cast<double>(viridis.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), viridis.size() - 2);
  Color color{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    color[i] = std::lerp(viridis[below][i], viridis[below + 1][i], at - static_cast<double>(below));
  }
  return color;
}

Rgb rounded(const Color& c) {
  const auto part = [](double value) { return static_cast<std::uint8_t>(std::lround(value)); };
  return {part(c[0]), part(c[1]), part(c[2])};
}

bool is_dark(const Color& c) { return 0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2] < 128.0; }

/// The least and the largest value; equal where there is one value or none.
struct Scale {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

class HeatMapDrawing {
 public:
  explicit HeatMapDrawing(const HeatMap& map)
      : map_(map),
        cell_{frame.width() / static_cast<double>(map.columns.size()),
              frame.height() / static_cast<double>(map.rows.size())} {
    for (const HeatMap::Cell& cell : map.cells) {
      if (!cell.value) continue;
      scale_.low = std::min(scale_.low, *cell.value);
      scale_.high = std::max(scale_.high, *cell.value);
    }
    scale_.low = map.low.value_or(scale_.low);
    scale_.high = map.high.value_or(scale_.high);
  }

  PlotSheet sheet() {
    begin();
    for (std::size_t row = 0; row < map_.rows.size(); ++row) {
      for (std::size_t column = 0; column < map_.columns.size(); ++column) draw_cell(column, row);
    }
    return std::move(sheet_);
  }

 private:
  void begin();
  void draw_cell(std::size_t column, std::size_t row);
  double x_of(std::size_t column) const { return frame.min.x + cell_.x * static_cast<double>(column); }
  double y_of(std::size_t row) const { return frame.max.y - cell_.y * static_cast<double>(row + 1); }

  const HeatMap& map_;
  Vec2 cell_;  // width and height of one
  Scale scale_;
  PlotSheet sheet_;
};

void HeatMapDrawing::begin() {
  sheet_.keep_colors();
  sheet_.begin(map_.title, frame, map_.x_label, map_.y_label, 40.0);
  for (std::size_t i = 0; i < map_.columns.size(); ++i) {
    sheet_.label({x_of(i) + 0.5 * cell_.x, frame.max.y + 18.0}, Anchor::middle, map_.columns[i]);
  }
  for (std::size_t i = 0; i < map_.rows.size(); ++i) {
    sheet_.label({frame.min.x - 8.0, y_of(i) + 0.5 * cell_.y + 4.0}, Anchor::end, map_.rows[i]);
  }
}

void HeatMapDrawing::draw_cell(std::size_t column, std::size_t row) {
  const HeatMap::Cell& cell = map_.cells[row * map_.columns.size() + column];
  const double share = cell.value ? scale_.share(*cell.value) : 0.0;
  const Color color = cell.value ? color_at(map_.less_is_better ? 1.0 - share : share) : Color{232, 232, 232};
  const Vec2 low{x_of(column), y_of(row)};
  sheet_.box(
      {low, low + cell_}, {.stroke = colors::paper, .fill = rounded(color)},
      fmt::format("{} {}, {} {}: {}", map_.x_label, map_.columns[column], map_.y_label, map_.rows[row], cell.text));
  sheet_.label(low + Vec2{0.5 * cell_.x, 0.5 * cell_.y + 4.0}, Anchor::middle, cell.text,
               is_dark(color) ? colors::paper : Rgb{0, 0, 0});  // a fill of its own, on dark pages, too
}

}  // namespace

PlotSheet sheet_of(const HeatMap& map) { return HeatMapDrawing(map).sheet(); }

}  // namespace warren::studies
