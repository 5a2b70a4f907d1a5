// SPDX-License-Identifier: BSD-3-Clause
// The body along its path: filled with its front marked at start, goal and where the path bends or turns back; a few
// faint outlines between, darker towards the goal.
#pragma once

#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "pictures/model/picture.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/by_products.hpp"

namespace warren {

/// Layers sweep, bodies, body_start, body_goal and, of bodies with a heading, fronts, in the order in which they are
/// drawn. None of a point, and none without poses. A disc has a heading where it drives.
std::vector<PictureLayer> bodies_along(std::span<const Se2> poses, const RobotSpec& robot);

/// Arrows of one length at poses, each from its position onwards.
PictureLayer heading_arrows(std::span<const Se2> poses, double length);

// What a picture of a car shows beyond the world: the curves of its trees or roadmap. A curve is drawn as what it is,
// straights and circular arcs.

/// What a car's planner made, as it is drawn.
struct CarCurves {
  PictureLayer edges;
  PictureLayer trees;  ///< of the searches
  RawVector<Vec2> milestones;
};

/// Every motion of the roadmaps as the curve that the car drives. Throws Stopped.
CarCurves car_curves(std::span<const PlannedRoadmap<Se2>> roadmaps, const RobotSpec& car, const Execution& execution);

// The configuration space of a body that turns, cut at one heading: the cells where its reference point has no room,
// and how states of a roadmap are turned.

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

// Roadmaps and trees of bodies that turn, as a picture of the plane shows them.

/// The positions of the states of several roadmaps, one after the other, with their edges. Throws Stopped.
template <class State>
PlannedRoadmap<Vec2> in_the_plane(const std::vector<PlannedRoadmap<State>>& roadmaps, const Execution& execution);

}  // namespace warren
