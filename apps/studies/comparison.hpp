// SPDX-License-Identifier: BSD-3-Clause
// Contenders, searches or planners, that took turns at the same problem: every run of each, and what the runs say
// together. Plain data; comparison_report.hpp writes it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/studies/statistics.hpp"
#include "core/base/solution.hpp"
#include "solve/answer/answer.hpp"

namespace warren::studies {

/// One run of one contender. Figures of a path only where it was solved.
struct ComparedRun {
  std::uint64_t seed = 0;  ///< of a planner; of a search, the number of the trial
  Outcome outcome = Outcome::stopped;
  double time_s = 0.0;
  double length = 0.0;  ///< world units
  std::uint64_t hops = 0;
  std::uint64_t expanded = 0;                ///< vertices or states settled; known where nothing was found, too
  std::optional<double> min_clearance = {};  ///< planners only
  std::optional<std::uint64_t> cells = {};   ///< that the path passes on the world's raster; planners only
  std::optional<double> turn_rad = {};       ///< of bodies that turn
  std::optional<double> search_s = {};       ///< planners only: the search's part of time_s
  std::optional<double> raw_length = {};     ///< before the path was shortened
  std::optional<double> cost = {};           ///< in the planner's own units
  bool is_priced = false;                    ///< is the cost that of prices that were asked?
  Counters counters = {};                    ///< planners only
  std::vector<StageCost> costs = {};         ///< planners only: of each stage
  RoadmapSize roadmap = {};                  ///< planners only
  /// Planners only: each path that was the best so far, by the clock of time_s and in the body's metric; of those that
  /// have one answer that one, by "answer".
  std::vector<Improvement> improvements = {};
  std::optional<double> lower_bound = {};  ///< planners only: proved, of all costs of `improvements`
  bool solved() const { return outcome == Outcome::solved; }
};

/// What the contenders of a group have in common.
struct ComparedProblem {
  std::string source;  ///< the world, or "geometric:300"
  std::string kind;    ///< whose graph was searched; "" for planners
  std::uint64_t vertices = 0;
  std::uint64_t edges = 0;
  std::string unit = {};  ///< of lengths, as WorldAccount has it
};

struct Contender {
  std::size_t problem = 0;  ///< index into Comparison::problems
  std::string planner;      ///< of a search: whose graph it is
  std::string search;
  std::string queue;    ///< "" where the search has none
  std::string library;  ///< "warren", or the peer's name
  /// Name, value as JSON.
  std::vector<std::pair<std::string, std::string>> options;
  std::vector<ComparedRun> runs;                                ///< in the order in which they ran, of planners by seed
  std::vector<std::pair<std::string, std::string>> dealt = {};  ///< options that take several values here, and its word
  bool deterministic = false;                                   ///< a planner whose answer no seed changes
};

struct Comparison {
  std::vector<ComparedProblem> problems;
  std::vector<Contender> contenders;
  double clock_s = 0.0;                    ///< what reading the clock costs, taken off each time of a search
  std::vector<std::string> notes;          ///< what was left out, and why: a line each
  std::optional<StopReason> stopped = {};  ///< a signal ended it early
};

/// A contender's runs, together.
struct ComparisonRow {
  std::size_t runs = 0;
  std::size_t solved = 0;
  /// Wilson's, 95 %; of one that never ran, 0 to 1; of one that is deterministic 0 to 0 or 1 to 1
  Interval success;
  std::optional<Distribution> length;         ///< of the solved runs
  std::optional<Distribution> priced_cost;    ///< of the solved runs, where prices are asked
  std::optional<Distribution> hops;           ///< of the solved runs
  std::optional<Distribution> min_clearance;  ///< of the solved runs
  std::optional<Distribution> cells;          ///< of the solved runs
  std::optional<Distribution> turn_rad;       ///< of the solved runs
  std::optional<Distribution> expanded;       ///< of all runs
  std::optional<Distribution> time_s;         ///< of all runs: what did not succeed has cost its time, too
  std::optional<Distribution> search_s;       ///< of the solved runs
};
ComparisonRow row_of(const Contender& contender);

/// Options of an answer as Contender has them.
std::vector<std::pair<std::string, std::string>> json_options(const std::vector<NamedFigure>& options);

/// The number that a dealt word is, of those that are one.
std::optional<double> number_in_word(std::string_view word);

/// "astar, sorted-array", "prm, bfs"; `with_planner` where searches of one graph are not all there is.
std::string contender_name(const Contender& contender, bool with_planner);

using NamedContender = std::pair<std::string, const Contender*>;

/// Those of a problem, in their order, with their names in one plot: what all of them have in common is left out. Where
/// options were dealt out, they alone set a planner's contenders apart.
std::vector<NamedContender> named_contenders(const Comparison& comparison, std::size_t problem);

/// In the order in which they are met; the word's place among them.
inline std::size_t add_once(std::vector<std::string>& words, const std::string& word) {
  const auto place = static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
  if (place == words.size()) words.push_back(word);
  return place;
}

/// "samples 50, radius 2"
std::string options_text(const Contender& contender);

/// The order in which `count` contenders take their turn in one round: shuffled by (seed, round), so that none always
/// follows the same one and whatever else the machine does meets all alike.
std::vector<std::size_t> turns(std::size_t count, std::uint64_t round);

/// Times of one way to search random graphs, against their size.
struct SweepCurve {
  std::string search;
  std::string queue;
  std::string library;
  std::vector<Vec2> points;  ///< vertices, seconds > 0; ascending vertices

  /// What sets it apart from others of its search: a peer's name, or the queue; `alone` where it has none.
  std::string name(const std::string& alone) const {
    if (library != "warren") return library;
    return queue.empty() ? alone : queue;
  }
};

/// A curve a search, queue and library, in the order of the contenders; each point is the geometric mean of the medians
/// over the graphs of that size. Only contenders on geometric graphs that were solved.
std::vector<SweepCurve> sweep_curves(const Comparison& comparison);

/// Where arrays and heaps cross: the size of graph from which on a search with an array as its queue is slower than the
/// same search with a heap, from measured times at several sizes.
struct QueueCrossing {
  std::string search;
  std::string array;
  std::string heap;
  std::vector<Vec2> ratios;                  ///< vertices, time with the array over time with the heap
  std::optional<double> not_slower_at = {};  ///< the largest size where the array is no slower; none: slower everywhere
  std::optional<double> slower_from = {};    ///< the least from which on it is always slower; none: not at the largest
  std::optional<double> crossing = {};       ///< between those two, by the line through log ratio against log size
  std::optional<double> fitted = {};         ///< the same by the line of least squares through all sizes, if it rises
};

/// Every array against every heap, search by search; our own library's. Sizes at which either is missing don't count.
std::vector<QueueCrossing> queue_crossings(const std::vector<SweepCurve>& curves);

}  // namespace warren::studies
