// SPDX-License-Identifier: BSD-3-Clause
// What is said of start and goal where a planner calls one of them blocked. A planner may take a disc for the body that
// it holds; so the verification decides: an end that it takes is not blocked, the start comes first, and where both
// stand free nobody has proved anything. Planning keeps a little more room than a path must, and so must ends: the
// verification is asked with end_margin() more, so that all planners say the same of an end that only touches.
#pragma once

#include <algorithm>
#include <string_view>

#include "core/base/solution.hpp"
#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"

namespace warren {

/// Of an end that has its room, but none to spare.
inline constexpr std::string_view touching_hint =
    "the body has its room there but only just: an end needs a billionth to spare, as planning keeps it";

/// Of a point or disc that keeps `reach`; on a map `cell` is a cell's side. Above what planning keeps there
/// (worlds/plane): a billionth.
inline double end_margin(double reach, double cell = 0.0) { return 2e-9 * std::max(reach, cell); }

/// Of any body that reaches as far as `extent` from its reference point, an arm's base: above what planning keeps
/// (worlds/poses/obstacle_tree, worlds/arms/arm_world). Of bodies that turn and arms one pass over the obstacles.
/// Throws Stopped.
double end_margin(const Scene& scene, const RobotSpec& robot, double clearance, double extent,
                  const Execution& execution);

/// start_stands_free(), goal_stands_free(): by the verification; asked only where the outcome is about an end.
template <class StartStandsFree, class GoalStandsFree>
Outcome settled_ends(Outcome outcome, const StartStandsFree& start_stands_free,
                     const GoalStandsFree& goal_stands_free) {
  if (!is_blocked(outcome)) return outcome;
  if (!start_stands_free()) return Outcome::start_blocked;
  return goal_stands_free() ? Outcome::not_connected : Outcome::goal_blocked;
}

}  // namespace warren
