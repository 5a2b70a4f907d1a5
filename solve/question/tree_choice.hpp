// SPDX-License-Identifier: BSD-3-Clause
// How rrt and rrt-connect are told what to do, whatever the body.
#pragma once

#include <string_view>
#include <vector>

#include "planners/trees/rrt_options.hpp"
#include "solve/question/figure.hpp"
#include "solve/question/solve_options.hpp"

namespace warren {

/// What each planner of trees takes.
inline constexpr OptionSet rrt_connect_options{Option::sampler, Option::step, Option::nodes,
                                               Option::trees,   Option::via,  Option::optimise};
inline constexpr OptionSet rrt_options = rrt_connect_options | OptionSet{Option::goal_bias};

/// Throws UsageError for samplers that trees have no use for.
RrtOptions tree_options(const SolveOptions& options);
/// What the answer calls the trees' sampler.
std::string_view sampler_name(const RrtOptions& options);
/// What was asked for, as Answer::options repeats it.
std::vector<NamedFigure> given_tree_options(const SolveOptions& options);

}  // namespace warren
