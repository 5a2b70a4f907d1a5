// SPDX-License-Identifier: BSD-3-Clause
// Planning scenes and requests of MoveIt as YAML, as MotionBenchMaker writes them: what is in an arm's way, which links
// may touch, where joints stand, what is carried; where the arm starts and shall go. The arm itself is none of it: its
// URDF is named beside them, and joints are known by their names alone.
//
// Of a scene: the primitives box, sphere and cylinder of collision objects and attached ones, meshes as their convex
// hulls, the matrix of allowed collisions, the state of the joints. Cones, planes and octomaps are
// refused, and frames of links. Of a request: group, start, goals by joints or one by a pose. Its workspace and its
// planner are left out, constraints on the way are refused. Tolerances are left out: a goal is met as it stands.
#pragma once

#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// Does it look like a scene? By keys at the begin of lines, in a file that ends in .yaml or .yml anywhere.
bool is_moveit_scene(std::string_view name, std::string_view bytes);

/// What joints are at is held, and the start until a request says another. Throws InputError naming file and line,
/// Stopped.
Scene read_moveit_scene(const InputFile& file, const Execution& execution);

/// Start and goal of the scene become those of the request, and so do group, tool and held joints, in the world's line
/// of the robot, too; the group only where that has an SRDF. What the request attaches takes the place of what had its
/// id. Throws as above.
void take_moveit_request(Scene& scene, const InputFile& file, const Execution& execution);

}  // namespace warren
