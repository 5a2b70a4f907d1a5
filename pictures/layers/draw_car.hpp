// SPDX-License-Identifier: BSD-3-Clause
// What a picture of a car shows beyond the world: the curves of its trees or roadmap. A curve is drawn as what it is,
// straights and circular arcs.
#pragma once

#include <span>
#include <vector>

#include "core/plane/se2.hpp"
#include "parallel/execution.hpp"
#include "pictures/model/picture.hpp"
#include "planners/roadmap/planned_roadmap.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// What a car's planner made, as it is drawn.
struct CarCurves {
  PictureLayer edges;
  PictureLayer trees;  ///< of the searches
  RawVector<Vec2> milestones;
};

/// Every motion of the roadmaps as the curve that the car drives. Throws Stopped.
CarCurves car_curves(std::span<const PlannedRoadmap<Se2>> roadmaps, const RobotSpec& car, const Execution& execution);

}  // namespace warren
