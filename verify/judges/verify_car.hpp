// SPDX-License-Identifier: BSD-3-Clause
// Is this path of a car drivable, and free? Independent of everything that found it: no steering curve is computed
// here, nothing from spatial/ is used. The path is a list of poses; between two of them the car keeps its steering
// wheel still, so two poses say all about a leg: its chord lies along the heading halfway, and length and turn give the
// radius, forwards or backwards. A leg whose poses contradict that, that turns tighter than the turning radius, or that
// goes backwards where the car can't, is refused.
//
// The whole body is judged (verify/judges/body_on_leg.hpp): at each pose neither lies in an obstacle nor an obstacle in
// it, and nothing lies across it. On a leg the body turns about a point (or goes straight), so its corners follow arcs,
// and in its eyes the corners of the obstacles do: from there on the least distance is a minimum over arcs and sides in
// closed form (verify/exact/exact_segments.hpp). No halving, no sampling. O(obstacles) once, but for maps, then
// O(legs * sides near them * corners).
#pragma once

#include <span>
#include <vector>

#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "verify/judges/verification.hpp"
#include "verify/judges/verify_turning.hpp"

namespace warren {

/// What drives.
struct VerifiedCar {
  double turning_radius = 1.0;     ///< > 0
  bool reverses = false;           ///< may it back up?
  bool turns_on_spot = false;      ///< may it turn as tightly as it likes? Then turning_radius is a scale of lengths
  double radius = 0.0;             ///< of a disc around the reference point; >= 0
  std::vector<Vec2> outline = {};  ///< a polygon instead; then radius is 0
};

/// The car among the scene's walls, polygons and bounds; on a map among its cells, whose borders are read from the
/// bits. Throws InputError for scenes that hold anything else, or nothing (verify/judges/judged_input). Legs turn by
/// half a turn at most; where a car that reverses could drive half a turn either way, both must be free. Poses may be
/// off by some 1e-9 turning radii. The path has at least one pose, all finite (InputError otherwise); a single pose is
/// a leg of length zero. min_clearance is around the body: a lower bound, sharp up to rounding; where the path is not
/// free, the least met. The same for any number of threads, with an index of this scene and without; it is for scenes
/// that are no maps.
Verification verify_car(const Scene& scene, const VerifiedCar& car, std::span<const Se2> path,
                        const PoseVerifyOptions& options, const Execution& execution,
                        const ObstacleIndex* index = nullptr);

}  // namespace warren
