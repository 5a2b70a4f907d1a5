// SPDX-License-Identifier: BSD-3-Clause
// Is the path of an arm free? The judge, not a planner: it shares nothing with worlds/arms/arm_world but the table.
// Matrices are multiplied out, every capsule is measured against every obstacle, and the bound on what moves is the
// plainest one that is true: no point is farther from an axis than the links between them are long, all told.
//
// On a leg the joints turn evenly, all at once. It is cut at its middle; the least distance there less what the link
// can move to either side is proved for the whole piece; where that is not enough, the halves are looked at. Obstacles
// that are far at one piece are not looked at in its halves, so a leg costs some hundreds of matrices, and each
// obstacle is measured a few times.
#pragma once

#include <optional>
#include <span>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/judges/verification.hpp"

namespace warren {

struct ArmVerifyOptions {
  double radius = 0.05;                  ///< of the links' capsules; >= 0
  double clearance = 0.0;                ///< room around them all along the path; >= 0; 0: touching is blocked
  bool self_collision = false;           ///< must links that are no neighbours keep apart?
  std::optional<JointState> start = {};  ///< where the path must begin; nullopt: anywhere
  std::optional<JointState> goal = {};   ///< where it must end
  std::optional<Vec3> goal_place = {};   ///< where the tool must end
  double tolerance = 1e-9;               ///< of start, goal and limits: an angle or distance that still counts as there
};

/// The arm among the scene's spheres and boxes, or in free space, within its limits. Throws InputError for scenes with
/// walls, polygons, bounds or a map: these have no height (verify/judges/judged_input). The path has at least one
/// state, all finite (InputError otherwise); a single state is a leg of length zero. A leg that runs within a millionth
/// of the arm's size of an obstacle, beyond the clearance, may count as not free. min_clearance is of the arm along the
/// path: a lower bound, within a hundredth of the links' radius; where the path is not free, the least distance met.
/// The same for any number of threads.
Verification verify_arm(const Scene& scene, const DhTable& table, std::span<const JointState> path,
                        const ArmVerifyOptions& options, const Execution& execution);

}  // namespace warren
