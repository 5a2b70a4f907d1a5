// SPDX-License-Identifier: BSD-3-Clause
// What a planner returns: an answer, the path that goes with it, and the account of the work.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "core/base/counters.hpp"
#include "core/base/enum_names.hpp"
#include "core/base/path.hpp"
#include "core/base/stop_reason.hpp"

namespace warren {

/// How a plan ended. An answer, never an error.
enum class Outcome : std::uint8_t { solved, start_blocked, goal_blocked, not_connected, infeasible, stopped };

constexpr auto enum_names(Outcome) {
  return std::array<std::string_view, 6>{"solved",        "start_blocked", "goal_blocked",
                                         "not_connected", "infeasible",    "stopped"};
}
/// Is an end of the question blocked?
constexpr bool is_blocked(Outcome outcome) {
  return outcome == Outcome::start_blocked || outcome == Outcome::goal_blocked;
}

/// Size of the roadmap that gave the answer.
struct RoadmapSize {
  std::uint64_t milestones = 0;  ///< start and goal included
  std::uint64_t edges = 0;       ///< undirected; lazy planners: edges that were checked and found free
  std::uint64_t components = 0;  ///< 0 where the planner doesn't compute them (lazy ones)
  std::uint64_t samples = 0;     ///< drawn in the last round, by planners that draw them in rounds
  std::uint64_t end_edges = 0;   ///< those of the edges that lead to start or goal; told by the tiled lattice alone
};

/// Why start and goal are not joined: sizes of their components, and the shortest distance between a milestone of one
/// and a milestone of the other (in the world's metric). Where nobody measured it, nothing of it is known.
struct Separation {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();  ///< a distance that nobody measured
  std::uint64_t start_size = 0;                        ///< milestones that the start can reach, itself included
  std::uint64_t goal_size = 0;                         ///< the same of the goal
  double nearest_gap = unknown;                        ///< shortest distance between the two; unknown: not measured
  std::array<double, 2> near_start{unknown, unknown};  ///< where these two stand, of bodies of the plane: x and y
  std::array<double, 2> near_goal{unknown, unknown};   ///< the one of the goal's
  /// Was it measured? A start that can reach anything reaches itself.
  bool is_known() const { return start_size > 0; }
};

/// What a planner gives back, in its own states.
template <class State>
struct Solution {
  Outcome outcome = Outcome::not_connected;   ///< how it ended
  StopReason stop_reason = StopReason::time;  ///< only for stopped
  Path<State> path;                           ///< start to goal; empty unless solved
  RoadmapSize roadmap;                        ///< that was searched
  Separation separation;                      ///< only for not_connected
  Counters counters;                          ///< exact, the same for any thread count
  StageTimes seconds;                         ///< wall-clock
};

}  // namespace warren
