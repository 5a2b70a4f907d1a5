// SPDX-License-Identifier: BSD-3-Clause
// Which states bring an arm's tool to a place, or to a pose? By numbers, for any tree of joints: from the seed and from
// random states within the limits, steps of least squares (Levenberg, Marquardt, with the damping of Sugihara: in
// proportion to the square of what is missing), with variables held at a limit that a step would leave. Errors are
// angles, and lengths in units of the arm's own. Cost: 0.4 us a step and joint, 10 to 60 steps a start.
#pragma once

#include <cstddef>
#include <vector>

#include "core/run/execution.hpp"
#include "worlds/arms/arm_kinematics.hpp"

namespace warren {

/// What the tool shall be at, in the base's frame.
struct ToolGoal {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  bool place_only = false;  ///< the tool may be turned anyhow
};

/// States within the limits that do, to 1e-9 of the world's unit and 1e-9 rad; any two differ by more than 1e-6 in some
/// variable, nearest to the seed first (each variable by its own unit, the wrap counts); variables that do not move the
/// tool stay as the seed has them. At most `enough`, >= 1; after 100 starts, or 10 for each that is asked for,
/// none more. Deterministic. Throws Stopped.
std::vector<JointState> postures_of_tool(const ArmKinematics& arm, const ToolGoal& goal, const JointState& seed,
                                         std::size_t enough, const Execution& execution = {});

}  // namespace warren
