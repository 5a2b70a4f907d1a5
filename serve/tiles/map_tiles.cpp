// SPDX-License-Identifier: BSD-3-Clause
// Tiles of maps: a pixel takes the shade of the cell in its middle, from afar that of the pyramid's square there. Maps
// may be turned, so each row of pixels is a line through the cells.
#include <algorithm>
#include <cmath>
#include <limits>

#include "serve/tiles/shade_png.hpp"
#include "serve/tiles/shade_pyramid.hpp"
#include "serve/tiles/world_tiles.hpp"
#include "spatial/maps/distance_field.hpp"

namespace warren::serve {
namespace {

constexpr std::uint8_t blocked_shade = 255;
constexpr std::uint8_t unknown_shade = 80;

Box box_of_map(const OccupancyMap& map) {
  Box box;
  for (const double x : {0.0, static_cast<double>(map.width())}) {
    for (const double y : {0.0, static_cast<double>(map.height())}) box.include(world_point(map, {x, y}));
  }
  return box;
}

/// Of a cell's middle, from the squares of blocked cells and of those around the map; four bytes a cell.
class MapDistances : public PlaceDistances {
 public:
  MapDistances(const OccupancyMap& map, const Execution& execution)
      : map_(map), field_(map.blocked, CellDistance::squares, true, execution) {}

  double at(Vec2 place) const override {
    const std::optional<Cell> cell = cell_at(map_, place);
    if (!cell || map_.blocked.test(cell->x, cell->y)) return std::numeric_limits<double>::quiet_NaN();
    return map_.cell * field_.distance(cell->x, cell->y);
  }

 private:
  const OccupancyMap& map_;
  DistanceField field_;
};

class MapTiles : public WorldTiles {
 public:
  MapTiles(const OccupancyMap& map, const Execution& execution)
      : WorldTiles(grid_around(box_of_map(map))),
        map_(map),
        far_(
            map.width(), map.height(), [this](std::uint32_t x, std::uint32_t y) { return shade_of(x, y); }, execution) {
  }

  std::string draw(const TilePlace& place, const Execution& execution) const override {
    ShadeTile tile;
    const double pixel = grid().pixel(place.zoom);
    const Box box = grid().box_of(place);
    const Vec2 first = map_point(map_, {box.min.x + 0.5 * pixel, box.max.y - 0.5 * pixel});
    const Vec2 right = map_point(map_, {box.min.x + 1.5 * pixel, box.max.y - 0.5 * pixel}) - first;
    const Vec2 down = map_point(map_, {box.min.x + 0.5 * pixel, box.max.y - 1.5 * pixel}) - first;
    const unsigned level = level_of(pixel / map_.cell);
    for (unsigned y = 0; y < TileGrid::pixels; ++y) {
      if (y % 64 == 0) execution.check();
      for (unsigned x = 0; x < TileGrid::pixels; ++x) {
        tile.at(x, y) = shade_at(first + static_cast<double>(x) * right + static_cast<double>(y) * down, level);
      }
    }
    return png_of(tile, colors::wall, execution);
  }

  std::unique_ptr<PlaceDistances> distances(const Execution& execution) const override {
    return std::make_unique<MapDistances>(map_, execution);
  }

 private:
  std::uint8_t shade_of(std::uint32_t x, std::uint32_t y) const {
    if (!map_.blocked.test(x, y)) return 0;
    return !map_.unknown.empty() && map_.unknown.test(x, y) ? unknown_shade : blocked_shade;
  }
  /// The last one whose squares are no larger than a pixel.
  unsigned level_of(double cells) const {
    unsigned level = 0;
    while (level + 1 < far_.levels() && static_cast<double>(2U << level) <= cells) ++level;
    return level;
  }
  std::uint8_t shade_at(Vec2 in_cells, unsigned level) const {
    if (!(in_cells.x >= 0.0 && in_cells.y >= 0.0 && in_cells.x < map_.width() && in_cells.y < map_.height())) return 0;
    const auto x = static_cast<std::uint32_t>(in_cells.x);
    const auto y = static_cast<std::uint32_t>(in_cells.y);
    return level == 0 ? shade_of(x, y) : far_.at(level, x >> level, y >> level);
  }

  const OccupancyMap& map_;
  ShadePyramid far_;
};

}  // namespace

std::unique_ptr<WorldTiles> map_tiles(const OccupancyMap& map, const Execution& execution) {
  return std::make_unique<MapTiles>(map, execution);
}

}  // namespace warren::serve
