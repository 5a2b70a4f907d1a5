// SPDX-License-Identifier: BSD-3-Clause
// Joins polygons and walls of the plane with the planners that take them: a point or disc among polygons. This version
// has no planner for it yet.
#include "tools/solve_kind.hpp"

namespace warren {
namespace {

bool fits_plane(const Scene& scene, const RobotSpec& robot) {
  return (robot.kind == RobotKind::point || robot.kind == RobotKind::disc) && scene.spheres.empty();
}

}  // namespace

SolveKind plane_kind() {
  return {"a point or disc among polygons", fits_plane, {}, {}, nullptr, nullptr, nullptr, nullptr};
}

}  // namespace warren
