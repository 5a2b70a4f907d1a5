// SPDX-License-Identifier: BSD-3-Clause
// What a planner returns: an answer, the path that goes with it, and the account of the work.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"

namespace warren {

/// What a planner has done: exact, the same for any number of threads.
struct Counters {
  std::uint64_t samples = 0;  ///< states drawn
  std::uint64_t kept = 0;     ///< of samples, the states that became milestones: free, and as the sampler wants
  std::uint64_t neighbour_queries = 0;  ///< k-nearest or radius queries
  std::uint64_t edges_checked = 0;      ///< motions tested for collision
  std::uint64_t edges_free = 0;         ///< of edges_checked, those that nothing blocks
  std::uint64_t expanded = 0;           ///< vertices settled by the search
  std::uint64_t rounds = 0;             ///< roadmaps built, lazy repairs or batches of trees made
  std::uint64_t refused = 0;            ///< motions that were neither proved free nor blocked, of edges_checked
  std::uint64_t pushes = 0;     ///< vertices that came into the search's queue; of planners that join samples alone
  std::uint64_t decreases = 0;  ///< times that one in the queue got a shorter way; the same
  std::uint64_t row_bytes = 0;  ///< of the CSR rows that were assembled; the same
  /// Adds all of them.
  Counters& operator+=(const Counters& o) {
    for (const auto count : {&Counters::samples, &Counters::kept, &Counters::neighbour_queries,
                             &Counters::edges_checked, &Counters::edges_free, &Counters::expanded, &Counters::rounds,
                             &Counters::refused, &Counters::pushes, &Counters::decreases, &Counters::row_bytes}) {
      this->*count += o.*count;
    }
    return *this;
  }
  friend bool operator==(const Counters&, const Counters&) = default;
};

/// Wall-clock seconds of each stage.
struct StageTimes {
  double generate = 0.0;    ///< making a maze
  double read = 0.0;        ///< reading a file
  double index = 0.0;       ///< indexes over obstacles and free cells
  double sample = 0.0;      ///< drawing states
  double neighbours = 0.0;  ///< finding each state's neighbours
  double connect = 0.0;     ///< checking motions
  double graph = 0.0;       ///< joining edges to a graph, or cells to a decomposition
  double reduce = 0.0;      ///< taking what no path needs out of a lattice's graph
  double search = 0.0;      ///< searching; of trees, growing them
  double optimise = 0.0;    ///< pulling the path taut
  double verify = 0.0;      ///< judging the path
  /// Adds all of them.
  StageTimes& operator+=(const StageTimes& o) {
    for (const auto stage : {&StageTimes::generate, &StageTimes::read, &StageTimes::index, &StageTimes::sample,
                             &StageTimes::neighbours, &StageTimes::connect, &StageTimes::graph, &StageTimes::reduce,
                             &StageTimes::search, &StageTimes::optimise, &StageTimes::verify}) {
      this->*stage += o.*stage;
    }
    return *this;
  }
};

/// What a stage cost in all its rounds. Where one stage has several links of a chain, each has its own.
struct StageCost {
  std::string name;     ///< of the link
  double wall_s = 0.0;  ///< by the clock
  double cpu_s = 0.0;   ///< of all threads of the process
};

/// A path is the list of its states, start to goal. A long one is made of pooled pages (core/base/page_pool.hpp): where
/// one run follows another, the first touch of fresh pages took more time than to find the states.
template <class State>
using Path = RawVector<State>;

/// Sum of the motions' lengths, in the path's order. States: a contiguous list of them.
template <std::ranges::contiguous_range States, class Distance>
double path_length(const States& path, Distance&& distance_between) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance_between(path[i - 1], path[i]);
  return length;
}

/// The sums of the motions' lengths from the path's begin to each of its states.
template <std::ranges::contiguous_range States, class Distance>
std::vector<double> lengths_along(const States& path, Distance&& distance_between) {
  std::vector<double> along(path.size(), 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) along[i] = along[i - 1] + distance_between(path[i - 1], path[i]);
  return along;
}

/// A place on a path: at a share, 0 to 1, of the motion from its state `leg`.
struct PlaceOnPath {
  std::size_t leg = 0;  ///< the path's states but the last
  double share = 0.0;   ///< of the motion's length
};

/// Where one is after a way from the path's begin. along: lengths_along() of two states or more.
inline PlaceOnPath place_on_path(std::span<const double> along, double way) {
  const auto next = std::upper_bound(along.begin() + 1, along.end() - 1, way);
  const auto leg = static_cast<std::size_t>(next - along.begin()) - 1;
  const double length = along[leg + 1] - along[leg];
  return {leg, length > 0.0 ? std::clamp((way - along[leg]) / length, 0.0, 1.0) : 0.0};
}

/// Why a computation was stopped before its end.
enum class StopReason : std::uint8_t { time, memory, interrupt, terminate, hang_up };
/// As answers say it.
constexpr auto enum_names(StopReason) {
  return std::array<std::string_view, 5>{"budget", "memory", "SIGINT", "SIGTERM", "SIGHUP"};
}

/// As people are told it.
constexpr std::string_view text_of(StopReason reason) {
  constexpr std::array<std::string_view, 5> texts{"the time budget ended", "it needs more memory than it may hold",
                                                  "interrupted", "terminated", "the terminal was closed"};
  return texts[static_cast<std::size_t>(reason)];
}

/// Was it a signal?
constexpr bool is_signal(StopReason reason) { return reason >= StopReason::interrupt; }

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

/// A path that is better than those before it, of a planner that gets better with time.
struct Improvement {
  std::uint64_t iterations = 0;  ///< turns that were done when it came
  double seconds = 0.0;          ///< since the search began, wall-clock
  double cost = 0.0;             ///< in the body's metric, which is what gets better
  double length = 0.0;           ///< as answers have it
  std::string by;                ///< the part that found it: straight, tree, restarts, roadmap, shorten or optimise
  double lower_bound = 0.0;      ///< of all costs, as far as it is proved when it came; 0: nothing is
};

/// Where the points of a path go that is too long to be held: they are handed on as they are made.
class PathTaker : NotCopied {
 public:
  virtual ~PathTaker() = default;
  /// Once, before the first piece: the number of points in all, at least one.
  virtual void begin(std::uint64_t points) = 0;
  /// The points that follow; each piece but the first begins with the last point of the one before.
  virtual void add(std::span<const Vec2> piece) = 0;
};

}  // namespace warren
