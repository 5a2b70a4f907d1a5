// SPDX-License-Identifier: BSD-3-Clause
// Where samples of turning bodies are drawn from: poses at which the body is in the bounds, if it can be there at that
// angle; where nothing but the obstacles' box confines it, poses whose reference point is in that box.
#pragma once

#include <array>
#include <numbers>
#include <span>

#include "core/base/types.hpp"
#include "core/plane/se2.hpp"

namespace warren {

/// The pose at u in the unit cube: u[2] says the angle, u[0] and u[1] the place. confines_body: the whole outline, with
/// `reach` around it, shall be in the box, else the reference point. Where it is too wide for that, in the middle.
inline Se2 confined_pose(const Box& box, bool confines_body, std::span<const Vec2> outline, double reach,
                         const std::array<double, 3>& u) {
  const double theta = wrapped_angle((2.0 * u[2] - 1.0) * std::numbers::pi);
  Box places = box;
  if (confines_body) {
    const Rotation turned(theta);
    Box body;
    for (const Vec2 p : outline) body.include(turned(p));
    const Box wide = body.grown(reach);
    places = {box.min - wide.min, box.max - wide.max};
  }
  const auto at_share = [](double low, double high, double share) {
    return high > low ? low + share * (high - low) : 0.5 * (low + high);
  };
  return {at_share(places.min.x, places.max.x, u[0]), at_share(places.min.y, places.max.y, u[1]), theta};
}

}  // namespace warren
