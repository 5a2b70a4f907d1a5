// SPDX-License-Identifier: BSD-3-Clause
// The account of one solve: the answer, what it means, and what it took. Plain data; write_answer_io.hpp writes it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/path.hpp"
#include "core/base/solution.hpp"
#include "parallel/deadline.hpp"
#include "solve/answer/explanation.hpp"
#include "solve/answer/state_list.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/question/figure.hpp"
#include "solve/question/question.hpp"
#include "verify/judges/verification.hpp"

namespace warren {

/// Size of a decomposition.
struct CellCount {
  std::uint64_t cells = 0;        ///< free ones
  std::uint64_t adjacencies = 0;  ///< pairs of cells with a door between them
};

/// A path of a method that promises nothing, as its verification refuted it: what studies of such methods show.
struct RefutedPath {
  Violation violation;         ///< where it meets what
  double length = 0.0;         ///< as Answer::length
  std::optional<double> cost;  ///< as Answer::cost
  Path<Vec2> path;             ///< as Answer::path
  StateList states;            ///< as Answer::states
};

/// Why the body does not fit where it shall start or end.
struct BlockedEnd {
  bool is_start = true;                 ///< or else it is the goal
  std::string by;                       ///< what is in the way, as Violation::obstacle
  std::vector<double> free_place = {};  ///< near it, with the same heading; empty: none was found, or nobody looked
  double distance = 0.0;                ///< between the two; of joint angles, in joint space: rad
  std::string hint = {};                ///< what may have been meant; may be empty
  double room = 0.0;                    ///< between what is in the way and the body, of a disc its middle; of links
                                        ///< their surfaces: below 0 in a sphere
  double needed = 0.0;                  ///< the room that it needs; 0: it only may not touch
  /// How far the body, turned as it is, must go to be out of what is in the way, were that alone; of an arm, the
  /// deepest link. None where it does not stand in it.
  std::optional<double> depth = {};
};

/// What is left to say of a path whose points were handed on as they were made (core/base/path_taker.hpp).
struct HandedPath {
  std::uint64_t points = 0;  ///< their number
  std::string hash;          ///< solve/answer/path_hash.hpp
};

/// What solve() found: an outcome, a verified path where there is one, and the account of the work.
struct Answer {
  Outcome outcome = Outcome::stopped;     ///< how it ended
  std::optional<StopReason> stop_reason;  ///< only for stopped
  bool verified = false;                  ///< has it a path that a judge found free, with all its clearance?
  std::optional<BlockedEnd> blocked;      ///< where solve() was asked, not in studies
  std::optional<Explanation> explained;   ///< where explain_answer() was asked
  std::optional<RefutedPath> refuted;     ///< the answer says nothing else of that path
  double length = 0.0;                    ///< only where verified, as all that is said of the path
  double min_clearance = 0.0;             ///< room around the body along the path
  std::optional<double> raw_length;       ///< before it was pulled taut
  bool optimal = false;                   ///< proved: no shorter path exists
  std::optional<double> cost;             ///< in the planner's own units, where that is not the length
  std::optional<double> turn_rad;         ///< all turning along the path, of bodies that turn
  Problem problem;                        ///< what was asked, with what the world's file and the defaults add
  WorldAccount world;                     ///< of which world
  std::string planner;                    ///< who found it: "prm", "rrt-connect", …
  std::string pipeline;                   ///< plain, tiled or streamed; only for prm
  std::string sampler;                    ///< empty: the planner has none
  std::string search;                     ///< empty: the planner has none
  std::uint64_t seed = 1;                 ///< of all that was random
  unsigned threads = 1;                   ///< that worked
  std::vector<NamedFigure> options;  ///< those that were given, and those that were chosen where that tells something
  RoadmapSize roadmap;               ///< that was searched
  std::optional<CellCount> cells;    ///< of planners that make some
  std::vector<NamedFigure> figures;  ///< the planner's own keys
  std::vector<NamedFigure> path_figures;  ///< those that tell of the path
  Separation separation;                  ///< only for not_connected
  Counters counters;                      ///< exact, the same for any number of threads
  StageTimes seconds;                     ///< of each stage, wall-clock
  std::vector<StageCost> costs;           ///< of each link of the chain that solve() ran, verifying included
  double solve_s = 0.0;                   ///< of the whole call, wall-clock
  std::size_t peak_memory_bytes = 0;      ///< the most that the process has held so far
  Path<Vec2> path;  ///< of the reference point in the plane, as pictures show it; a point's or disc's states
  std::optional<HandedPath> handed;  ///< instead of `path`, where solve_within() was given a taker and used it
  StateList states;                  ///< start to goal, where a state is more than a point of the plane; else empty
  bool tells_path = true;            ///< does JSON list the path's states, or only their number and hash?
};

/// The number of the path's states, wherever they are.
inline std::uint64_t path_points(const Answer& answer) {
  if (answer.handed) return answer.handed->points;
  return answer.states.empty() ? answer.path.size() : answer.states.size();
}

/// Stages with the names that JSON and summary give them, in the order of the work.
std::vector<std::pair<const char*, double>> named_stages(const StageTimes& seconds);

}  // namespace warren
