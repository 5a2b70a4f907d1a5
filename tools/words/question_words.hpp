// SPDX-License-Identifier: BSD-3-Clause
// What a command line says about the question that a world is asked, about planners, pictures and paths as files. A
// word's way from here: docs/design.md.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pictures/model/picture_options.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "solve/paths/path_file_io.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"
#include "tools/words/command.hpp"

namespace warren::tools {

/// --robot --start --goal --clearance --contact
std::span<const OptionSpec> question_option_specs();

/// Prices, restrictions and choices of goals, which only planners for one question take.
std::span<const OptionSpec> asked_option_specs();
/// --clearance-price --area --areas --speed-zones --keep-out --unknown: a part of these.
std::span<const OptionSpec> price_option_specs();

/// What these say. Throws UsageError. The files are not read yet: read_masks() does.
Prices price_words(const Arguments& arguments);

/// Nothing where nothing is said; masks and an older answer are named, not read:
/// read_asked_files() does (tools/screen/world_files.hpp). Throws UsageError for values that no
/// problem can have.
Question question_words(const Arguments& arguments);

// What a command line says about the making of mazes.

/// --algorithm --loops, where many mazes are made.
std::span<const OptionSpec> maze_option_specs();

/// Algorithm and loops as the command line says, all else as it is in `usual`. Throws UsageError.
MazeOptions maze_words(const Arguments& arguments, MazeOptions usual = {});

// Planners: all of `solve`, or those that `largest` and `scale` try.

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

// How a picture looks; for every verb that draws.

/// --show --heading --size --dpi --title
std::span<const OptionSpec> picture_option_specs();

/// Throws UsageError, also for any of them where nothing is drawn, `draws` names what would, such as "--picture FILE";
/// and for those that mean nothing to the picture's `file`.
PictureOptions picture_words(const Arguments& arguments, bool is_drawn, std::string_view draws,
                             std::string_view file = {});

// The words of how a path is written as a file of its own, and how fast it is driven.

/// --path and what goes with it.
std::span<const OptionSpec> path_option_specs();
/// Throws UsageError, also for what goes with --path where that is not given.
PathFileOptions path_words(const Arguments& arguments);

}  // namespace warren::tools
