// SPDX-License-Identifier: BSD-3-Clause
// What is said of start and goal where a planner calls one of them blocked. Planning keeps a little more room than it
// must, or takes a disc for the body that it holds; so the verification decides: an end that it takes is not blocked,
// the start comes first, and where both stand free nobody has proved anything.
#pragma once

#include "core/base/solution.hpp"

namespace warren {

/// start_stands_free(), goal_stands_free(): by the verification; asked only where the outcome is about an end.
template <class StartStandsFree, class GoalStandsFree>
Outcome settled_ends(Outcome outcome, const StartStandsFree& start_stands_free,
                     const GoalStandsFree& goal_stands_free) {
  if (outcome != Outcome::start_blocked && outcome != Outcome::goal_blocked) return outcome;
  if (!start_stands_free()) return Outcome::start_blocked;
  return goal_stands_free() ? Outcome::not_connected : Outcome::goal_blocked;
}

}  // namespace warren
