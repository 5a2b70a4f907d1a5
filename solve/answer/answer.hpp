// SPDX-License-Identifier: BSD-3-Clause
// The account of one solve: the answer, what it means, and what it took. Plain data; write_answer_io.hpp writes it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "solve/answer/world_account.hpp"
#include "solve/question/question.hpp"
#include "verify/judges/verification.hpp"
#include "verify/judges/verify_bound.hpp"

namespace warren {
// What a planner tells of its work beyond what all planners do.

/// An edge of a sampled visibility graph that passes through an obstacle.
struct WrongEdge {
  std::uint32_t from;  ///< number of a corner
  std::uint32_t to;    ///< number of a corner
  double depth;        ///< how far inside, world units
};

/// What a planner tells beside what all tell.
using Figure =
    std::variant<bool, std::uint64_t, double, std::string, std::vector<std::uint64_t>, std::vector<WrongEdge>>;

/// A figure with its key in JSON.
struct NamedFigure {
  std::string name;  ///< the key
  Figure value;      ///< of the unit that the key says
};

/// The figure of that name, or nullptr.
inline const Figure* figure_named(const std::vector<NamedFigure>& figures, std::string_view name) {
  const auto found = std::ranges::find(figures, name, &NamedFigure::name);
  return found != figures.end() ? &found->value : nullptr;
}

// What became of the work of a solve beyond what its answer tells anyhow: which stage lost what, where it is narrow,
// and what would likely help. Plain data; exact, and the same for any number of threads.

/// Of the graph of a roadmap all of whose edges were checked; start and goal count as milestones.
struct ComponentFacts {
  std::uint64_t count = 0;       ///< components
  std::uint64_t milestones = 0;  ///< in all of them
  std::uint64_t largest = 0;     ///< milestones in the largest
  std::uint64_t alone = 0;       ///< components of one milestone
  std::uint64_t of_start = 0;    ///< milestones in the one of the start
  std::uint64_t of_goal = 0;     ///< milestones in the one of the goal
  bool joined = false;           ///< are start and goal in one?
};

/// Where the body has least room along the path.
struct NarrowPlace {
  std::uint64_t leg = 0;      ///< from this state of the path to the next, from 0
  std::optional<Vec2> place;  ///< of the reference point; of bodies that turn where the leg begins, of arms none
  double clearance = 0.0;     ///< room around the body there, world units
  /// Of so many uniform samples one falls into a square as wide as that room; of paths over samples alone.
  std::optional<double> one_sample_in;
};

/// What would likely help, as words of the command that was given or of another one.
struct Hint {
  std::string verb;                ///< whose options they are; empty: of the command that gave this answer
  std::vector<std::string> words;  ///< options to add or to replace; empty: it takes more than an option
  std::string why;                 ///< what they would do
};

/// What an answer means: what became of the roadmap, where it is narrow, what would help.
struct Explanation {
  std::optional<ComponentFacts> components;  ///< of prm, where the graph is there and its edges lead both ways
  std::optional<NarrowPlace> narrowest;      ///< of a path that keeps a distance
  std::vector<Hint> hints;                   ///< where there is no path, the likeliest first; this world takes them
  std::optional<StopReason> stopped;         ///< why what is missing here is
};

// The states of a path, whatever the body: so many numbers each, one after the other.

/// States of any body, one after the other.
struct StateList {
  std::size_t width = 2;        ///< numbers a state: 2, 3, or an arm's joints
  std::vector<double> numbers;  ///< width * size() of them

  /// States.
  std::size_t size() const { return numbers.size() / width; }
  /// Are there none?
  bool empty() const { return numbers.empty(); }
  /// The numbers of state i; i < size().
  std::span<const double> operator[](std::size_t i) const { return std::span(numbers).subspan(i * width, width); }
  /// state has `width` numbers.
  void add(std::span<const double> state) { numbers.insert(numbers.end(), state.begin(), state.end()); }
};

/// Of states of three numbers.
inline std::vector<Se2> poses_of(const StateList& states) {
  std::vector<Se2> poses;
  for (std::size_t i = 0; i < states.size(); ++i) poses.push_back({states[i][0], states[i][1], states[i][2]});
  return poses;
}

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

/// Where a path ends that had a choice, and what was asked.
struct GoalReached {
  std::vector<double> asked;             ///< the goal that was meant
  double distance = 0.0;                 ///< of the path's end to it
  std::optional<double> distance_bound;  ///< proved: no place that can be reached is nearer
};

/// The cheapest path of another homotopy class.
struct AlternativePath {
  double cost = 0.0;                 ///< as Answer::cost
  double length = 0.0;               ///< as Answer::length
  PriceParts price;                  ///< as Answer::price
  double min_clearance = 0.0;        ///< as Answer::min_clearance
  std::vector<std::int32_t> passed;  ///< its class: holes whose cuts it crosses, below 0 from the other side
  Path<Vec2> path;                   ///< as Answer::path
};

/// What makes homotopy classes on a map: cells that a body's middle may not enter, which hang together by sides or
/// corners and do not reach the map's border.
struct MapHole {
  std::uint32_t id = 0;  ///< from 1, by the lowest cell of each, row by row from below
  Box box;               ///< around its cells, in world coordinates
};

/// What became of an older path that was to be kept.
struct KeptRoute {
  bool kept = false;                ///< does the path go on along it?
  std::optional<double> kept_cost;  ///< of its rest, with the leg that joins it; none: it is not free
  std::optional<double> new_cost;   ///< of the path that was planned anew; none: there is none
};

/// What is left to say of a path whose points were handed on as they were made (core/base/solution.hpp).
struct HandedPath {
  std::uint64_t points = 0;  ///< their number
  std::string hash;          ///< solve/answer/write_answer_io.hpp
};

/// A path and what is said of it that can be verified: an answer's own, or one that a file holds.
struct ClaimedPath {
  bool optimal = false;               ///< proved: no shorter path exists but for 1e-9; of a disc: than with its arcs
  std::optional<double> lower_bound;  ///< proved: no path has less cost or, where that is not told, length
  std::optional<double> cost;         ///< in the planner's own units, where that is not the length
  std::optional<PriceParts> price;    ///< where prices were asked: then cost is length and all its parts
  std::string bound_of;               ///< of a priced lower bound: "all" paths, or those over the "lattice"; else empty
  std::optional<std::uint64_t> goal_index;    ///< of several goals, from 0: the one that is reached
  std::optional<GoalReached> goal_reached;    ///< where the question left a choice of places
  std::vector<std::uint64_t> order;           ///< of places to visit, from 0, as they are visited
  std::vector<AlternativePath> alternatives;  ///< the cheapest first; the path itself is none of them
  std::vector<std::int32_t> passed;           ///< where alternatives were asked: the class of the path itself
  std::vector<MapHole> holes;                 ///< those that the classes name
  std::optional<double> hole_size;   ///< where alternatives are told: the longer side of a hole's box, at least
  std::optional<KeptRoute> keeping;  ///< where an older path was to be kept
  Path<Vec2> path;   ///< of the reference point in the plane, as pictures show it; a point's or disc's states
  StateList states;  ///< start to goal, where a state is more than a point of the plane; else empty

