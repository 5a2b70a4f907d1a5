// SPDX-License-Identifier: BSD-3-Clause
// Planners side by side on one world, over a row of seeds. With each seed all take their turn, in an order that changes
// from seed to seed; those whose answer no seed changes take the first turn alone.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "pictures/model/picture_options.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/question/solve_options.hpp"
#include "studies/compare/comparison.hpp"
#include "studies/contests/planner_deal.hpp"

namespace warren::studies {

struct PlannerContestOptions {
  std::vector<PlannerContender> contenders = {};  ///< each with a planner, as deal_planners() makes them
  std::uint64_t first_seed = 1;
  std::uint64_t runs = 1;   ///< of each, with consecutive seeds
  bool repeat_all = false;  ///< those whose answer no seed changes run as often as others, for their times
  /// Runs go beside each other, each on one thread, as many as the execution has: other times, the same figures else.
  bool parallel = false;
  double budget_s = std::numeric_limits<double>::infinity();  ///< of each run's solve_s
  std::string pictures = {};                                  ///< the folder that takes them; empty: none are drawn
  PictureOptions look = {};
};

/// May another seed give another answer? What trees, samples and shortcuts draw is random; lattices, cells, visibility
/// graphs, medial axes and taut strings are not. Of an answer that was stopped before it says, true.
bool depends_on_seed(const Answer& answer, const SolveOptions& options, const Scene& scene);

/// One run of a contender, within the execution's deadline; `keep`, where given, receives what a picture shows. Throws
/// UsageError.
Answer solve_contender(const Scene& scene, const PlannerContender& contender, std::uint64_t seed,
                       const Execution& execution, ByProducts* keep = nullptr);

/// Adds the world as a problem and the contenders to `comparison`. Every path counted as solved was verified. Throws
/// Stopped at a signal (the runs until then are there), UsageError for what a planner can't be asked in this world.
void run_planner_contest(const Scene& scene, const PlannerContestOptions& options, const Execution& execution,
                         Comparison& comparison);

}  // namespace warren::studies
