// SPDX-License-Identifier: BSD-3-Clause
// How a point gets onto a medial axis: straight away from its nearest obstacle until another one is as near (the
// retraction). On the way the distance to the nearest obstacle grows, so the leg has the clearance of its first point.
// O(axis), for a few points a plan.
#pragma once

#include <optional>

#include "planners/axis/medial_axis.hpp"

namespace warren {

/// A place on the axis.
struct AxisPlace {
  std::uint32_t edge;  ///< its number
  double parameter;    ///< on the edge's curve
  Vec2 at;
};

/// Distance of the closed segment to the nearest true obstacle; infinite where there is none.
double clearance_of_leg(const MedialAxis& axis, const Segment& leg);

/// Where p, free and inside the frame, retracts to; none where rounding hides it, or where p touches an obstacle.
std::optional<AxisPlace> retract(const MedialAxis& axis, Vec2 p);

}  // namespace warren
