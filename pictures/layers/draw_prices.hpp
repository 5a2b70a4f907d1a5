// SPDX-License-Identifier: BSD-3-Clause
// What prices make of a world, as a picture shows it: areas by their factors, forbidden ones, and how far nearness
// costs.
#pragma once

#include <optional>
#include <vector>

#include "core/run/execution.hpp"
#include "pictures/model/picture.hpp"
#include "scenes/scene/occupancy_map.hpp"
#include "scenes/scene/prices.hpp"

namespace warren {

/// Areas and cells of masks tinted the stronger the dearer they are, one layer each kind; what is forbidden strongly.
/// Of a map also the cells where a body of that radius pays for nearness, lightly, below all others. Masks that nobody
/// has read are left out. Throws Stopped.
std::vector<PictureLayer> price_layers(const Prices& prices, const std::optional<OccupancyMap>& map, double radius,
                                       const Execution& execution);

}  // namespace warren
