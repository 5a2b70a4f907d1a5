// SPDX-License-Identifier: BSD-3-Clause
// A scene's polygons as planners take them: checked, without repeated corners, anticlockwise. Refused, with the
// polygon's line: fewer than three different corners, no area, an outline that crosses or touches itself or turns back
// on itself. Corners on a straight side, equal corners in a row (a closed ring's last one too) and either orientation
// are legal; so are polygons that touch, share corners or sides, or overlap: what is blocked is their union.
// O(n log n) for n corners, in parallel over the polygons.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Throws InputError naming file and line for a polygon that is not simple, Stopped.
void check_polygons(const Scene& scene, const Execution& execution);

/// Throws InputError naming `where` for the outline of a body that is no simple polygon, Stopped.
void check_body(std::span<const Vec2> outline, const std::string& where, const Execution& execution);

/// Polygons in the scene's order, walls, bounds. Throws as check_polygons does, and for 2^32 corners.
PlaneObstacles plane_obstacles(const Scene& scene, const Execution& execution);

/// The same outline without repeated corners, anticlockwise; as it is where it has no area.
std::vector<Vec2> anticlockwise(const std::vector<Vec2>& corners);

/// Where a polygon is said to be wrong: "file:line", or "file: polygon 3" (from 0) where no line is known.
std::string place_of_polygon(const Scene& scene, std::size_t polygon);

}  // namespace warren
