// SPDX-License-Identifier: BSD-3-Clause
// Guided planning: a way through given way-points, one plan after the other, each from where the last one ended. Where
// a way-point may be met in several states (any heading), the plan to it chooses; that choice is not taken back.
#pragma once

#include <span>
#include <vector>

#include "core/base/solution.hpp"

namespace warren {

/// stops: way-points and at last the goals, each as the states that will do. plan(start, states, leg) -> Solution.
/// The path leads through all of them; counters and sizes are summed up. The first leg that is not solved ends it.
template <class State, class Plan>
Solution<State> plan_through(const State& start, std::span<const std::vector<State>> stops, const Plan& plan) {
  Solution<State> whole;
  whole.path.push_back(start);
  for (std::size_t leg = 0; leg < stops.size(); ++leg) {
    Solution<State> part = plan(State(whole.path.back()), std::span<const State>(stops[leg]), leg);
    whole.outcome = part.outcome;
    whole.stop_reason = part.stop_reason;
    whole.separation = part.separation;
    whole.counters += part.counters;
    whole.seconds.search += part.seconds.search;
    whole.roadmap.milestones += part.roadmap.milestones;
    whole.roadmap.edges += part.roadmap.edges;
    whole.roadmap.components = part.roadmap.components;
    if (part.outcome != Outcome::solved) {
      whole.path.clear();
      return whole;
    }
    whole.path.insert(whole.path.end(), part.path.begin() + 1, part.path.end());
  }
  return whole;
}

}  // namespace warren
