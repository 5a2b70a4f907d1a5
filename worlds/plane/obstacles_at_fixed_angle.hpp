// SPDX-License-Identifier: BSD-3-Clause
// What blocks the reference point of a polygon that does not turn: Minkowski sums of the obstacles with the mirrored
// body, piece by convex piece, so that planners for points (visibility graph, cells) plan for the body at that angle.
// Pieces of one obstacle overlap by the width of the body; so do obstacles that the body does not fit between.
#pragma once

#include <span>

#include "core/base/types.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// outline: around the reference point, three or more corners. room: distance that shall be kept, > 0; the polygons
/// keep at least that much, and at corners up to 1 / cos(pi / disc_corners) times as much: 0.5 % more for 32.
/// InputError for outlines that are no simple polygons, and where the body doesn't fit in the bounds at all. Without
/// bounds the box of the obstacles confines the reference point, and becomes the bounds. Throws Stopped.
PlaneObstacles translation_obstacles(const Scene& scene, std::span<const Vec2> outline, double theta, double room,
                                     std::size_t disc_corners = 32, const Execution& execution = {});

}  // namespace warren
