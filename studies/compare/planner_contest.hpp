// SPDX-License-Identifier: BSD-3-Clause
// Planners side by side on one world: every planner of `solve`, each with each of the options that are dealt out to it,
// over a row of seeds. With each seed all take their turn, in an order that changes from seed to seed.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "parallel/execution.hpp"
#include "pictures/picture.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/answer.hpp"
#include "studies/compare/comparison.hpp"
#include "tools/words/arguments.hpp"
#include "tools/words/command.hpp"

namespace warren {

/// One planner and its options: the words of a `solve`, but for world and seed.
using PlannerWords = std::vector<std::string>;
/// The same as `solve` reads them.
Arguments solve_arguments(const PlannerWords& words);

/// What each planner is given: words that are the same for all, and options of which each value makes a contender.
struct PlannerDeal {
  std::vector<std::string> planners;
  std::vector<std::pair<std::string_view, std::string>> common;              ///< "--clearance", "0.2"; "" for a flag
  std::vector<std::pair<std::string_view, std::vector<std::string>>> lists;  ///< "--samples", {"50", "100"}
};

/// All of the deal as one `solve` without --planner would be given it; lists of one value at most.
PlannerWords words_without_planner(const PlannerDeal& deal);

/// All contenders, planner by planner. Each gets of the options and of the lists' values those that it takes; what none
/// of the planners takes is refused with UsageError. A queue goes only to searches that have one.
std::vector<PlannerWords> deal_planners(const PlannerDeal& deal);

struct PlannerContestOptions {
  std::vector<PlannerWords> contenders;
  std::uint64_t first_seed = 1;
  std::uint64_t runs = 1;                                     ///< of each, with consecutive seeds
  double budget_s = std::numeric_limits<double>::infinity();  ///< of each run's solve_s
  std::string pictures;                                       ///< the folder that takes them; empty: none are drawn
};

/// One run of a contender, within the execution's deadline; `drawing`, where given, receives what a picture shows.
/// Throws UsageError.
Answer solve_contender(const Scene& scene, const PlannerWords& words, std::uint64_t seed, const Execution& execution,
                       Drawing* drawing = nullptr);

/// Adds the world as a problem and the contenders to `comparison`. Every path counted as solved was verified. Throws
/// Stopped at a signal (the runs until then are there), UsageError for what a planner can't be asked in this world.
void run_planner_contest(const Scene& scene, const PlannerContestOptions& options, const Execution& execution,
                         Comparison& comparison);

}  // namespace warren
