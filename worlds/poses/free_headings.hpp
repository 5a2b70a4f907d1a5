// SPDX-License-Identifier: BSD-3-Clause
// At which headings does a body stand free at a place? Where its outline turns about the reference point, a side of it
// comes as near as the room to a side of an obstacle only where an end of one does: at angles in closed form, two for
// each circle that an end runs on and each line or circle that it meets. Between two of these a pair of sides is near
// all along or nowhere, so one look in the middle tells; what no pair blocks are intervals, found whole. Narrower ones
// than `narrowest_heading` are left out. O(sides of obstacles within the body's reach * its corners), each some fifty
// distances, after one pass over the scene.
#pragma once

#include <span>
#include <vector>

#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Radians.
inline constexpr double narrowest_heading = 1e-7;

/// From `low` on, anticlockwise.
struct HeadingInterval {
  double low = 0.0;    ///< radians
  double width = 0.0;  ///< radians, at most a full turn
  double middle() const { return wrapped_angle(low + 0.5 * width); }
};

/// Where no side of the outline is as near as `room` >= 0 to a side of walls, polygons and bounds, or of a map's
/// blocked cells; by increasing `low` in [-pi, pi). Whether the body is on the right side of all of them any one
/// heading tells. Throws Stopped.
std::vector<HeadingInterval> free_headings(const Scene& scene, std::span<const Vec2> outline, Vec2 place, double room,
                                           const Execution& execution);

}  // namespace warren
