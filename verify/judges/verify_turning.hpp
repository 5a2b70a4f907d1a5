// SPDX-License-Identifier: BSD-3-Clause
// Is this path of a turning polygon free? Independent of everything that found it: nothing from spatial/, nothing of
// the fast world's distances, motions or angles. Each leg is compared, at its middle, with all sides of obstacles
// within the body's radius and the clearance around it (verify/near/sides_near_legs; farther only where nothing is so
// near); obstacles that can't be the nearest anywhere on a piece are dropped from its halves, and pieces are halved
// until the least distance, less the way that any point of the body goes and less all rounding, is proved to exceed the
// clearance. O(obstacles) once, but for maps, then O(legs * sides near them * corners) and what the halves near
// obstacles cost.
// Legs without a turn need no halving: what the body sweeps there is a polygon. Legs that go on straight or turn on the
// spot are judged as one (pose_runs()), so what is near a path over a lattice is looked at once.
#pragma once

#include <optional>
#include <span>

#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/judges/verification.hpp"

namespace warren {

class ObstacleIndex;  // verify/near/obstacle_index.hpp

struct PoseVerifyOptions {
  double clearance = 0.0;                    ///< room around the body all along the path; >= 0; 0: touching is blocked
  std::optional<Se2> start = {};             ///< where the path must begin; nullopt: anywhere
  std::optional<Se2> goal = {};              ///< where it must end
  bool any_heading = false;                  ///< the goal's angle doesn't matter
  static constexpr double tolerance = 1e-9;  ///< of start and goal: distance and angle that still count as there
};

/// The body among the scene's walls, polygons and bounds; on a map among its cells, whose borders it reads from the
/// bits. Throws InputError for scenes that hold anything else, or nothing (verify/judges/leg_reports). On a leg the
/// reference point goes straight while the body turns evenly the shorter way; a leg of half a turn must be free both
/// ways. The path has at least one pose, all finite (InputError otherwise); a single pose is a leg of length zero. A
/// turning leg that runs within some millionths of the body's radius of an obstacle, beyond the clearance, may count as
/// not free. min_clearance is of the body along the path: a lower bound, within a thousandth of the body's radius;
/// where the path is not free, the least distance met. The same for any number of threads, with an index of this scene
/// and without; it is for scenes that are no maps.
Verification verify_se2(const Scene& scene, std::span<const Vec2> outline, std::span<const Se2> path,
                        const PoseVerifyOptions& options, const Execution& execution,
                        const ObstacleIndex* index = nullptr);

/// The same of a car: scenes, paths, errors, threads and index as of verify_se2(). Where it turns on the spot it may
/// turn as tightly as it likes, and its turning radius, > 0, is a scale of lengths. Legs turn by half a turn at most;
/// where a car that reverses could drive half a turn either way, both must be free. Poses may be off by some 1e-9
/// turning radii. min_clearance is around the body: a lower bound, sharp up to rounding; where the path is not free,
/// the least met.
Verification verify_car(const Scene& scene, const RobotSpec& car, std::span<const Se2> path,
                        const PoseVerifyOptions& options, const Execution& execution,
                        const ObstacleIndex* index = nullptr);

}  // namespace warren
