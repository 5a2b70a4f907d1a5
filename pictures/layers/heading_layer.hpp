// SPDX-License-Identifier: BSD-3-Clause
// The configuration space of a body that turns, cut at one heading: the cells where its reference point has no room,
// and how states of a roadmap are turned.
#pragma once

#include <span>
#include <vector>

#include "core/plane/se2.hpp"
#include "parallel/execution.hpp"
#include "pictures/model/picture.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/by_products.hpp"

namespace warren {

/// Throws UsageError, about @heading, for points, discs, arms and cars that are round: one layer, or none, is theirs.
void check_has_headings(const RobotSpec& robot);

/// By the exact footprints of the grid planner, on a map's own cells, else 400 along the longer side. clearance: room
/// around the body. Throws as check_has_headings(), InputError for worlds that nothing confines, Stopped.
HeadingCells heading_cells(const Scene& scene, const RobotSpec& robot, double clearance, double heading_rad,
                           const Execution& execution);

/// The cells alone. Throws Stopped.
PictureLayer blocked_at_heading(const HeadingCells& heading, const Execution& execution);

/// Where the body may stand: some arrows that show how it is turned there. Throws Stopped.
PictureLayer arrows_among(const HeadingCells& heading, const Execution& execution);

/// States as arrows, those stronger that look within ten degrees of the heading. Of many, some, which the labels say.
std::vector<PictureLayer> state_arrows(std::span<const Se2> states, double heading_rad);

}  // namespace warren
