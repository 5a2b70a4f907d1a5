// SPDX-License-Identifier: BSD-3-Clause
// Cells as a picture shows them: the set ones of a bitmap as filled rectangles, as few as rows of equal runs make.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/types.hpp"
#include "pictures/model/picture.hpp"
#include "scenes/scene/occupancy_map.hpp"

namespace warren {

/// at(p): where the bitmap's coordinates lie in the world; cell (x, y) is the square from (x, y) to (x + 1, y + 1).
/// O(cells + runs log). Throws Stopped.
PictureLayer cells_layer(std::string id, std::string label, const Bitmap& cells, const std::function<Vec2(Vec2)>& at,
                         const Execution& execution);

/// The blocked cells of a map; of a map server's the occupied ones and the unknown ones, a layer each.
std::vector<PictureLayer> cells_of_map(const OccupancyMap& map, const Execution& execution);

}  // namespace warren
