// SPDX-License-Identifier: BSD-3-Clause
// How rrt and rrt-connect are told what to do, whatever the body.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planners/trees/rrt_options.hpp"
#include "tools/words/arguments.hpp"
#include "tools/words/command.hpp"

namespace warren {

/// --step --goal-bias --nodes --trees --via
std::span<const OptionSpec> tree_option_specs();

/// The names of those that each planner takes, with --sampler and --optimise.
inline constexpr std::string_view rrt_connect_options = "--sampler --step --nodes --trees --via --optimise";
inline constexpr std::string_view rrt_options = "--sampler --step --goal-bias --nodes --trees --via --optimise";

/// Throws UsageError for values out of range.
RrtOptions tree_options(const Arguments& arguments);
/// What the answer calls the trees' sampler.
std::string_view sampler_name(const RrtOptions& options);
/// The way-points of --via, in order: 2, 3 or 6 numbers each.
std::vector<std::vector<double>> way_points(const Arguments& arguments);
/// What was given, as Answer::options repeats it: name and value as JSON.
std::vector<std::pair<std::string, std::string>> given_tree_options(const Arguments& arguments);

}  // namespace warren
