// SPDX-License-Identifier: BSD-3-Clause
// Is the path of an arm free? The judge, not a planner: it shares nothing with worlds/arms but plain data. Frames are
// multiplied out, distances are verify/judges/judged_arm's, and the bounds on what moves are lengths added up.
//
// On a leg the variables go evenly, all at once. It is cut at its middle; where two bodies are apart there by more than
// they can close up to either side, they are proved for the whole piece; where they are not, the halves are looked at.
// How much that is is the smaller of two numbers, h being half the piece:
// - all the way that they go: h times their speeds, added;
// - what they go along the direction n from one to the other. A body turns by w and drifts by u at the middle, so its
//   point x is at x + t (u + w cross x) + rest, |rest| <= t t / 2 times its bend; along n that is t n.u +
//   (n + t n cross w).x + rest, and the most of it, over all x of the body, is a support, convex in t: the ends decide.
// Speed and bend, the most that the first and second derivative of any point can be, by the joints from the link back:
// a joint that turns by w (of a leg) holds a point p in front of it as R p, so (R p)'' = w w R''p + 2 w R'p' + R p'' is
// at most w w |p| + 2 w |p'| + |p''|, and (R p)' at most w |p| + |p'|; one that slides by w adds w to |p'|; |p| grows
// by the lengths between joints. Two links are held against each other in the frame of the last joint that moves both.
//
// A ball around all of a link goes first. Pairs that are proved on a piece are not looked at in its halves, so a leg
// costs some hundreds of frames, and each obstacle is measured a few times.
#pragma once

#include <Eigen/Geometry>

#include <optional>
#include <span>

#include "core/run/execution.hpp"
#include "scenes/scene/arm_model.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/judges/verification.hpp"

namespace warren {

struct ArmVerifyOptions {
  double clearance = 0.0;                ///< room around the arm all along the path; >= 0; 0: touching is blocked
  std::optional<JointState> start = {};  ///< where the path must begin; nullopt: anywhere
  std::optional<JointState> goal = {};   ///< where it must end
  std::optional<Vec3> goal_place = {};   ///< where the tool must end
  std::optional<Eigen::Isometry3d> goal_pose = {};  ///< the same with the tool's turn
  /// Of start, goal and limits: an angle or distance that still counts as there.
  static constexpr double tolerance = 1e-9;
};

/// The arm among the scene's spheres, boxes and solids, or in free space, within its limits, with the links of its
/// pairs apart. Continuous variables go the shorter way; where that is half a turn, as std::remainder has it. Throws
/// InputError for scenes with walls, polygons, bounds or a map: these have no height (verify/judges/leg_reports); and
/// for models whose numbers name no joint, variable or link, whose frames are not rigid within 1e-12. The path has at
/// least one state, all finite (InputError otherwise); a single state is a leg of length zero. A leg that runs within a
/// millionth of the arm's size of an obstacle, beyond the clearance, may count as not free. min_clearance is of the arm
/// along the path: a lower bound, within a hundredth of the largest radius of its spheres and capsules, or, where that
/// is more, a ten-thousandth of its size; where the path is not free, the least distance met. The length's angles are
/// radians. The same for any number of threads.
Verification verify_arm(const Scene& scene, const ArmModel& model, std::span<const JointState> path,
                        const ArmVerifyOptions& options, const Execution& execution);

}  // namespace warren
