// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/layers/draw_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "core/plane/se2.hpp"
#include "scenes/text/human_units.hpp"
#include "spatial/maps/distance_field.hpp"

namespace warren {
namespace {

using CellRun = std::pair<std::uint32_t, std::uint32_t>;  // first column, one past the last

std::vector<CellRun> runs_of(const Bitmap& cells, std::uint32_t y) {
  std::vector<CellRun> runs;
  for (std::uint32_t x = 0; x < cells.width(); ++x) {
    if (!cells.test(x, y)) continue;
    if (runs.empty() || runs.back().second != x) runs.push_back({x, x});
    runs.back().second = x + 1;
  }
  return runs;
}

/// Of length in a cell; 0: nothing may be there.
double factor_of(const PriceMask& mask, int value) {
  constexpr int full = 100;
  const double share = value / 100.0;
  switch (mask.kind) {
    case MaskKind::areas:
      return value == full ? 0.0 : value <= 0 ? 1.0 : 1.0 + (mask.factor.value_or(1.0) - 1.0) * share;
    case MaskKind::keep_out:
      return value == full ? mask.factor.value_or(0.0) : 1.0;
    case MaskKind::speed:
      break;
  }
  if (value <= 0) return 1.0;
  const double limit = mask.base + mask.multiplier * value;
  return limit <= 0.0 ? 0.0 : std::max(1.0, full / limit);
}

PictureLayer layer_of_areas(std::string id, std::string label, double opacity) {
  return {.id = std::move(id),
          .label = std::move(label),
          .part = Part::world,
          .color = mixed(colors::search_tree, colors::text, 70),
          .width = widths::outline,
          .fill = colors::search_tree,
          .opacity = opacity,
          .blocks = false};
}

/// The dearer the stronger, of the dearest so much.
double strength(double factor, double dearest) {
  constexpr double weakest = 0.15;
  constexpr double strongest = 0.6;
  return dearest > 1.0 ? std::lerp(weakest, strongest, std::log(factor) / std::log(dearest)) : weakest;
}

constexpr double forbidden_opacity = 0.5;

/// In four steps of price, so that a mask of a hundred values has a legend that is read.
void add_mask(std::vector<PictureLayer>& layers, const PriceMask& mask, double dearest_of_all,
              const Execution& execution) {
  constexpr std::size_t steps = 4;
  const MaskCells& cells = *mask.read;
  std::array<double, 101> factors{};
  double most = 1.0;
  for (int value = 0; value <= 100; ++value)
    most = std::max(most, factors[static_cast<std::size_t>(value)] = factor_of(mask, value));
  execution.reserve((steps + 1) * (std::size_t{cells.width} / 8 + 8) * cells.height);
  std::vector<Bitmap> bits(steps + 1);
  for (Bitmap& bitmap : bits) bitmap = Bitmap(cells.width, cells.height);
  std::array<double, steps + 1> dearest{};
  for (std::uint32_t y = 0; y < cells.height; ++y) {
    execution.check();
    for (std::uint32_t x = 0; x < cells.width; ++x) {
      const int value = cells.values[std::size_t{y} * cells.width + x];
      const double factor = value < 0 ? 1.0 : factors[static_cast<std::size_t>(value)];
      if (factor == 1.0) continue;
      const double share = most > 1.0 ? std::log(factor) / std::log(most) : 1.0;
      const std::size_t step = factor == 0.0 ? steps : std::min(steps - 1, static_cast<std::size_t>(share * steps));
      bits[step].set(x, y);
      dearest[step] = std::max(dearest[step], factor);
    }
  }
  const Rotation turned(cells.yaw_rad);
  const auto at = [&](Vec2 p) { return cells.origin + turned(cells.cell * p); };
  for (std::size_t step = 0; step <= steps; ++step) {
    if (bits[step].count() == 0) continue;
    const bool is_forbidden = step == steps;
    PictureLayer& layer = layers.emplace_back(
        cells_layer(fmt::format("mask_{}", layers.size()),
                    is_forbidden ? "keep out" : fmt::format("up to {} times as dear", human_number(dearest[step])),
                    bits[step], at, execution));
    layer.fill = is_forbidden ? colors::wrong : colors::search_tree;
    layer.opacity = is_forbidden ? forbidden_opacity : strength(dearest[step], dearest_of_all);
    layer.blocks = false;
  }
}

/// All but what nearness costs.
std::vector<PictureLayer> layers_of_places(const Prices& prices, const Execution& execution) {
  double dearest = 1.0;
  std::map<double, PolygonSet> by_factor;
  for (const PricedArea& area : prices.areas) {
    dearest = std::max(dearest, area.factor);
    by_factor[area.factor].add(area.corners);
  }
  for (const PriceMask& mask : prices.masks) {
    for (int value = 1; value <= 100; ++value) dearest = std::max(dearest, factor_of(mask, value));
  }
  std::vector<PictureLayer> layers;
  for (auto& [factor, outlines] : by_factor) {
    layers.push_back(layer_of_areas(fmt::format("area_{}", layers.size()),
                                    fmt::format("area, {} times as dear", human_number(factor)),
                                    strength(factor, dearest)));
    layers.back().lines = std::move(outlines);
  }
  for (const PriceMask& mask : prices.masks) {
    if (mask.read) add_mask(layers, mask, dearest, execution);
  }
  if (prices.keep_out.empty()) return layers;
  PictureLayer& layer = layers.emplace_back(layer_of_areas("keep_out", "keep out", forbidden_opacity));
  layer.color = colors::wrong;
  layer.fill = colors::wrong;
  for (const ScenePolygon& area : prices.keep_out) layer.lines.add(area.corners);
  return layers;
}

}  // namespace

PictureLayer cells_layer(std::string id, std::string label, const Bitmap& cells, const std::function<Vec2(Vec2)>& at,
                         const Execution& execution) {
  PictureLayer layer{
      .id = std::move(id), .label = std::move(label), .part = Part::world, .width = 0.0, .fill = colors::blocked_cell};
  std::map<CellRun, std::uint32_t> open;  // runs of the rows before, and the row where each began
  const auto close = [&](const CellRun& run, std::uint32_t first, std::uint32_t last) {
    const Vec2 low{static_cast<double>(run.first), static_cast<double>(first)};
    const Vec2 high{static_cast<double>(run.second), static_cast<double>(last)};
    layer.lines.add(std::array{at(low), at({high.x, low.y}), at(high), at({low.x, high.y})});
  };
  for (std::uint32_t y = 0; y < cells.height(); ++y) {
    execution.check();
    std::map<CellRun, std::uint32_t> next;
    for (const CellRun& run : runs_of(cells, y)) {
      const auto found = open.find(run);
      next[run] = found == open.end() ? y : found->second;
    }
    for (const auto& [run, first] : open) {
      if (!next.contains(run)) close(run, first, y);
    }
    open = std::move(next);
  }
  for (const auto& [run, first] : open) close(run, first, cells.height());
  return layer;
}

std::vector<PictureLayer> cells_of_map(const OccupancyMap& map, const Execution& execution) {
  const auto at = [&](Vec2 p) { return world_point(map, p); };
  if (map.format != MapFormat::ros) return {cells_layer("blocked", "blocked cells", map.blocked, at, execution)};
  execution.reserve(map.blocked.bytes());
  Bitmap known = map.blocked;
  known.remove(map.unknown, [&] { execution.check(); });
  const char* occupied = map.between > 0 ? "occupied cells, and those between" : "occupied cells";
  std::vector<PictureLayer> layers;
  layers.push_back(cells_layer("occupied", occupied, known, at, execution));
  known = {};
  layers.back().fill = colors::occupied_cell;
  if (!map.unknown.empty()) layers.push_back(cells_layer("unknown", "unknown cells", map.unknown, at, execution));
  return layers;
}

std::vector<PictureLayer> price_layers(const Prices& prices, const std::optional<OccupancyMap>& map, double radius,
                                       const Execution& execution) {
  std::vector<PictureLayer> layers;
  if (map && prices.clearance && prices.clearance->reach && prices.clearance->price > 0.0) {
    const auto at = [&](Vec2 p) { return world_point(*map, p); };
    // Free cells whose middle is nearer than that to a blocked one lie upon each other: the nearer the dearer.
    for (const auto& [share, id, label] :
         {std::tuple{1.0, "nearness", "nearness costs"}, {0.6, "nearness_more", ""}, {0.3, "nearness_most", ""}}) {
      const double reach = share * *prices.clearance->reach + radius;
      Bitmap near = blocked_for_disc(map->blocked, reach / map->cell, execution);
      near.remove(map->blocked, [&] { execution.check(); });
      if (near.count() == 0) continue;
      PictureLayer& layer = layers.emplace_back(cells_layer(id, label, near, at, execution));
      layer.fill = colors::search_tree;
      layer.opacity = 0.1;
      layer.blocks = false;
    }
  }
  for (PictureLayer& layer : layers_of_places(prices, execution)) layers.push_back(std::move(layer));
  return layers;
}

}  // namespace warren
