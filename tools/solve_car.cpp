// SPDX-License-Identifier: BSD-3-Clause
// A car among walls and polygons. This version has no planner for it yet.
#include "tools/solve_kind.hpp"

namespace warren {
namespace {

bool fits_car(const Scene& scene, const RobotSpec& robot) {
  return robot.kind == RobotKind::car && scene.spheres.empty();
}

}  // namespace

SolveKind car_kind() { return {"a car", fits_car, {}, {}, nullptr, nullptr, nullptr, nullptr}; }

}  // namespace warren
