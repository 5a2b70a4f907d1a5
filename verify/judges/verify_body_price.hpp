// SPDX-License-Identifier: BSD-3-Clause
// What the path of a body that turns costs beside its length, recomputed: of polygons that turn as they go straight and
// of cars, whose legs are arcs. Nothing of worlds/ or planners/ is used.
//
// Nearness has no closed form here, but it has bounds. No point of the body goes farther on a piece of a leg than the
// piece is long and its turn times the body's extent; by so much at most the body's distance changes. So the distance
// in the piece's middle bounds the integral from both sides, in closed form. A piece is halved until both are as near
// as a thousandth of what it costs; half of what is left is the error. The distance is the least between corners of
// the one and sides of the other, since a body that is free crosses nothing; from piece to half only those pairs are
// kept that may be the least there. Areas are priced where the reference point is (verify/judges/judged_factors.hpp).
#pragma once

#include <span>

#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Clearance and areas of a turning polygon or a car, and `error`: the sum is off by no more. scene: as the prices
/// close and open it (verify/judges/effective_scene), in which the path is free. Of turns on the spot nothing is paid:
/// the integrals are over the way of the reference point. Throws InputError where a price of nearness reaches nowhere,
/// Stopped.
PriceParts verify_body_price(const Scene& scene, std::span<const Se2> path, const RobotSpec& robot,
                             const Prices& prices, const Execution& execution);

}  // namespace warren
