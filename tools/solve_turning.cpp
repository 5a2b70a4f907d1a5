// SPDX-License-Identifier: BSD-3-Clause
// A body that turns (a polygon, a car) among walls and polygons. This version has no planner for it yet.
#include "tools/solve_kind.hpp"

namespace warren {
namespace {

bool fits_turning(const Scene& scene, const RobotSpec& robot) {
  return (robot.kind == RobotKind::polygon || robot.kind == RobotKind::car) && scene.spheres.empty();
}

}  // namespace

SolveKind turning_kind() { return {"a turning body", fits_turning, {}, {}, nullptr, nullptr, nullptr, nullptr}; }

}  // namespace warren
