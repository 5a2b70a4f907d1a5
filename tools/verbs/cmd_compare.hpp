// SPDX-License-Identifier: BSD-3-Clause
// What `warren compare` is asked for: planners side by side on a world, or searches side by side on a world's graph, on
// random graphs of many sizes, or on both. Options that the comparison asked for would ignore are refused.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/studies/planner_contest.hpp"
#include "apps/studies/search_contest.hpp"
#include "pictures/model/picture_options.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

struct CompareOptions {
  std::optional<std::string> world;
  std::optional<studies::PlannerContestOptions> planners;  ///< planners are compared; else searches
  studies::SearchContestOptions searches;                  ///< its budget is that of each run, of planners, too
  std::optional<studies::SizeSweepOptions> sweep;
  std::optional<PlannerKind> graph;  ///< the planner whose graph is searched; none: the world's usual one
  studies::PlannerDeal graph_deal;   ///< options of that planner; its planners are all that may make the graph
  std::string pictures = {};         ///< the folder that takes them; empty: none are drawn
  PictureOptions look = {};
};

/// All options of the verb but those of run_option_specs() and of the outputs.
std::vector<OptionSpec> compare_option_specs();

/// Throws UsageError.
CompareOptions compare_options(const Arguments& arguments);

/// One comparison from beginning to end, as options ask for it: of planners in a world, of searches on its graph, of
/// searches on random graphs. Runs them and adds what they say; what a signal cuts is there until then, and
/// comparison.stopped names it. `scene`: the world, nullptr where only random graphs are asked for. `note` is told how
/// far it is. Gives back why the world has no graph to search, if it has none. Throws UsageError.
std::optional<Outcome> run_comparison(const CompareOptions& options, const Scene* scene, const Execution& execution,
                                      studies::Comparison& comparison,
                                      const std::function<void(std::string_view)>& note);

}  // namespace warren::tools
