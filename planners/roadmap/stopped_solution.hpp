// SPDX-License-Identifier: BSD-3-Clause
// What a planner answers when it was stopped: why, and no path.
#pragma once

#include "core/base/solution.hpp"
#include "parallel/execution.hpp"

namespace warren {

/// Counts and times stay as they are.
template <class State>
void mark_stopped(Solution<State>& solution, const Stopped& stopped) {
  solution.outcome = Outcome::stopped;
  solution.stop_reason = stopped.reason;
  solution.path.clear();
}

}  // namespace warren
