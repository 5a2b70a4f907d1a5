// SPDX-License-Identifier: BSD-3-Clause
// Roadmaps and trees of bodies that turn, as a picture of the plane shows them.
#pragma once

#include <vector>

#include "core/base/types.hpp"
#include "core/plane/se2.hpp"
#include "parallel/execution.hpp"
#include "planners/roadmap/planned_roadmap.hpp"

namespace warren {

/// The positions of the states of several roadmaps, one after the other, with their edges. Throws Stopped.
PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<Se2>>& roadmaps, const Execution& execution);
PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<Vec2>>& roadmaps, const Execution& execution);

}  // namespace warren
