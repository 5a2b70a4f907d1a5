// SPDX-License-Identifier: BSD-3-Clause
// What a question forbids and opens, as the verification sees it: its own code, which shares nothing with
// worlds/prices. On a map a cell is blocked whose open square meets an open keep-out polygon, or the open square of a
// mask's blocked cell; unknown cells at a price are free. Elsewhere keep-out polygons, and the blocked cells of masks
// in rows, are obstacles like others.
#pragma once

#include <optional>

#include "core/run/execution.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// A mask's value in that use: a factor, >= 1; none: blocked.
std::optional<double> judged_factor(const PriceMask& mask, int value);

/// A place in cells of the map; on the line between cells where it is within a billionth of it.
Vec2 judged_corner(const OccupancyMap& map, Vec2 in_world);

/// The scene that a path of these prices must be free in; none: the scene as it is. Masks have been read (InputError
/// otherwise). Throws Stopped.
std::optional<Scene> effective_scene(const Scene& scene, const Prices& prices, const Execution& execution);

}  // namespace warren
