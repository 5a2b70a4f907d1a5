// SPDX-License-Identifier: BSD-3-Clause
// Robots as ROS describes them: URDF, with groups and allowed pairs from an SRDF, as MoveIt reads both. Collision
// meshes are their convex hulls. What is taken of them is said in docs/file_formats.md, "Robots from files".
#pragma once

#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Reads a robot. Variables are the group's joints in depth-first order, children by their joints' names. Pairs are all
/// pairs of links with solids but those that the SRDF disables, those of ArmFiles::allowed, those with no moving joint
/// between, and neighbours (links joined by one joint, through links without solids, too); a carried body is no
/// neighbour. A held joint that the group moves, or that follows another one, is not held: the group or that one says
/// where it is. Throws ReadError, InputError naming file and line, Stopped.
ArmModel read_urdf(const ArmFiles& files, const Execution& execution);

}  // namespace warren
