// SPDX-License-Identifier: BSD-3-Clause
// A body on an occupancy map. This version has no planner for it yet.
#include "tools/solve_kind.hpp"

namespace warren {
namespace {

bool fits_occupancy(const Scene&, const RobotSpec&) { return false; }

}  // namespace

SolveKind occupancy_kind() {
  return {"a body on an occupancy map", fits_occupancy, {}, {}, nullptr, nullptr, nullptr, nullptr};
}

}  // namespace warren
