// SPDX-License-Identifier: BSD-3-Clause
// The body along its path: filled with its front marked at start, goal and where the path bends or turns back; a few
// faint outlines between, darker towards the goal.
#pragma once

#include <span>
#include <vector>

#include "core/plane/se2.hpp"
#include "pictures/model/picture.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// How a body comes from one pose to the next: straight on and turning evenly, or as a car on straights and arcs.
enum class BodyMotion : std::uint8_t { straight, driving };

/// Layers sweep, bodies, body_start, body_goal and, of bodies with a heading, fronts, in the order in which they are
/// drawn. None of a point, and none without poses. A disc has a heading where it drives.
std::vector<PictureLayer> bodies_along(std::span<const Se2> poses, const RobotSpec& robot, BodyMotion motion);

/// Arrows of one length at poses, each from its position onwards.
PictureLayer heading_arrows(std::span<const Se2> poses, double length);

}  // namespace warren
