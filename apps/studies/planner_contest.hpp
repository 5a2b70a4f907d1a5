// SPDX-License-Identifier: BSD-3-Clause
// Planners side by side on one world, over a row of seeds. With each seed all take their turn, in an order that changes
// from seed to seed; those whose answer no seed changes take the first turn alone.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/studies/comparison.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"

namespace warren::studies {

/// One value of a list: an option that is given, and the word that says which.
struct DealtValue {
  std::string word;
  SolveOptions
      value;  ///< its seed and planner mean nothing; without samples, of a list of samples, as many as it takes
};

/// The values that one option takes in turn.
struct DealtOption {
  Option option;
  std::vector<DealtValue> values;
};

/// An option that was dealt out, as files and plots name it ("goal_bias"), and its word.
using DealtWord = std::pair<std::string, std::string>;

/// A planner with its options and its question.
struct PlannerContender {
  SolveOptions options;
  Question question;
  std::vector<DealtWord> dealt;  ///< what sets it apart from the planner's other contenders
};

struct PlannerDeal {
  std::vector<PlannerKind> planners = {};
  Question question = {};               ///< asked of all
  SolveOptions common = {};             ///< each planner gets of it what it takes; without planner
  std::vector<DealtOption> lists = {};  ///< dealt in this order; an empty one leaves to each planner what is usual
  std::vector<double> clearances = {};  ///< dealt to all, in place of the question's
};

/// Contenders dealt out: from planners, options that all of them shall have, and lists of which each value makes a
/// contender of its own, to one question and one SolveOptions a contender: every way to take one value of each list.
/// All contenders, planner by planner. Each gets of the options and of the lists' values those that it takes; what none
/// of the planners takes is refused with UsageError, and so are more than 10,000 contenders. A queue goes only to
/// searches that have one.
std::vector<PlannerContender> deal_planners(const PlannerDeal& deal);

struct PlannerContestOptions {
  std::vector<PlannerContender> contenders = {};  ///< each with a planner, as deal_planners() makes them
  std::uint64_t first_seed = 1;
  std::uint64_t runs = 1;   ///< of each, with consecutive seeds
  bool repeat_all = false;  ///< those whose answer no seed changes run as often as others, for their times
  /// Runs go beside each other, each on one thread, as many as the execution has: other times, the same figures else.
  bool parallel = false;
  double budget_s = std::numeric_limits<double>::infinity();  ///< of each run's solve_s
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

/// How many cells of a raster a path passes, as course reports count a path's length: cell (0, 0) has its middle at the
/// origin, the next one's is a cell away. Ends of legs are rounded to cells; a leg takes as many steps as its longer
/// side has cells, diagonal ones count as one; and the first cell. A path of one cell passes one, an empty path none.
std::uint64_t cells_passed(std::span<const Vec2> path, Vec2 origin, double cell);

/// The same on a map's own cells.
std::uint64_t cells_passed(std::span<const Vec2> path, const OccupancyMap& map);

}  // namespace warren::studies
