// SPDX-License-Identifier: BSD-3-Clause
// Is this path of a car drivable, and free? Independent of everything that found it: no steering curve is computed
// here, nothing from spatial/ is used. The path is a list of poses; between two of them the car keeps its steering
// wheel still, so two poses say all about a leg: its chord lies along the heading halfway, and length and turn give the
// radius, forwards or backwards. A leg whose poses contradict that, that turns tighter than the turning radius, or that
// goes backwards where the car can't, is refused.
//
// On a leg the body turns about a point (or goes straight), so its corners follow arcs, and in its eyes the corners of
// the obstacles do: the least distance is a minimum over arcs and sides in closed form (worlds/arc_distance.hpp). No
// halving, no sampling. O(legs * sides * corners), but for sides whose boxes are far.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/se2.hpp"
#include "parallel/execution.hpp"
#include "worlds/scene.hpp"
#include "worlds/verify.hpp"

namespace warren {

/// What drives.
struct VerifiedCar {
  double turning_radius = 1.0;     ///< > 0
  bool reverses = false;           ///< may it back up?
  double radius = 0.0;             ///< of a disc around the reference point; >= 0
  std::vector<Vec2> outline = {};  ///< a polygon instead; then radius is 0
};

struct CarVerifyOptions {
  double clearance = 0.0;         ///< room around the body all along the path; >= 0; 0: touching is blocked
  std::optional<Se2> start = {};  ///< where the path must begin; nullopt: anywhere
  std::optional<Se2> goal = {};   ///< where it must end
  bool any_heading = false;       ///< the goal's angle doesn't matter
  double tolerance = 1e-9;        ///< of start and goal: distance and angle that still count as there
};

struct CarVerification {
  bool verified = false;
  double length = 0.0;    ///< of the reference point's curve
  double turn_rad = 0.0;  ///< sum of the turns
  std::size_t cusps = 0;  ///< changes between forwards and backwards
  double reversed = 0.0;  ///< length of what is driven backwards
  /// Room around the body along the path: a lower bound, sharp up to rounding.
  double min_clearance = std::numeric_limits<double>::infinity();
  std::optional<Violation> first_violation;  ///< on the smallest leg
};

/// The car among the scene's walls, polygons and bounds (spheres are not looked at). Legs turn by half a turn at most.
/// Poses may be off by some 1e-9 turning radii. The path has at least one pose, all finite (InputError otherwise); a
/// single pose is a leg of length zero. The same for any number of threads.
CarVerification verify_car(const Scene& scene, const VerifiedCar& car, std::span<const Se2> path,
                           const CarVerifyOptions& options, const Execution& execution);

}  // namespace warren
