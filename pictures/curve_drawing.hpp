// SPDX-License-Identifier: BSD-3-Clause
// What a picture of a car shows beyond the world: the curves of its trees or roadmap, and its body along the path. A
// curve is drawn as what it is, straights and circular arcs.
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "core/plane/se2.hpp"
#include "pictures/picture.hpp"
#include "planners/roadmap/roadmap.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/state_list.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {

using CurveBetween = std::function<SteeringCurve(const Se2& a, const Se2& b)>;

/// Appends the poses at which the steering or the gear changes, and so many in longer arcs that none turns by more than
/// a quarter; the curve's begin is there already.
void append_joints(std::vector<Se2>& poses, const SteeringCurve& curve);

/// The turn of the leg that ends at each pose; 0 at the first: the legs as Picture and PictureLayer take them.
std::vector<double> leg_turns(std::span<const Se2> poses);

/// The length of the leg that ends at each pose, straight or an arc that turns so; 0 at the first.
std::vector<double> leg_lengths(std::span<const Se2> poses, std::span<const double> turns);

/// leg_turns for an answer's path; nothing where the body is no car, whose legs are all straight.
std::vector<double> path_turns(const RobotSpec& robot, const StateList& states);

/// Edges and search trees as layers of curves, milestones as the drawing's roadmap. one_way: an edge leads from the
/// vertex in whose row it stands. Throws Stopped.
void draw_curves(Drawing& drawing, const std::vector<Roadmap<Se2>>& roadmaps, bool one_way, const CurveBetween& curve,
                 const Execution& execution);

/// The pose at the share t of the leg from a to b, which is straight or an arc.
Se2 pose_on_leg(const Se2& a, const Se2& b, double t);

/// The body along the path of poses as append_joints makes them, about a third of its size apart, at most 400 of them.
PictureLayer car_sweep(std::span<const Se2> poses, const RobotSpec& robot);

}  // namespace warren
