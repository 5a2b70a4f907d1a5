// SPDX-License-Identifier: BSD-3-Clause
// What a command line says about planners: all of `solve`, or those that `largest` and `scale` try.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solve/question/solve_options.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

/// --planner --sampler --samples --neighbours --radius --search --queue --lazy --pipeline --optimise --seed: of the
/// planners that build roadmaps of samples.
std::span<const OptionSpec> roadmap_option_specs();

/// All options of all planners; --planner lists the planners that there are.
std::vector<OptionSpec> solve_option_specs();
/// Throws UsageError for words and values that mean nothing; what contradicts what is not looked at.
SolveOptions solve_words(const Arguments& arguments);

/// --seed; 1 where nothing is said. Throws UsageError.
std::uint64_t seed_word(const Arguments& arguments);
/// A seed: any number of 64 bits.
std::uint64_t seed_value(std::string_view option, std::string_view text);
/// The names of the planners that there are, blank-separated.
std::string_view planner_names();
/// The same of some of them.
std::string names_of_planners(bool (*are)(PlannerKind));
/// Option::goal_bias is "--goal-bias", by words that last.
std::string_view option_flag(Option option);
/// The other way; none: planners are not asked about it.
std::optional<Option> option_of_words(std::string_view words);

}  // namespace warren::tools
