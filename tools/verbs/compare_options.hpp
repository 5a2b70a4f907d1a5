// SPDX-License-Identifier: BSD-3-Clause
// What `warren compare` is asked for: planners side by side on a world, or searches side by side on a world's graph, on
// random graphs of many sizes, or on both. Options that the comparison asked for would ignore are refused.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "studies/contests/planner_contest.hpp"
#include "studies/contests/planner_deal.hpp"
#include "studies/contests/random_graph_sweep.hpp"
#include "studies/contests/search_contest.hpp"
#include "tools/words/arguments.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

struct CompareOptions {
  std::optional<std::string> world;
  std::optional<studies::PlannerContestOptions> planners;  ///< planners are compared; else searches
  studies::SearchContestOptions searches;
  std::optional<studies::SizeSweepOptions> sweep;
  std::optional<PlannerKind> graph;  ///< the planner whose graph is searched; none: the world's usual one
  studies::PlannerDeal graph_deal;   ///< options of that planner; its planners are all that may make the graph
  std::string pictures = {};         ///< the folder that takes the picture of the searches; empty: none is drawn
  PictureOptions look = {};
  double budget_s = std::numeric_limits<double>::infinity();  ///< of each run
};

/// All options of the verb but those of run_option_specs() and of the outputs.
std::vector<OptionSpec> compare_option_specs();

/// Throws UsageError.
CompareOptions compare_options(const Arguments& arguments);

}  // namespace warren::tools
