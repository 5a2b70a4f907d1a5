// SPDX-License-Identifier: BSD-3-Clause
// Cells as a picture shows them: the set ones of a bitmap as filled rectangles, as few as rows of equal runs make. And
// what prices make of a world: areas by their factors, forbidden ones, and how far nearness costs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "pictures/model/picture.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/prices.hpp"

namespace warren {

/// at(p): where the bitmap's coordinates lie in the world; cell (x, y) is the square from (x, y) to (x + 1, y + 1).
/// O(cells + runs log). Throws Stopped.
PictureLayer cells_layer(std::string id, std::string label, const Bitmap& cells, const std::function<Vec2(Vec2)>& at,
                         const Execution& execution);

/// The blocked cells of a map; of a map server's the occupied ones and the unknown ones, a layer each.
std::vector<PictureLayer> cells_of_map(const OccupancyMap& map, const Execution& execution);

/// Areas and cells of masks tinted the stronger the dearer they are, one layer each kind; what is forbidden strongly.
/// Of a map also the cells where a body of that radius pays for nearness, lightly, below all others. Masks that nobody
/// has read are left out. Throws Stopped.
std::vector<PictureLayer> price_layers(const Prices& prices, const std::optional<OccupancyMap>& map, double radius,
                                       const Execution& execution);

}  // namespace warren
