// SPDX-License-Identifier: BSD-3-Clause
// What a path costs beside its length, recomputed: nothing of worlds/prices is used. A leg is cut where it passes from
// cell to cell, along segments where the nearest place of one becomes an end; in each piece the integral is a closed
// form. Factors are looked up in the middle of what lies between two borders; within a billionth of a cell of a border
// the lesser one counts. O(legs * cells crossed * things near them).
#pragma once

#include <span>

#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Of a point's or disc's path among the cells of a map, or among walls, polygons and bounds. scene: as the prices
/// close and open it (verify/judges/effective_scene), in which the path is free. radius: of the disc. Throws InputError
/// where a price of nearness reaches nowhere, Stopped.
PriceParts verify_price(const Scene& scene, std::span<const Vec2> path, const Prices& prices, double radius,
                        const Execution& execution);

/// Clearance and areas of a turning polygon or a car, and `error`: the sum is off by no more. scene: as the prices
/// close and open it (verify/judges/effective_scene), in which the path is free. Of turns on the spot nothing is paid:
/// the integrals are over the way of the reference point. Throws InputError where a price of nearness reaches nowhere,
/// Stopped.
PriceParts verify_body_price(const Scene& scene, std::span<const Se2> path, const RobotSpec& robot,
                             const Prices& prices, const Execution& execution);

}  // namespace warren
