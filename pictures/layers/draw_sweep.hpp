// SPDX-License-Identifier: BSD-3-Clause
// What a picture of a turning body shows beyond the world: the body at intervals along its path, and the tree or
// roadmap in the plane.
#pragma once

#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/se2.hpp"
#include "pictures/model/picture.hpp"
#include "planners/roadmap/planned_roadmap.hpp"

namespace warren {

/// The body's outlines along the path, a third of its radius apart, at most 400 of them and the last; the ends
/// included.
PictureLayer sweep_of(std::span<const Se2> path, std::span<const Vec2> outline);

/// The positions of the states of several roadmaps, one after the other, with their edges. Throws Stopped.
PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<Se2>>& roadmaps, const Execution& execution);
PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<Vec2>>& roadmaps, const Execution& execution);

}  // namespace warren
