// SPDX-License-Identifier: BSD-3-Clause
// A map with what a question forbids and opens: keep-out polygons, blocked cells of masks, unknown cells at a price. A
// cell is blocked where its open square meets an open polygon, or the open square of a mask's blocked cell: by exact
// orientations of the corners in cells. Corners within a billionth of a line between cells are on it.
//
// What is open costs more in places: AreaFactors are the factors of length that areas and masks give to places, in
// coordinates of whoever asks: the world's, or a map's cells. The greatest of the open areas and cells around a place
// counts; within a billionth of a border the lesser of both sides.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Is there anything that changes which cells are blocked?
bool restricts(const Prices& prices);

/// The map as it is planned on. Masks have been read. Throws Stopped.
OccupancyMap effective_map(const OccupancyMap& map, const Prices& prices, const Execution& execution);

/// The scene as it is planned in, which restricts(): on a map the map above; else keep-out polygons and the masks'
/// blocked cells are polygons more. Masks have been read. Throws Stopped.
Scene restricted_scene(const Scene& scene, const Prices& prices, const Execution& execution);

/// A mask's value in that use: its factor, >= 1; none: blocked.
std::optional<double> mask_factor(const PriceMask& mask, int value);
/// Does some value cost more than nothing, without being blocked?
bool is_dear(const PriceMask& mask);
/// Calls each(cells, x, y, factor) for the cells of value > 0 of the masks that were read. Throws Stopped.
template <class Each>
void for_mask_cells(const Prices& prices, const Execution& execution, const Each& each) {
  for (const PriceMask& mask : prices.masks) {
    if (!mask.read) continue;
    const MaskCells& cells = *mask.read;
    for (std::uint32_t y = 0; y < cells.height; ++y) {
      execution.check();
      for (std::uint32_t x = 0; x < cells.width; ++x) {
        const int value = cells.values[std::size_t{y} * cells.width + x];
        if (value > 0) each(cells, x, y, mask_factor(mask, value));
      }
    }
  }
}
/// Corner (column, row) of a mask's cells, in the world.
Vec2 mask_corner(const MaskCells& mask, double column, double row);

/// A corner in cells of the map, as above.
Vec2 corner_in_cells(const OccupancyMap& map, Vec2 in_world);
/// The four corners of a mask's cell, anticlockwise, in cells of the map.
std::array<Vec2, 4> mask_square(const OccupancyMap& map, const MaskCells& mask, std::uint32_t x, std::uint32_t y);

/// Sets the bits of all cells whose open square meets the open polygon; corners in cells. Throws Stopped.
void add_polygon_cells(Bitmap& cells, std::span<const Vec2> corners, const Execution& execution);

/// Copies what it needs of the prices. Immutable.
class AreaFactors {
 public:
  static constexpr double on_border = 1e-9;
  struct Area {
    double factor;
    std::vector<Vec2> corners;
    Box box;
  };

  /// placed(p): a place of the world in the own coordinates, which are the world's, turned and scaled. Areas and masks
  /// that cost nothing are left out.
  template <class Placed>
  AreaFactors(const Prices& prices, const Placed& placed) {
    for (const PricedArea& area : prices.areas) {
      if (!(area.factor > 1.0)) continue;
      Area own{area.factor, {}, {}};
      for (const Vec2 p : area.corners) {
        own.corners.push_back(placed(p));
        own.box.include(own.corners.back());
      }
      areas_.push_back(std::move(own));
    }
    for (const PriceMask& mask : prices.masks) {
      if (!mask.read || !is_dear(mask)) continue;
      // The axes from the far corners, so that their rounding is that of one cell.
      const double width = mask.read->width;
      const double height = mask.read->height;
      const Vec2 origin = placed(mask_corner(*mask.read, 0.0, 0.0));
      const Vec2 across = placed(mask_corner(*mask.read, width, 0.0)) - origin;
      const Vec2 along = placed(mask_corner(*mask.read, 0.0, height)) - origin;
      masks_.push_back({mask, origin, (1.0 / width) * across, (1.0 / height) * along});
    }
  }

  bool empty() const { return areas_.empty() && masks_.empty(); }
  const std::vector<Area>& areas() const { return areas_; }
  /// At a place.
  double factor(Vec2 p) const;
  /// The integral of factor_at(p) - 1 over a leg of that length in the direction u, which has length 1. factor_at: as
  /// factor(), or more where it changes at places that are cut already.
  template <class FactorAt>
  double over(Vec2 p, Vec2 u, double length, std::vector<double>& cuts, const FactorAt& factor_at) const {
    cut(p, u, length, cuts);
    double sum = 0.0;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      if (!(cuts[i] > cuts[i - 1])) continue;
      sum += (cuts[i] - cuts[i - 1]) * (factor_at(p + 0.5 * (cuts[i - 1] + cuts[i]) * u) - 1.0);
    }
    return sum;
  }

  /// The least of the cells of a unit grid that a place is in, or on the border of.
  template <class OfCell>
  static double least_around(Vec2 at, const OfCell& of_cell) {
    double least = std::numeric_limits<double>::infinity();
    for (const double dy : {-on_border, on_border}) {
      for (const double dx : {-on_border, on_border}) {
        least = std::min(least, of_cell(bounded_whole<std::int64_t>(std::floor(at.x + dx)),
                                        bounded_whole<std::int64_t>(std::floor(at.y + dy))));
      }
    }
    return least;
  }

 private:
  struct Mask {
    PriceMask mask;
    Vec2 origin;  // of its cell (0, 0)
    Vec2 right;   // a step of its columns, and of its rows
    Vec2 up;
  };

  void cut(Vec2 p, Vec2 u, double length, std::vector<double>& cuts) const;

  std::vector<Area> areas_;
  std::vector<Mask> masks_;
};

}  // namespace warren
