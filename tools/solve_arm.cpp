// SPDX-License-Identifier: BSD-3-Clause
// A Puma 560 among spheres. This version has no planner for it yet.
#include "tools/solve_kind.hpp"

namespace warren {
namespace {

bool fits_arm(const Scene&, const RobotSpec& robot) { return robot.kind == RobotKind::puma560; }

}  // namespace

SolveKind arm_kind() { return {"an arm", fits_arm, {}, {}, nullptr, nullptr, nullptr, nullptr}; }

}  // namespace warren
