// SPDX-License-Identifier: BSD-3-Clause
// The part of a scene that a judge needs for what is near a path, so that asking many times costs little.
#pragma once

#include <span>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// The scene without the walls and polygons whose boxes are farther than `reach` from those of all legs. Those that the
/// box of all obstacles rests on stay, since it confines bodies where there are no bounds; maps and solids stay whole.
/// `path`: one point or more. One pass over the obstacles, about log(legs) each. Throws Stopped.
Scene obstacles_near(const Scene& scene, std::span<const Vec2> path, double reach, const Execution& execution);

}  // namespace warren
