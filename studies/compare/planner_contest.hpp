// SPDX-License-Identifier: BSD-3-Clause
// Planners side by side on one world, over a row of seeds. With each seed all take their turn, in an order that changes
// from seed to seed.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"
#include "studies/compare/comparison.hpp"

namespace warren {

struct PlannerContestOptions {
  Question question = {};                     ///< asked of all
  std::vector<SolveOptions> contenders = {};  ///< each with a planner, as deal_planners() makes them
  std::uint64_t first_seed = 1;
  std::uint64_t runs = 1;                                     ///< of each, with consecutive seeds
  double budget_s = std::numeric_limits<double>::infinity();  ///< of each run's solve_s
  std::string pictures = {};                                  ///< the folder that takes them; empty: none are drawn
};

/// One run of a contender, within the execution's deadline; `keep`, where given, receives what a picture shows. Throws
/// UsageError.
Answer solve_contender(const Scene& scene, const Question& question, const SolveOptions& contender, std::uint64_t seed,
                       const Execution& execution, ByProducts* keep = nullptr);

/// Adds the world as a problem and the contenders to `comparison`. Every path counted as solved was verified. Throws
/// Stopped at a signal (the runs until then are there), UsageError for what a planner can't be asked in this world.
void run_planner_contest(const Scene& scene, const PlannerContestOptions& options, const Execution& execution,
                         Comparison& comparison);

}  // namespace warren
