// SPDX-License-Identifier: BSD-3-Clause
// What a command line says about the question that a world is asked. A word's way from here: docs/design.md.
#pragma once

#include <span>

#include "scenes/mazes/maze_generator.hpp"
#include "solve/question/question.hpp"
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

}  // namespace warren::tools
