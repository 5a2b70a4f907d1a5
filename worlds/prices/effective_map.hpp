// SPDX-License-Identifier: BSD-3-Clause
// A map with what a question forbids and opens: keep-out polygons, blocked cells of masks, unknown cells at a price. A
// cell is blocked where its open square meets an open polygon, or the open square of a mask's blocked cell: by exact
// orientations of the corners in cells. Corners within a billionth of a line between cells are on it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/base/bitmap.hpp"
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

/// A corner in cells of the map, as above.
Vec2 corner_in_cells(const OccupancyMap& map, Vec2 in_world);
/// The four corners of a mask's cell, anticlockwise, in cells of the map.
std::array<Vec2, 4> mask_square(const OccupancyMap& map, const MaskCells& mask, std::uint32_t x, std::uint32_t y);

/// Sets the bits of all cells whose open square meets the open polygon; corners in cells. Throws Stopped.
void add_polygon_cells(Bitmap& cells, std::span<const Vec2> corners, const Execution& execution);

}  // namespace warren