  /// States of the path.
  std::size_t state_count() const { return states.empty() ? path.size() : states.size(); }
  /// Numbers a state.
  std::size_t state_width() const { return states.empty() ? 2 : states.width; }
  /// The numbers of state i, where they are.
  std::span<const double> numbers(std::size_t i) const {
    static_assert(sizeof(Vec2) == 2 * sizeof(double));
    return states.empty() ? std::span<const double>(&path[i].x, 2) : states[i];
  }
  /// A copy of them.
  std::vector<double> state(std::size_t i) const { return {numbers(i).begin(), numbers(i).end()}; }
};

/// What solve() found: an outcome, a verified path where there is one, and the account of the work.
struct Answer : ClaimedPath {
  Outcome outcome = Outcome::stopped;     ///< how it ended
  std::optional<StopReason> stop_reason;  ///< of stopped, and of planners that get better until they are stopped
  bool verified = false;                  ///< has it a path that a judge found free, with all its clearance?
  std::optional<BlockedEnd> blocked;      ///< where solve() was asked, not in studies
  std::optional<Explanation> explained;   ///< where explain_answer() was asked
  std::optional<RefutedPath> refuted;     ///< the answer says nothing else of that path
  double length = 0.0;                    ///< only where verified, as all that is said of the path
  double min_clearance = 0.0;             ///< room around the body along the path
  std::optional<double> raw_length;       ///< before it was pulled taut
  std::vector<Improvement> improvements;  ///< of planners that get better with time: each path that was the best so far
  std::optional<std::uint64_t> iterations;  ///< the turns that these have done: as many give the same answer
  /// Of these: optimum, goal, lattice, gap, goal_gap, lattice_gap, iterations, nodes, caller, or as stop_reason; empty:
  /// others.
  std::string ended_by;
  std::optional<double> turn_rad;    ///< all turning along the path, of bodies that turn
  Problem problem;                   ///< what was asked, with what the world's file and the defaults add
  WorldAccount world;                ///< of which world
  std::string planner;               ///< who found it: "prm", "rrt-connect", …
  std::string pipeline;              ///< plain, tiled or streamed; only for prm
  std::string sampler;               ///< empty: the planner has none
  std::string search;                ///< empty: the planner has none
  std::uint64_t seed = 1;            ///< of all that was random
  unsigned threads = 1;              ///< that worked
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
  std::size_t wanted_memory_bytes = 0;    ///< stopped by memory: the least that it needs, as far as known; else 0
  std::size_t peak_memory_bytes = 0;      ///< the most that the process has held so far
  std::optional<HandedPath> handed;       ///< instead of `path`, where solve_within() was given a taker and used it
  bool tells_path = true;                 ///< does JSON list the path's states, or only their number and hash?
};

/// How much more than the lower bound the path costs, as a share of that; none where either is not known.
inline std::optional<double> gap_of(const Answer& answer) {
  if (!answer.verified || !answer.lower_bound) return std::nullopt;
  const double cost = answer.cost.value_or(answer.length);
  if (!(*answer.lower_bound > 0.0)) return cost > 0.0 ? std::nullopt : std::optional(0.0);
  return std::max(0.0, cost / *answer.lower_bound - 1.0);
}

/// The number of the path's states, wherever they are.
inline std::uint64_t path_points(const Answer& answer) {
  return answer.handed ? answer.handed->points : answer.state_count();
}

/// Its threads, what it has held, and what was refused it. Called where an answer is complete.
inline void tell_process(Answer& answer, const Execution& execution) {
  answer.threads = thread_count(execution.threads);
  answer.peak_memory_bytes = peak_resident_bytes();
  const bool is_refused = answer.stop_reason == StopReason::memory && execution.deadline != nullptr;
  answer.wanted_memory_bytes = is_refused ? execution.deadline->wanted_bytes() : 0;
}

/// Stages with the names that JSON and summary give them, in the order of the work.
std::vector<std::pair<const char*, double>> named_stages(const StageTimes& seconds);

/// What a judge says of a path, and about which question: the members of Verification (verified, length, min_clearance
/// around the body, first_violation, …) and the problem that was judged.
struct Verdict : Verification {
  Problem problem;                            ///< that was judged
  BoundVerdict bound = BoundVerdict::absent;  ///< of the lower bound that the answer claims
};

}  // namespace warren
