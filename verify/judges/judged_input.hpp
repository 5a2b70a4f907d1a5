// SPDX-License-Identifier: BSD-3-Clause
// What all judges check before they look at a path. Above all: a judge sees every part of the scene that can be in its
// body's way, or it refuses the scene; what nobody looked at is never called free.
#pragma once

#include <span>
#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// For bodies in the plane: walls, polygons and bounds, or a map, beside which there are no walls but along its blocked
/// cells. Throws InputError for all else: solids, a map with polygons or bounds, a scene that holds nothing
/// at all (nothing would confine the body). O(1), but for a map with walls: O(their length in cells).
void check_plane_scene(const Scene& scene, const Execution& execution);

/// For arms: spheres, boxes and other solids, or free space. Throws InputError for walls, polygons, bounds and maps.
void check_space_scene(const Scene& scene);

/// Throws InputError, naming it, unless the number is in 0 .. largest_coordinate.
void check_not_negative(std::string_view name, double value);

/// Throws InputError unless a body has no corner (a disc) or at least three.
void check_outline(std::span<const Vec2> outline);

}  // namespace warren
